// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "seam/field/field.hpp"

namespace seam {

/// The components of a block that belong to some unknowns of its field.
/// @param names none: all unknowns
/// @throws Error listing the field's unknowns
std::vector<int> components_of(const Field& field, int block, const std::vector<std::string>& names);

/// Whether a component is an unknown of the system: its node carries one, and it is not prescribed.
bool is_free(const Block& block, int node, int component);

}  // namespace seam
