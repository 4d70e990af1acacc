// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/solve/problem.hpp"

namespace seam {

/// Chooses the nodes that hold the level of an unknown: in each connected part of the field's active cells
/// that has no face on an open boundary, the one with the lowest global number among the nodes of whole cells
/// (of any cells where there is none). Collective.
void place_levels(FieldEntry& entry);

}  // namespace seam
