// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/cut/clip.hpp"
#include "seam/cut/geometry.hpp"

namespace seam::cutting {

/// Replaces the pieces and the wet faces of a cell in space that several bodies reach, or one body twice,
/// by those of the wet part outside all of them. The cell is divided along the facets into convex parts, each
/// wholly inside or outside of every body. Parts too thin to matter stem from bodies that touch: a gap or
/// overlap below 1e-12 of the cell's size is none.
/// @param windings [body][vertex of the outline]
/// @param convex whether the cell is
void unite_in_cell(const ClipInput& input, const std::vector<std::vector<int>>& windings, bool convex,
                   CutCell& cell);

}  // namespace seam::cutting
