// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace seam {

/// The boundary of a body as planar simplices in space: segments in the plane, triangles in space. The normal
/// points out of the body: to the right of a segment's direction (a body's outline runs counter-clockwise),
/// by the right-hand rule of a triangle's vertices.
struct Surface {
  int dimension = 2;
  std::vector<double> points;  ///< [vertex][dimension], m
  std::vector<int> facets;     ///< [facet][dimension]: vertices
  /// False for a surface whose rim lies outside the mesh it cuts: the body is what lies behind it.
  bool closed = true;

  friend bool operator==(const Surface&, const Surface&) = default;
  [[nodiscard]] int facet_count() const { return static_cast<int>(facets.size()) / dimension; }
  [[nodiscard]] int point_count() const { return static_cast<int>(points.size()) / dimension; }
};

}  // namespace seam
