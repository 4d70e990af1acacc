// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/cut/cell_map.hpp"
#include "seam/cut/geometry.hpp"

namespace seam::cutting {

/// Integrals over the wet part of a cell, in m^d, of products of Legendre polynomials of the coordinates of
/// an affine map up to `degree` in each: by the divergence theorem, exact.
/// @param map the cell's, or its linearised one
/// @param moment [k0 + n (k1 + n k2)], n = degree + 1
void volume_moments(int dimension, const CellMap& map, const CutCell& cell, int degree,
                    std::vector<double>& moment);

/// The same over the wet part of a face, in m^(d-1), in the face's reference coordinates.
/// @param face_origin, face_axes reference coordinates in the cell of the face's origin and its unit steps
void face_moments(int dimension, const CellMap& map, const CutCell& cell, int face, const Vector& face_origin,
                  const std::array<Vector, 2>& face_axes, int degree, std::vector<double>& moment);

}  // namespace seam::cutting
