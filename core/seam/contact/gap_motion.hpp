// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

namespace seam {

/// A point on one facet and the point opposite to it on another, at the end of the first facet's normal.
struct FacetPair {
  int dimension = 2;
  std::array<std::array<double, 3>, 3> own{}, opposite{};  ///< vertices of the two facets, m
  std::array<double, 2> on_own{}, on_opposite{};           ///< shares of vertices 1 and 2
  double gap = 0;                                          ///< m
};

/// How the pair changes with its facets' vertices. Move k = (facet * dimension + vertex) * dimension +
/// component, `moves` of them: dimension^2 where the second facet is not to move, else twice as many.
struct PairMotion {
  std::vector<double> normal;           ///< [dimension][move], 1/m
  std::vector<double> relative_weight;  ///< [move], of the first facet's area, 1/m
  std::vector<double> gap;              ///< [move]
  std::vector<double> on_opposite;      ///< [dimension - 1][move], 1/m
};

/// @param slide how on_own changes, [dimension - 1][move], 1/m; empty for a point that keeps its place on the
/// facet
PairMotion pair_motion(const FacetPair& pair, int moves, const std::vector<double>& slide = {});

/// Outward normal of a facet, as Surface has it, with the length of its area (twice that in space).
std::array<double, 3> facet_normal(int dimension, const std::array<std::array<double, 3>, 3>& vertices);

}  // namespace seam
