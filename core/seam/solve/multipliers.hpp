// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "seam/assembly/ties.hpp"
#include "seam/interface/interface.hpp"

namespace seam {

using Interfaces = std::map<std::string, std::vector<InterfacePart>>;

/// Takes multipliers out of fields (Unknown::multiplier_of) at nodes where what they hold is prescribed or
/// tied, where two of them would hold the same, where one of another field holds it, or where next to nothing
/// is opposite. Collective.
/// @param ties of all fields
void leave_out_multipliers(const std::vector<Field*>& fields, const std::vector<Ties::Resolved>& ties,
                           const Interfaces& interfaces);
/// What to say of a face that has something opposite and no multiplier left to hold it; empty where there is
/// none. Collective.
std::string describe_lost_multipliers(const Field& field, const Interfaces& interfaces);

}  // namespace seam
