// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/assembly/ties.hpp"
#include "seam/base/communicator.hpp"

namespace seam {

struct FieldEntry;

/// Lets unknowns of bodies that are given, or tied to nothing but what has rates, have rates as well,
/// whatever their physics needs, and takes away the quantities that read rates which there are none of.
/// Bodies have no quantities that read rates of other fields. Collective.
void carry_rates_of_bodies(std::vector<FieldEntry>& fields, const std::vector<Ties::Resolved>& ties,
                           const Communicator& communicator);

}  // namespace seam
