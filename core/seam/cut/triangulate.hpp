// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "seam/cut/lattice.hpp"

namespace seam::cutting {

using Triangle = std::array<Vector, 3>;

/// Triangles between the corners of plane outlines: those that run counter-clockwise enclose, those that run
/// clockwise are holes. Their signed areas add up to that of the outlines whatever the input; they overlap
/// only where outlines do.
std::vector<Triangle> triangulate(const std::vector<std::vector<Vector>>& outlines);

}  // namespace seam::cutting
