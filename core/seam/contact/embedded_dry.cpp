// SPDX-License-Identifier: BSD-3-Clause
// What of a body's surface the field has nothing of: closed by the other body, or covered.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "seam/base/diagnostics.hpp"
#include "seam/contact/embedded_motion.hpp"
#include "seam/cut/facet_vertices.hpp"
#include "seam/mesh/quadrature.hpp"

namespace seam {

using namespace cutting;

namespace {

constexpr double rounding = 1e-9;  ///< of shares of a facet

/// What a facet's wet stretches leave over.
std::vector<std::pair<double, double>> rest(std::vector<std::pair<double, double>> wet) {
  std::ranges::sort(wet);
  std::vector<std::pair<double, double>> result;
  double reached = 0;
  wet.emplace_back(1, 1);
  for (const auto& [from, to] : wet) {
    if (from - reached > rounding) result.emplace_back(reached, from);
    reached = std::max(reached, to);
  }
  return result;
}

}  // namespace

void EmbeddedSurface::add_dry(const OppositePoints& opposite) {
  std::vector<Wet> wet = field_->mesh().communicator().gather_all(wet_);
  std::ranges::stable_sort(wet, {}, &Wet::facet);
  Dry dry;  // the same on all ranks
  auto from = wet.begin();
  for (int facet = 0; facet < own_->facet_count(); ++facet) {
    const auto to = std::find_if(from, wet.end(), [&](const Wet& w) { return w.facet != facet; });
    find_dry(facet, {from, to}, opposite, dry);
    from = to;
  }
  add_closed(dry.closed, opposite);
  if (dimension() == 2)
    add_covered<2>(dry.covered, opposite.own_surface());
  else
    add_covered<3>(dry.covered, opposite.own_surface());
}

void EmbeddedSurface::add_closed(const std::vector<ClosedPoint>& points, const OppositePoints& opposite) {
  if (points.empty()) return;
  const Communicator& communicator = field_->mesh().communicator();
  // The nearest wet point is one of those that face the other body, where there are any.
  std::vector<Edge> edges = communicator.gather_all(wet_points_[near]);
  if (edges.empty()) edges = communicator.gather_all(wet_points_[free]);
  if (edges.empty()) return dimension() == 2 ? add_shut<2>(points, opposite) : add_shut<3>(points, opposite);
  for (const ClosedPoint& point : points)
    if (dimension() == 2)
      add_closed_point<2>(point, edges, opposite);
    else
      add_closed_point<3>(point, edges, opposite);
}

/// Bodies may overlap a little, and a solution in which they have passed through each other solves all
/// equations: no point has an opposite one any more. A long step gets there in few iterations.
void EmbeddedSurface::refuse_passed(int facet, const double* on_facet, const OppositePoints& opposite) const {
  if (!opposite.has_passed(facet, on_facet)) return;
  throw StepRefused(fmt::format(
      "the surface of '{}' has passed through that of '{}' by more than {:.3g}, the interface's depth",
      own_->body().name(), other_->body().name(), window_.depth));
}

/// Appends the points of the part of a facet that is not wet.
void EmbeddedSurface::find_dry(int facet, const std::vector<Wet>& wet, const OppositePoints& opposite,
                               Dry& dry) const {
  if (dimension() == 3) return find_dry_in_space(facet, wet, opposite, dry);
  const double area = opposite.area(facet);
  std::vector<std::pair<double, double>> parts;
  for (const Wet& w : wet) parts.emplace_back(w.from.v, w.to.v);
  // Where the wet part ends, the dry one begins.
  const auto end_at = [&](double share) {
    for (const Wet& w : wet)
      for (const Moves<2, 1>& end : {w.from, w.to})
        if (std::abs(end.v - share) < rounding) return end;
    return Moves<2, 1>(share);
  };
  for (const auto& [from, to] : rest(parts))
    for (const OppositePoints::Stretch& stretch : opposite.stretches(facet, from, to))
      for (int q = 0; q < rule_->count(); ++q) {
        const double share = stretch.from.share + rule_->points[q] * stretch.length(),
                     weight = area * stretch.length() * rule_->weights[q];
        if (const auto hit = opposite.find(facet, &share)) {
          dry.closed.push_back({*hit, stretch, weight});
          continue;
        }
        refuse_passed(facet, &share, opposite);
        dry.covered.push_back(
            {facet, {share, 0}, weight, end_at(stretch.from.share), end_at(stretch.to.share)});
      }
}

/// The closed points of a facet that is wet in part are those behind the other surface; together they stand
/// for all that is not wet. Where there are none, all points stand for a covered part.
void EmbeddedSurface::find_dry_in_space(int facet, const std::vector<Wet>& wet,
                                        const OppositePoints& opposite, Dry& dry) const {
  const double area = opposite.area(facet);
  double left = area / 2;
  for (const Wet& w : wet) left -= w.area;
  if (left <= rounding * area) return;
  const bool all = wet.empty();
  const auto first = static_cast<std::ptrdiff_t>(dry.closed.size());
  std::vector<CoveredPoint> others;
  double sum = 0;
  for (int q = 0; q < rule_->count(); ++q) {
    const double* point = &rule_->points[static_cast<std::size_t>(q) * 2];
    const double weight = area * rule_->weights[q];
    const auto hit = opposite.find(facet, point);
    if (!hit && all) refuse_passed(facet, point, opposite);
    if (!hit || (!all && hit->pair.gap >= 0)) {
      others.push_back({facet, {point[0], point[1]}, all ? weight : weight * 2 * left / area});
      continue;
    }
    dry.closed.push_back({*hit, {{0}, {1}}, weight});
    sum += weight;
  }
  const double scale = all ? 1.0 : std::min(2.0, left / sum);
  std::for_each(dry.closed.begin() + first, dry.closed.end(),
                [&](ClosedPoint& point) { point.weight *= scale; });
  if (all || sum == 0) dry.covered.insert(dry.covered.end(), others.begin(), others.end());
}

EmbeddedSurface::Element* EmbeddedSurface::element_beside(Zone zone, int facet, int other_facet) {
  const Mesh& mesh = own_->body().mesh();
  if (mesh.owner_of_global_cell()[own_->parent(facet).cell] != mesh.communicator().rank()) return nullptr;
  const int group = own_->group(facet), other_group = other_facet < 0 ? -1 : other_->group(other_facet);
  std::vector<Element>& all = elements_[zone];
  if (all.empty() || all.back().group != group || all.back().other_group != other_group) {
    Element& added = all.emplace_back();
    added.group = group;
    added.other_group = other_group;
    added.trace_size = own_->cell(group).diameter;
  }
  return &all.back();
}

template <int dim>
void EmbeddedSurface::add_shut(const std::vector<ClosedPoint>& points, const OppositePoints& opposite) {
  constexpr std::size_t moves = 2 * dim * dim;
  for (const auto& [hit, stretch, weight] : points) {
    const int facet = hit.own_facet;
    Element* element = element_beside(shut, facet, hit.facet);
    if (element == nullptr) continue;
    for (CutPoints* of : {&element->outside, &element->own, &element->other}) of->weight.push_back(weight);
    own_->to_cell(facet, hit.pair.on_own.data(), element->own.reference);
    const MovingPair<dim> pair = opposite.moving<dim>(hit, stretch);
    const MovingPoint<dim, 2> point{
        point_on<dim>(pair.own, pair.on_own), -pair.normal, pair.relative_weight, pair.on_own, {}};
    for (const auto& component : point.normal.c) element->normal.push_back(component.v);
    add_motion<dim>(*element, facet, point, moves);
    add_partner(*element, hit, pair, moves);
    element->gap.back() -= closed_film_;
  }
}

/// In space points keep their place on their facet, in the plane their part of a stretch.
template <int dim>
void EmbeddedSurface::add_covered(const std::vector<CoveredPoint>& points, const Surface& now) {
  for (const CoveredPoint& point : points) {
    const int facet = point.facet;
    Element* added = element_beside(covered, facet, -1);
    if (added == nullptr) continue;
    Element& element = *added;
    element.outside.weight.push_back(point.weight);
    element.own.weight.push_back(point.weight);
    own_->to_cell(facet, point.on_facet.data(), element.own.reference);
    const Corners<dim, Moves<dim, 1>> corners = moving_facet<dim, 1>(facet_vertices(now, facet));
    const Vec<dim, Moves<dim, 1>> area = area_vector<dim>(corners);
    const Moves<dim, 1> size = sqrt(dot(area, area));
    MovingPoint<dim, 1> moving;
    for (int k = 0; k + 1 < dim; ++k) moving.on_facet[k] = Moves<dim, 1>(point.on_facet[k]);
    moving.relative_weight = size / size.v;
    if constexpr (dim == 2) {
      const Moves<2, 1> length = point.to - point.from;
      moving.on_facet[0] = point.from + (point.on_facet[0] - point.from.v) / length.v * length;
      moving.relative_weight *= length / length.v;
    }
    moving.position = point_on<dim>(corners, moving.on_facet);
    moving.normal = (-1.0 / size) * area;
    for (int d = 0; d < dim; ++d) element.normal.push_back(moving.normal[d].v);
    add_motion<dim>(element, facet, moving, dim * dim);
  }
}

template <int dim>
void EmbeddedSurface::add_closed_point(const ClosedPoint& point, const std::vector<Edge>& edges,
                                       const OppositePoints& opposite) {
  const auto& [hit, stretch, weight] = point;
  const int facet = hit.own_facet;
  const Vector x = point_on_facet(dim, hit.pair.own, hit.pair.on_own.data());
  const auto nearest = std::min_element(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) {
    return dot(a.position - x, a.position - x) < dot(b.position - x, b.position - x);
  });
  if (nearest->rank != field_->mesh().communicator().rank()) return;
  const Element& source = elements_[nearest->part][nearest->element];
  Element fresh;
  fresh.outside.cell = source.outside.cell;
  fresh.outside.part = source.outside.part;
  fresh.group = own_->group(facet);
  fresh.other_group = other_->group(hit.facet);
  fresh.own_edge_group = source.group;
  // A wet point without an opposite one does not move with the other body: any of its cells will do.
  fresh.other_edge_group = source.other_group >= 0 ? source.other_group : fresh.other_group;
  fresh.trace_size = source.trace_size;
  std::vector<Element>& all = elements_[closed];
  auto found =
      std::find_if(all.rbegin(), all.rend(), [&](const Element& e) { return key_of(e) == key_of(fresh); });
  if (found == all.rend()) {
    all.push_back(std::move(fresh));
    found = all.rbegin();
  }
  Element& element = *found;
  for (CutPoints* points :
       {&element.outside, &element.own, &element.other, &element.own_edge, &element.other_edge})
    points->weight.push_back(weight);
  const MovingPair<dim> pair = opposite.moving<dim>(hit, stretch);
  for (const auto& component : pair.normal.c) element.normal.push_back(-component.v);
  own_->to_cell(facet, hit.pair.on_own.data(), element.own.reference);
  // Behind the moves of the two facets here come those of the two at the nearest wet point. Where the point
  // is in space tells that one.
  constexpr std::size_t moves = 4 * dim * dim;
  PointMotion& motion = element.motion;
  const int* places = own_->places(facet);
  motion.node.insert(motion.node.end(), places, places + dim);
  append_moves(own_->moved_in_cell<dim>(facet, pair.on_own), moves, motion.reference[1]);
  append_moves(-pair.normal, moves, motion.normal);
  append_moves(pair.relative_weight, moves, motion.relative_weight);
  add_partner(element, hit, pair, moves);
  add_edge(element, source, static_cast<std::size_t>(nearest->point));
}

/// Lets the last point of a closed element see a wet point, and move along with it.
void EmbeddedSurface::add_edge(Element& element, const Element& source, std::size_t point) const {
  const auto dim = static_cast<std::size_t>(dimension()), size = dim * dim;
  const std::size_t movers = source.other_group >= 0 ? 2 : 1;
  const auto copy = [&](const std::vector<double>& from, std::vector<double>& to) {
    to.insert(to.end(), &from[point * dim], &from[point * dim] + dim);
  };
  copy(source.outside.reference, element.outside.reference);
  copy(source.own.reference, element.own_edge.reference);
  if (movers == 2)
    copy(source.other.reference, element.other_edge.reference);
  else
    element.other_edge.reference.resize(element.other_edge.reference.size() + dim, 0.25);
  PointMotion& motion = element.motion;
  const int* node = &source.motion.node[point * movers * dim];
  motion.node.insert(motion.node.end(), node, node + movers * dim);
  motion.node.resize(motion.node.size() + (2 - movers) * dim, 0);
  const auto shifted = [&](const std::vector<double>& from, std::vector<double>& to) {
    const std::size_t moves = movers * size;
    for (std::size_t row = 0; row < dim; ++row) {
      const double* begin = &from[(point * dim + row) * moves];
      to.resize(to.size() + 2 * size, 0.0);
      to.insert(to.end(), begin, begin + moves);
      to.resize(to.size() + (2 - movers) * size, 0.0);
    }
  };
  shifted(source.motion.position, motion.position);
  shifted(source.motion.reference[1], motion.reference[3]);
  motion.reference[4].resize(motion.reference[4].size() + dim * 4 * size, 0.0);  // nothing is read there
}

}  // namespace seam
