// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/cut/convex.hpp"
#include "seam/cut/geometry.hpp"

namespace seam::cutting {

/// Origin of the faces that lie in the plane of a cell's piece; those on the cell's border have their side of
/// Outline.
constexpr int piece_origin(int piece) { return -1 - piece; }

/// In space: the wet part of a cut cell as convex polyhedra. The cell is divided along the planes of the
/// interface until each polyhedron lies wholly in the wet part or not; less than 1e-14 of it is not divided
/// off.
/// @param is_convex whether the cell is; others are divided into tetrahedra around their centre first
std::vector<Convex> wet_leaves(const Outline& outline, const CutCell& cell, bool is_convex);

/// In space: whether a point of a cell lies in its wet part.
bool is_wet_at(const CutCell& cell, const Vector& x);

}  // namespace seam::cutting
