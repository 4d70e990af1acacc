// SPDX-License-Identifier: BSD-3-Clause
#include "seam/contact/embedded_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "seam/base/diagnostics.hpp"
#include "seam/contact/facet_vertices.hpp"
#include "seam/cut/cut_boundary.hpp"
#include "seam/cut/interface_motion.hpp"
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

EmbeddedSurface::EmbeddedSurface(Field& field, const FieldCut& cut, int number,
                                 std::shared_ptr<const BodySurface> own,
                                 std::shared_ptr<const BodySurface> other, ContactWindow window, int degree)
    : field_(&field),
      cut_(&cut),
      number_(number),
      degree_(degree),
      own_(std::move(own)),
      other_(std::move(other)),
      window_(window),
      passage_(own_, other_, window),
      rule_(&quadrature(field.mesh().dimension() == 2 ? CellType::segment : CellType::triangle, degree_)) {}

bool EmbeddedSurface::follow() {
  const std::vector<Key> before = keys();
  for (auto& of_part : elements_) of_part.clear();
  for (auto& of_part : wet_points_) of_part.clear();
  wet_.clear();
  const OppositePoints opposite(*own_, other_.get(), other_->now(), window_);
  if (field_->cut())
    for (const int cell : field_->cut()->cut_cells()) {
      if (cell >= field_->mesh().owned_cells() || !field_->active_cells()[cell]) continue;
      for (int part = 0; part < field_->parts(cell); ++part)
        if (dimension() == 2)
          add_wet<2>(cell, part, opposite);
        else
          add_wet<3>(cell, part, opposite);
    }
  add_closed(opposite);
  double least_gap = 0;
  for (const auto& of_part : elements_)
    for (const Element& element : of_part)
      for (const double gap : element.gap) least_gap = std::min(least_gap, gap);
  passage_.check(opposite, field_->mesh().communicator().min(least_gap));
  return before != keys();
}

std::vector<EmbeddedSurface::Key> EmbeddedSurface::keys() const {
  std::vector<Key> result;
  for (const auto& of_part : elements_)
    for (const Element& e : of_part) result.push_back(key_of(e));
  return result;
}

EmbeddedSurface::Key EmbeddedSurface::key_of(const Element& e) {
  return {e.outside.cell, e.outside.part, e.group, e.other_group, e.own_edge_group, e.other_edge_group};
}

/// In the plane: where on a wet part of a facet the facet opposite changes.
/// @param moving appended: the same places, with the vertices that they follow
std::vector<double> EmbeddedSurface::divide(int facet, double from, double to, const OppositePoints& opposite,
                                            std::vector<OppositePoints::Break>& moving) {
  std::vector<double> places;
  for (const OppositePoints::Stretch& stretch : opposite.stretches(facet, from, to))
    if (stretch.from.vertex >= 0) {
      places.push_back(stretch.from.share);
      moving.push_back(stretch.from);
    }
  return places;
}

template <int dim>
void EmbeddedSurface::add_wet(int cell, int part, const OppositePoints& opposite) {
  InterfaceRule rule;
  InterfaceMotion motion;
  std::map<int, std::vector<OppositePoints::Break>> inner;  // by facet
  field_->cut()->interface_rule(
      cell, degree_, rule, &motion, part, [&](int body, int facet, double from, double to) {
        return body == number_ ? divide(facet, from, to, opposite, inner[facet]) : std::vector<double>{};
      });
  std::map<std::pair<int, int>, std::pair<Zone, int>> place;  // of an element, by the groups of its points
  for (int q = 0; q < rule.count(); ++q) {
    if (rule.body[q] != number_) continue;
    const auto at = static_cast<std::size_t>(q);
    const int facet = rule.facet[q];
    const MovingPoint<dim, 1>& on_cut = motion.points<dim>()[at];
    if constexpr (dim == 3) {
      wet_.push_back({facet, 0, 0, rule.weight[q]});
    } else {
      const auto [from, to] = std::minmax(rule.span[2 * at], rule.span[2 * at + 1]);
      if (wet_.empty() || wet_.back().facet != facet || wet_.back().from != from)
        wet_.push_back({facet, from, to, 0});
    }
    const double* on_facet = &rule.facet_reference[at * (dim - 1)];
    auto hit = opposite.find(facet, on_facet);
    const bool is_opposite = hit.has_value();
    OppositePoints::Stretch stretch{};
    if constexpr (dim == 2) {
      stretch = stretch_at(facet, &rule.span[2 * at], inner[facet], opposite);
      if (!hit && (stretch.from.follows() || stretch.to.follows()))
        hit = opposite.far_hit(facet, on_facet, std::max(stretch.from.facet, stretch.to.facet));
    }
    const int group = own_->group(facet), other_group = hit ? other_->group(hit->facet) : -1;
    const Zone which = hit ? near : free;
    const auto [found, is_new] = place.try_emplace({group, other_group}, which, elements_[which].size());
    if (is_new) {
      Element& added = elements_[which].emplace_back();
      added.outside.cell = cell;
      added.outside.part = part;
      added.group = group;
      added.other_group = other_group;
      added.trace_size = cut_->trace_size(cell);
    }
    Element& element = elements_[which][found->second.second];
    Edge& wet_point = wet_points_[which].emplace_back();
    wet_point = {{},
                 field_->mesh().communicator().rank(),
                 which,
                 found->second.second,
                 static_cast<int>(element.outside.weight.size())};
    std::copy_n(&rule.position[at * dim], dim, wet_point.position.begin());
    element.outside.weight.push_back(rule.weight[q]);
    for (std::size_t d = 0; d < dim; ++d) {
      element.outside.reference.push_back(rule.reference[at * dim + d]);
      element.normal.push_back(rule.normal[at * dim + d]);
    }
    own_->to_cell(facet, on_facet, element.own.reference);
    element.own.weight.push_back(rule.weight[q]);
    if (!hit) {
      add_motion<dim>(element, facet, on_cut, dim * dim);
      continue;
    }
    element.other.weight.push_back(rule.weight[q]);
    MovingPair<dim> pair(hit->pair);
    MovingPoint<dim, 2> moving = widened(on_cut);
    if constexpr (dim == 2) follow_ends(*hit, stretch, opposite, pair, moving);
    add_motion<dim>(element, facet, moving, 2 * dim * dim);
    pair.on_own = moving.on_facet;
    if (is_opposite) pair.look();
    add_partner(element, *hit, pair, 2 * dim * dim);
  }
}

OppositePoints::Stretch EmbeddedSurface::stretch_at(int facet, const double* span,
                                                    const std::vector<OppositePoints::Break>& inner,
                                                    const OppositePoints& opposite) {
  const auto end_at = [&](double share) {
    const auto found = std::ranges::find_if(
        inner, [&](const OppositePoints::Break& b) { return std::abs(b.share - share) < rounding; });
    return found != inner.end() ? *found : opposite.end_at(facet, share);
  };
  return {end_at(span[0]), end_at(span[1])};
}

/// In the plane: points keep their share of a piece, and the cut lets one that ends on another body keep its
/// place on the facet. Lets such ends follow that body, and inner ends the vertices opposite.
void EmbeddedSurface::follow_ends(const OppositePoints::Hit& hit, OppositePoints::Stretch stretch,
                                  const OppositePoints& opposite, MovingPair<2>& pair,
                                  MovingPoint<2, 2>& point) {
  // A point knows one facet only.
  for (OppositePoints::Break* end : {&stretch.from, &stretch.to})
    if (end->crosses() && end->facet != hit.facet) *end = {end->share};
  if (!stretch.from.follows() && !stretch.to.follows()) return;
  const auto end_at = [&](const OppositePoints::Break& end, Moves<2, 2> on_cut) {
    if (end.follows()) return opposite.place_of(end, hit, pair);
    on_cut.v = end.share;
    return on_cut;
  };
  pair.keep_part(end_at(stretch.from, point.span[0]), end_at(stretch.to, point.span[1]));
  point.on_facet = pair.on_own;
  point.position = point_on<2>(pair.own, pair.on_own);
  point.relative_weight = pair.relative_weight;
}

/// Of the last point added.
template <int dim, int facets>
void EmbeddedSurface::add_motion(Element& element, int facet, const MovingPoint<dim, facets>& point,
                                 std::size_t moves) const {
  PointMotion& motion = element.motion;
  const int* places = own_->places(facet);
  motion.node.insert(motion.node.end(), places, places + dim);
  append_moves(point.position, moves, motion.position);
  append_moves(point.normal, moves, motion.normal);
  append_moves(point.relative_weight, moves, motion.relative_weight);
  append_moves(own_->moved_in_cell<dim>(facet, point.on_facet), moves, motion.reference[1]);
}

template <int dim>
void EmbeddedSurface::add_partner(Element& element, const OppositePoints::Hit& hit,
                                  const MovingPair<dim>& pair, std::size_t moves) const {
  other_->to_cell(hit.facet, hit.pair.on_opposite.data(), element.other.reference);
  element.gap.push_back(hit.pair.gap);
  PointMotion& motion = element.motion;
  const int* places = other_->places(hit.facet);
  motion.node.insert(motion.node.end(), places, places + dim);
  append_moves(other_->moved_in_cell<dim>(hit.facet, pair.on_opposite), moves, motion.reference[2]);
  append_moves(pair.gap, moves, motion.gap);
}

void EmbeddedSurface::add_closed(const OppositePoints& opposite) {
  const Communicator& communicator = field_->mesh().communicator();
  std::vector<Wet> wet = communicator.gather_all(wet_);
  std::ranges::stable_sort(wet, {}, &Wet::facet);
  std::vector<ClosedPoint> points;  // the same on all ranks
  auto from = wet.begin();
  for (int facet = 0; facet < own_->facet_count(); ++facet) {
    const auto to = std::find_if(from, wet.end(), [&](const Wet& w) { return w.facet != facet; });
    find_closed(facet, {from, to}, opposite, points);
    from = to;
  }
  if (points.empty()) return;
  // The nearest wet point is one of those that face the other body, where there are any.
  std::vector<Edge> edges = communicator.gather_all(wet_points_[near]);
  if (edges.empty()) edges = communicator.gather_all(wet_points_[free]);
  if (edges.empty())
    throw StepRefused(
        fmt::format("no point of the surface of '{}' is in the field '{}': nothing says what "
                    "its closed parts push against",
                    own_->body().name(), field_->name()));
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

/// Appends the points of a facet's closed part that have an opposite one.
void EmbeddedSurface::find_closed(int facet, const std::vector<Wet>& wet, const OppositePoints& opposite,
                                  std::vector<ClosedPoint>& points) const {
  const double area = opposite.area(facet);
  if (dimension() == 2) {
    std::vector<std::pair<double, double>> parts;
    for (const Wet& w : wet) parts.emplace_back(w.from, w.to);
    for (const auto& [from, to] : rest(parts))
      for (const OppositePoints::Stretch& stretch : opposite.stretches(facet, from, to))
        for (int q = 0; q < rule_->count(); ++q) {
          const double share = stretch.from.share + rule_->points[q] * stretch.length();
          if (const auto hit = opposite.find(facet, &share))
            points.push_back({*hit, stretch, area * stretch.length() * rule_->weights[q]});
          else
            refuse_passed(facet, &share, opposite);
        }
    return;
  }
  // In space the closed points of a facet that is closed in part are those behind the other surface; together
  // they stand for all that is not wet.
  double left = area / 2;
  for (const Wet& w : wet) left -= w.area;
  if (left <= rounding * area) return;
  const bool all = wet.empty();
  const auto first = static_cast<std::ptrdiff_t>(points.size());
  double sum = 0;
  for (int q = 0; q < rule_->count(); ++q) {
    const double* point = &rule_->points[static_cast<std::size_t>(q) * 2];
    const auto hit = opposite.find(facet, point);
    if (!hit && all) refuse_passed(facet, point, opposite);
    if (!hit || (!all && hit->pair.gap >= 0)) continue;
    points.push_back({*hit, {{0}, {1}}, area * rule_->weights[q]});
    sum += points.back().weight;
  }
  const double scale = all ? 1.0 : std::min(2.0, left / sum);
  std::for_each(points.begin() + first, points.end(), [&](ClosedPoint& point) { point.weight *= scale; });
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
