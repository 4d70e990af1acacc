// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "seam/cut/clip.hpp"
#include "seam/cut/geometry.hpp"

namespace seam::cutting {

/// Where several bodies meet in space, and one of their sides lies in a face of the mesh, rounding may leave
/// that face wet in one of its two cells and not in the other: then neither has the interface between them.
/// What only one of them has becomes an interface of that one, with the facets that lie there.
/// @param windings [body][vertex of the outline]
/// @param convex of a cell: whether it is
void agree_on_faces(const ClipInput& input, const std::vector<std::vector<int>>& windings,
                    const std::function<bool(int)>& convex, std::vector<CutCell>& cells,
                    std::vector<CellState>& state);

}  // namespace seam::cutting
