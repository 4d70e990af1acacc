// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>

#include "seam/cut/lattice.hpp"
#include "seam/surface/surface.hpp"

namespace seam {

/// The vertices of a facet, [dimension], m; in the plane the third one is zero.
inline std::array<cutting::Vector, 3> facet_vertices(const Surface& surface, int facet) {
  const int dim = surface.dimension;
  std::array<cutting::Vector, 3> result{};
  for (int k = 0; k < dim; ++k) {
    const int p = surface.facets[static_cast<std::size_t>(facet) * dim + k];
    std::copy_n(&surface.points[static_cast<std::size_t>(p) * dim], dim, result[k].begin());
  }
  return result;
}

/// Outward normal of a facet, as Surface has it, with the length of its area (twice that in space).
inline cutting::Vector facet_normal(int dimension, const std::array<cutting::Vector, 3>& vertices) {
  using namespace cutting;
  const Vector first = vertices[1] - vertices[0];
  if (dimension == 2) return {first[1], -first[0], 0};
  return cross(first, vertices[2] - vertices[0]);
}

/// A point of a facet. @param on_facet shares of vertices 1 and 2, [dimension - 1]
inline cutting::Vector point_on_facet(int dimension, const std::array<cutting::Vector, 3>& vertices,
                                      const double* on_facet) {
  using namespace cutting;
  Vector x = vertices[0];
  for (int k = 1; k < dimension; ++k) x = x + on_facet[k - 1] * (vertices[k] - vertices[0]);
  return x;
}

}  // namespace seam
