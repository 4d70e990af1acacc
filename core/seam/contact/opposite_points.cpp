// SPDX-License-Identifier: BSD-3-Clause
#include "seam/contact/opposite_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "seam/cut/facet_vertices.hpp"

namespace seam {

using namespace cutting;

OppositePoints::OppositePoints(const BodySurface& own, const BodySurface* other, Surface surface,
                               Surface opposite, ContactWindow window)
    : own_(&own),
      is_itself_(other == &own),
      surface_(std::move(surface)),
      search_(std::move(opposite)),
      window_(window) {}

std::array<Vector, 3> OppositePoints::own_vertices(int facet) const {
  return facet_vertices(surface_, facet);
}

double OppositePoints::area(int facet) const {
  const Vector n = facet_normal(surface_.dimension, own_vertices(facet));
  return std::sqrt(dot(n, n));
}

Vector OppositePoints::normal(int facet) const {
  return 1 / area(facet) * facet_normal(surface_.dimension, own_vertices(facet));
}

/// In contact with itself a thin part of a body must not take its own back for a surface that it has passed,
/// nor the two sides of a notch each other for surfaces that touch.
bool OppositePoints::is_own_neighbourhood(int facet, int other_facet) const {
  if (own_->group(facet) == own_->group(other_facet)) return true;
  const std::vector<int>& first = own_->cell(own_->group(facet)).nodes[own_->place().block];
  const std::vector<int>& second = own_->cell(own_->group(other_facet)).nodes[own_->place().block];
  return std::ranges::find_first_of(first, second) != first.end();
}

FacetSearch::Exclude OppositePoints::neighbours(int facet) const {
  if (!is_itself_) return {};
  return [this, facet](int other_facet) { return is_own_neighbourhood(facet, other_facet); };
}

bool OppositePoints::has_passed(int facet, const double* on_facet) const {
  const Vector x = point_on_facet(surface_.dimension, own_vertices(facet), on_facet);
  return search_.encloses(x.data(), normal(facet).data(), window_.depth, neighbours(facet));
}

std::optional<OppositePoints::Hit> OppositePoints::find(int facet, const double* on_facet) const {
  const int dim = surface_.dimension;
  Hit hit{facet, -1, {}};
  FacetPair& pair = hit.pair;
  pair.dimension = dim;
  pair.own = own_vertices(facet);
  std::copy_n(on_facet, dim - 1, pair.on_own.begin());
  const Vector x = point_on_facet(dim, pair.own, on_facet);
  const auto found =
      search_.find(x.data(), normal(facet).data(), window_.depth, window_.reach, neighbours(facet));
  if (!found) return std::nullopt;
  hit.facet = found->facet;
  pair.opposite = facet_vertices(search_.surface(), found->facet);
  pair.on_opposite = found->on_facet;
  pair.gap = found->gap;
  return hit;
}

std::optional<FacetSearch::Hit> OppositePoints::facing(int facet, const double* on_facet, double depth,
                                                       double reach) const {
  const Vector x = point_on_facet(surface_.dimension, own_vertices(facet), on_facet);
  return search_.find(x.data(), normal(facet).data(), depth, reach, neighbours(facet));
}

OppositePoints::Hit OppositePoints::far_hit(int facet, const double* on_facet, int other_facet) const {
  Hit hit{facet, other_facet, {}};
  FacetPair& pair = hit.pair;
  pair.dimension = surface_.dimension;
  pair.own = own_vertices(facet);
  std::copy_n(on_facet, pair.dimension - 1, pair.on_own.begin());
  pair.opposite = facet_vertices(search_.surface(), other_facet);
  pair.on_opposite = {0.25, 0.25};
  pair.gap = std::numeric_limits<double>::infinity();
  return hit;
}

std::vector<OppositePoints::Stretch> OppositePoints::stretches(int facet, double from, double to) const {
  if (surface_.dimension != 2) return {{{0}, {1}}};
  const std::array<Vector, 3> own = own_vertices(facet);
  const Vector along = own[1] - own[0], direction = normal(facet);
  Vector low = own[0], high = own[0];
  for (const Vector& end : {own[0], own[1]})
    for (const double way : {-window_.depth, window_.reach})
      for (int d = 0; d < 2; ++d) {
        low[d] = std::min(low[d], end[d] + way * direction[d]);
        high[d] = std::max(high[d], end[d] + way * direction[d]);
      }
  std::vector<int> near;
  search_.find_near(low.data(), high.data(), direction.data(), near);
  std::vector<Break> breaks{end_at(facet, from), end_at(facet, to)};
  for (const int other : near)
    for (int k = 0; k < 2; ++k) {
      const int vertex = search_.surface().facets[static_cast<std::size_t>(other) * 2 + k];
      const Vector r = facet_vertices(search_.surface(), other)[k] - own[0];
      const double share = dot(r, along) / dot(along, along), height = dot(r, direction);
      constexpr double least = 1e-9;
      if (share > from + least && share < to - least && height >= -window_.depth && height <= window_.reach)
        breaks.push_back({share, other, vertex});
    }
  std::ranges::sort(breaks, [](const Break& a, const Break& b) {
    return a.share != b.share ? a.share < b.share : a.vertex < b.vertex;
  });
  std::vector<Stretch> result;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
    if (breaks[k + 1].share > breaks[k].share) result.push_back({breaks[k], breaks[k + 1]});
  return result;
}

OppositePoints::Break OppositePoints::end_at(int facet, double share) const {
  // Of the facet's length, so near an end is at a corner or on another facet: the cut's lattice is much
  // finer.
  constexpr double nearness = 1e-6;
  if (share < nearness || share > 1 - nearness) return {share};
  const std::array<Vector, 3> own = own_vertices(facet);
  const Vector along = own[1] - own[0], x = own[0] + share * along, direction = normal(facet);
  const double reach = nearness * std::sqrt(dot(along, along));
  const Vector margin{reach, reach, 0}, low = x - margin, high = x + margin;
  // One that faces this facet before one that meets it at an angle.
  for (const double* facing : {direction.data(), static_cast<const double*>(nullptr)}) {
    std::vector<int> near;
    search_.find_near(low.data(), high.data(), facing, near);
    for (const int other : near) {
      const std::array<Vector, 3> v = facet_vertices(search_.surface(), other);
      const Vector edge = v[1] - v[0], way = x - v[0];
      const double length = std::sqrt(dot(edge, edge)), there = dot(way, edge) / (length * length);
      const double height = (way[0] * edge[1] - way[1] * edge[0]) / length;
      const bool is_itself = is_itself_ && is_own_neighbourhood(facet, other);
      if (is_itself || std::abs(height) >= reach || there <= -nearness || there >= 1 + nearness) continue;
      const auto is_flush = [&](const Vector& end) { return std::abs(dot(end - x, direction)) < reach; };
      if (!is_flush(v[0]) || !is_flush(v[1])) return {share, other};
      // Flush facets cross nowhere: the part ends where the other one does, or keeps its place.
      for (int k = 0; k < 2; ++k)
        if (std::abs(there - k) < nearness)
          return {share, other, search_.surface().facets[static_cast<std::size_t>(other) * 2 + k]};
    }
  }
  return {share};
}

Moves<2, 2> OppositePoints::place_of(const Break& end, const Hit& hit, const MovingPair<2>& pair) const {
  Moves<2, 2> place(end.share);
  if (end.crosses() && end.facet == hit.facet)
    place = way_to<2>(pair.opposite, pair.own[0], pair.own[1] - pair.own[0]);
  for (int k = 0; k < 2 && end.vertex >= 0; ++k)
    if (search_.surface().facets[static_cast<std::size_t>(hit.facet) * 2 + k] == end.vertex)
      place = shares_of<2>(pair.own, pair.opposite[k])[0];
  // Where it is now has been found already, with the lattice of the cut.
  place.v = end.share;
  return place;
}

template <int dim>
MovingPair<dim> OppositePoints::moving(const Hit& hit, const Stretch& stretch) const {
  MovingPair<dim> pair(hit.pair);
  if constexpr (dim == 2) pair.keep_part(place_of(stretch.from, hit, pair), place_of(stretch.to, hit, pair));
  pair.look();
  return pair;
}

template MovingPair<2> OppositePoints::moving<2>(const Hit&, const Stretch&) const;
template MovingPair<3> OppositePoints::moving<3>(const Hit&, const Stretch&) const;

}  // namespace seam
