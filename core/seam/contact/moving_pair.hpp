// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "seam/surface/moving_facet.hpp"

namespace seam {

/// A point on one facet and the point opposite to it on another, at the end of the first facet's normal.
struct FacetPair {
  int dimension = 2;
  std::array<std::array<double, 3>, 3> own{}, opposite{};  ///< vertices of the two facets, m
  std::array<double, 2> on_own{}, on_opposite{};           ///< shares of vertices 1 and 2
  double gap = 0;                                          ///< m
};

/// The pair as it follows the vertices of both facets: first the own one's moves, then those of the one
/// opposite.
template <int dim>
struct MovingPair {
  using Number = Moves<dim, 2>;
  using Shares = Vec<dim - 1, Number>;

  /// At a point that keeps its place on its facet.
  explicit MovingPair(const FacetPair& pair)
      : own(moving_facet<dim, 2>(pair.own, 0)), opposite(moving_facet<dim, 2>(pair.opposite, 1)) {
    for (int k = 0; k + 1 < dim; ++k) on_own[k] = pair.on_own[k];
    const Vec<dim, Number> area = area_vector<dim>(own);
    const Number size = sqrt(dot(area, area));
    normal = (1.0 / size) * area;
    relative_weight = size / size.v;
  }
  /// In the plane: lets the point keep its part of a stretch of the own facet whose ends move.
  void keep_part(const Number& from, const Number& to) {
    static_assert(dim == 2);
    const Number length = to - from;
    on_own[0] = from + (on_own[0].v - from.v) / length.v * length;
    relative_weight *= length / length.v;
  }
  /// Finds what is opposite.
  void look() {
    const Vec<dim, Number> x = point_on<dim>(own, on_own);
    gap = way_to<dim>(opposite, x, normal);
    on_opposite = shares_of<dim>(opposite, x + gap * normal);
  }

  Corners<dim, Number> own, opposite;
  Shares on_own, on_opposite;
  Vec<dim, Number> normal;  ///< of the own facet, outward, of length 1
  Number relative_weight;   ///< of the own facet's area, or of a part of it; 1 now
  Number gap;               ///< m
};

}  // namespace seam
