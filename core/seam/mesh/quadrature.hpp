// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/mesh/cell_type.hpp"

namespace seam {

/// Points and weights on a reference cell; the weights add up to its volume.
struct Quadrature {
  int dimension = 0;
  std::vector<double> points;  ///< `dimension` per point
  std::vector<double> weights;
  [[nodiscard]] int count() const { return static_cast<int>(weights.size()); }
};

/// A rule exact for polynomials of the given degree (per direction on tensor cells, total on simplices).
/// Tensor cells: Gauss-Legendre. Triangles: centroid, three points (degree 2), Dunavant's six points (degree
/// 4). Tetrahedra: centroid, four points (degree 2), Keast's fifteen points (degree 5). Higher degrees:
/// Gauss-Jacobi by collapsed coordinates.
/// @throws std::logic_error for degrees above 30
const Quadrature& quadrature(CellType type, int degree);

/// The n Gauss points and weights on [0,1].
Quadrature gauss(int n);

}  // namespace seam
