// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "seam/term/fad.hpp"
#include "seam/term/tensor.hpp"

/// Geometry of facets as templates on the scalar: of plain numbers it says where things are; of numbers that
/// carry derivatives with respect to the facets' vertices, how they move. Nobody derives a motion by hand.
namespace seam {

/// The vertices of a facet, m: of a segment in the plane, its outward normal to the right of the way from 0
/// to 1; of a triangle in space, counter-clockwise seen from outside.
template <int dim, class T>
using Corners = std::array<Vec<dim, T>, dim>;

/// A number with its derivatives with respect to the vertices of some facets: move k = (facet * dim + vertex)
/// * dim + component.
template <int dim, int facets>
using Moves = Fad<facets * dim * dim>;

/// A facet whose vertices are the moves. @param facet which one of those that move
template <int dim, int facets>
Corners<dim, Moves<dim, facets>> moving_facet(const std::array<std::array<double, 3>, 3>& vertices,
                                              int facet = 0) {
  Corners<dim, Moves<dim, facets>> result;
  for (int k = 0; k < dim; ++k)
    for (int i = 0; i < dim; ++i)
      result[k][i] = Moves<dim, facets>(vertices[k][i], (facet * dim + k) * dim + i);
  return result;
}

/// Normal, outward, with the length of the area, m^(d-1): twice that in space.
template <int dim, class T>
Vec<dim, T> area_vector(const Corners<dim, T>& facet) {
  const Vec<dim, T> first = facet[1] - facet[0];
  if constexpr (dim == 2)
    return {{first[1], -first[0]}};
  else
    return cross(first, facet[2] - facet[0]);
}

/// A point of a facet. @param share of vertices 1 and 2
template <int dim, class T, class S>
Vec<dim, T> point_on(const Corners<dim, T>& facet, const Vec<dim - 1, S>& share) {
  Vec<dim, T> x = facet[0];
  for (int k = 1; k < dim; ++k) x += share[k - 1] * (facet[k] - facet[0]);
  return x;
}

/// Shares of vertices 1 and 2 in the foot of a point on the facet's line or plane.
template <int dim, class T, class S>
Vec<dim - 1, promote<S, T>> shares_of(const Corners<dim, T>& facet, const Vec<dim, S>& x) {
  const Vec<dim, T> first = facet[1] - facet[0];
  const Vec<dim, promote<S, T>> way = x - facet[0];
  if constexpr (dim == 2) {
    return {{dot(way, first) / dot(first, first)}};
  } else {
    const Vec<dim, T> second = facet[2] - facet[0], area = cross(first, second);
    const T square = dot(area, area);
    return {{dot(cross(way, second), area) / square, dot(cross(first, way), area) / square}};
  }
}

/// Where a line from x meets the line or plane of a facet, in lengths of `along`.
template <int dim, class T, class S, class R>
promote<R, promote<S, T>> way_to(const Corners<dim, T>& facet, const Vec<dim, S>& x,
                                 const Vec<dim, R>& along) {
  const Vec<dim, T> area = area_vector<dim>(facet);
  return dot(facet[0] - x, area) / dot(along, area);
}

/// A point on a facet that may slide along it, as it follows the vertices of `facets` facets, the one that it
/// lies on first.
template <int dim, int facets>
struct MovingPoint {
  using Number = Moves<dim, facets>;
  Vec<dim, Number> position, normal;
  Number relative_weight;  ///< 1 now
  Vec<dim - 1, Number> on_facet;
  Vec<2, Number> span;  ///< in the plane: of the stretch that it stands for
};

/// The same number where more facets move, behind those that it follows.
template <int to, int from>
Fad<to> widened(const Fad<from>& number) {
  static_assert(to >= from);
  Fad<to> result(number.v);
  std::copy_n(number.d, from, result.d);
  return result;
}
template <int to, int n, int from>
Vec<n, Fad<to>> widened(const Vec<n, Fad<from>>& numbers) {
  Vec<n, Fad<to>> result;
  for (int i = 0; i < n; ++i) result[i] = widened<to>(numbers[i]);
  return result;
}
template <int dim>
MovingPoint<dim, 2> widened(const MovingPoint<dim, 1>& point) {
  constexpr int to = 2 * dim * dim;
  return {widened<to>(point.position), widened<to>(point.normal), widened<to>(point.relative_weight),
          widened<to>(point.on_facet), widened<to>(point.span)};
}

/// Appends the derivatives with respect to the first `moves` moves; those that a number lacks are zero.
template <int n>
void append_moves(const Fad<n>& number, std::size_t moves, std::vector<double>& rows) {
  rows.insert(rows.end(), number.d, number.d + std::min<std::size_t>(n, moves));
  if (moves > n) rows.resize(rows.size() + moves - n, 0.0);
}
/// Row by row.
template <int k, int n>
void append_moves(const Vec<k, Fad<n>>& numbers, std::size_t moves, std::vector<double>& rows) {
  for (int i = 0; i < k; ++i) append_moves(numbers[i], moves, rows);
}

}  // namespace seam
