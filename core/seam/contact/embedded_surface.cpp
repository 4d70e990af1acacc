// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "seam/base/diagnostics.hpp"
#include "seam/contact/embedded_motion.hpp"
#include "seam/cut/cut_boundary.hpp"
#include "seam/cut/facet_vertices.hpp"
#include "seam/cut/interface_motion.hpp"
#include "seam/mesh/quadrature.hpp"

namespace seam {

using namespace cutting;

namespace {

constexpr double rounding = 1e-9;  ///< of shares of a facet

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
      rule_(&quadrature(field.mesh().dimension() == 2 ? CellType::segment : CellType::triangle, degree_)) {
  for (int c = 0; c < field.mesh().cells(); ++c)
    closed_film_ = std::max(closed_film_, FieldCut::closed_film * field.mesh().diameter(c));
  closed_film_ = field.mesh().communicator().max(closed_film_);
}

bool EmbeddedSurface::follow() {
  const std::vector<Key> before = keys();
  for (auto& of_part : elements_) of_part.clear();
  for (auto& of_part : wet_points_) of_part.clear();
  wet_.clear();
  const OppositePoints opposite(*own_, other_.get(), own_->now(), other_->now(), window_);
  if (field_->cut())
    for (const int cell : field_->cut()->cut_cells()) {
      if (cell >= field_->mesh().owned_cells() || !field_->active_cells()[cell]) continue;
      for (int part = 0; part < field_->parts(cell); ++part)
        if (dimension() == 2)
          add_wet<2>(cell, part, opposite);
        else
          add_wet<3>(cell, part, opposite);
    }
  add_dry(opposite);
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
    if (stretch.from.vertex >= 0 && stretch.from.share > from) {
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
      wet_.push_back({facet, 0.0, 0.0, rule.weight[q]});
    } else {
      const bool ahead = on_cut.span[0].v <= on_cut.span[1].v;
      const Moves<2, 1>&from = on_cut.span[ahead ? 0 : 1], &to = on_cut.span[ahead ? 1 : 0];
      if (wet_.empty() || wet_.back().facet != facet || wet_.back().from.v != from.v)
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

}  // namespace seam
