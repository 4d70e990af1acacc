// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/assembly/ties.hpp"

namespace seam {

/// Takes multipliers out of fields (Unknown::multiplier_of) at nodes where a component of what they hold is
/// prescribed or tied, or where two of them would hold the same. Collective.
/// @param ties of all fields
void leave_out_multipliers(const std::vector<Field*>& fields, const std::vector<Ties::Resolved>& ties);

}  // namespace seam
