// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/cut/geometry.hpp"

namespace seam::cutting {

/// How many bodies cover each vertex of the outline: spread along the mesh's edges from one exact query per
/// connected part, changing where facets cross an edge.
/// @throws Error when two ways to a vertex disagree: an open surface ends inside the mesh
std::vector<int> spread_coverage(const Mesh& mesh, const Outline& outline,
                                 const std::vector<LatticePoint>& vertex, const Facets& facets,
                                 const std::vector<CutCell>& cells);

}  // namespace seam::cutting
