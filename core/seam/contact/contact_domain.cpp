// SPDX-License-Identifier: BSD-3-Clause
#include "seam/contact/contact_domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "seam/contact/left_out_nodes.hpp"
#include "seam/mesh/quadrature.hpp"

namespace seam {

using namespace cutting;

namespace {

/// The facets behind which cells of this rank lie.
std::vector<int> owned_facets(const BodySurface& surface) {
  const Mesh& mesh = surface.body().mesh();
  std::vector<int> result;
  for (int f = 0; f < surface.facet_count(); ++f)
    if (mesh.owner_of_global_cell()[surface.cell(surface.group(f)).global_cell] == mesh.communicator().rank())
      result.push_back(f);
  return result;
}

}  // namespace

ContactDomain::ContactDomain(std::shared_ptr<const BodySurface> own, std::shared_ptr<const BodySurface> other,
                             ContactWindow window, int degree)
    : own_(std::move(own)),
      other_(std::move(other)),
      window_(window),
      rule_(
          &quadrature(own_->body().mesh().dimension() == 2 ? CellType::segment : CellType::triangle, degree)),
      facets_(owned_facets(*own_)),
      of_side_{{own_->body(), own_->place()}} {
  measure_cells();
  if (other_) of_side_.emplace_back(other_->body(), other_->place());
}

ContactDomain::ContactDomain(std::shared_ptr<const BodySurface> own, std::shared_ptr<const BodySurface> other,
                             MovingSurface obstacle, ContactWindow window, int degree)
    : ContactDomain(std::move(own), std::move(other), window, degree) {
  obstacle_ = std::move(obstacle);
  passage_ = std::make_unique<Passage>(own_, other_, window);
  movers_.push_back({0, own_->displacement()});
  if (other_) movers_.push_back({1, other_->displacement()});
}

void ContactDomain::measure_cells() {
  const Mesh& mesh = own_->body().mesh();
  std::map<int, double> volume;  // by global cell
  for (int c = 0; c < mesh.owned_cells(); ++c) volume[mesh.global_cell(c)] = mesh.volume(c);
  std::map<std::pair<int, int>, double> area;  // by global cell and face
  for (int f = 0; f < own_->facet_count(); ++f)
    area[{own_->parent(f).cell, own_->parent(f).face}] += own_->rest_area(f);
  for (const int f : facets_) {
    const CellFace& face = own_->parent(f);
    trace_size_[f] = volume.at(face.cell) / area.at({face.cell, face.face});
  }
}

std::vector<Field*> ContactDomain::fields() const {
  if (!other_) return {&own_->body()};
  return {&own_->body(), &other_->body()};
}

OppositePoints ContactDomain::look_from(double time) const {
  if (is_at_rest()) return {*own_, other_.get(), own_->at_rest(), other_->at_rest(), window_};
  return {*own_, other_.get(), own_->now(), opposite_at(time), window_};
}

ContactDomain::Sight ContactDomain::look(double time) const {
  const OppositePoints opposite = look_from(time);
  const int dim = own_->body().mesh().dimension();
  double area = 0, seen = 0, farthest = 0, deepest = 0;
  for (const int facet : facets_)
    for (const OppositePoints::Stretch& stretch : opposite.stretches(facet))
      for (int q = 0; q < rule_->count(); ++q) {
        std::array<double, 2> on_facet{};
        std::copy_n(&rule_->points[static_cast<std::size_t>(q) * (dim - 1)], dim - 1, on_facet.begin());
        if (dim == 2) on_facet[0] = stretch.from.share + on_facet[0] * stretch.length();
        const double weight = opposite.area(facet) * stretch.length() * rule_->weights[q];
        const auto hit = opposite.find(facet, on_facet.data());
        area += weight;
        if (hit) {
          seen += weight;
          farthest = std::max(farthest, std::abs(hit->pair.gap));
        } else {
          // Surfaces need not be closed: what is not much further behind may be the other body's.
          const auto behind = opposite.facing(facet, on_facet.data(), 4 * window_.depth, 0);
          if (behind && behind->gap < 0) deepest = std::max(deepest, -behind->gap);
        }
      }
  const Communicator& communicator = own_->body().mesh().communicator();
  area = communicator.sum(area);
  seen = communicator.sum(seen);
  return {seen / area, communicator.max(farthest), communicator.max(deepest), window_.depth};
}

bool ContactDomain::follow(double time) {
  if (is_at_rest() && is_found_) return false;
  is_found_ = true;
  std::vector<Pairing> before;
  for (const PairPoints& points : elements_) before.push_back({points.facet, points.opposite_group});
  elements_.clear();
  const OppositePoints opposite = look_from(time);
  for (const int facet : facets_) add_facet(opposite, facet);
  if (is_at_rest()) return !elements_.empty();
  double least_gap = 0;
  for (const PairPoints& points : elements_)
    least_gap = std::min(least_gap, *std::ranges::min_element(points.gap));
  passage_->check(opposite, own_->body().mesh().communicator().min(least_gap));
  return !std::ranges::equal(before, elements_, [](const Pairing& pairing, const PairPoints& points) {
    return pairing == Pairing{points.facet, points.opposite_group};
  });
}

void ContactDomain::add_facet(const OppositePoints& opposite, int facet) {
  const int dim = own_->body().mesh().dimension();
  const double area = opposite.area(facet);
  for (const OppositePoints::Stretch& stretch : opposite.stretches(facet))
    for (int q = 0; q < rule_->count(); ++q) {
      std::array<double, 2> on_facet{};
      std::copy_n(&rule_->points[static_cast<std::size_t>(q) * (dim - 1)], dim - 1, on_facet.begin());
      if (dim == 2) on_facet[0] = stretch.from.share + on_facet[0] * stretch.length();
      const auto hit = opposite.find(facet, on_facet.data());
      if (!hit) continue;
      const double weight = area * stretch.length() * rule_->weights[q];
      if (dim == 2)
        add_point(*hit, weight, opposite.moving<2>(*hit, stretch));
      else
        add_point(*hit, weight, opposite.moving<3>(*hit, stretch));
    }
}

template <int dim>
void ContactDomain::add_point(const OppositePoints::Hit& hit, double weight, const MovingPair<dim>& moving) {
  const std::size_t moves = movers_.size() * dim * dim;
  PairPoints& to = points_of(hit.own_facet, other_ ? other_->group(hit.facet) : -1);
  to.own.weight.push_back(weight);
  own_->to_cell(hit.own_facet, hit.pair.on_own.data(), to.own.reference);
  for (const auto& component : moving.normal.c) to.normal.push_back(component.v);
  to.gap.push_back(hit.pair.gap);
  PointMotion& motion = to.motion;
  motion.node.insert(motion.node.end(), own_->places(hit.own_facet), own_->places(hit.own_facet) + dim);
  motion.position.resize(motion.position.size() + dim * moves, 0.0);
  append_moves(own_->moved_in_cell<dim>(hit.own_facet, moving.on_own), moves, motion.reference[0]);
  append_moves(moving.normal, moves, motion.normal);
  append_moves(moving.relative_weight, moves, motion.relative_weight);
  append_moves(moving.gap, moves, motion.gap);
  if (!other_) return;
  other_->to_cell(hit.facet, hit.pair.on_opposite.data(), to.opposite.reference);
  to.opposite.weight = to.own.weight;
  motion.node.insert(motion.node.end(), other_->places(hit.facet), other_->places(hit.facet) + dim);
  append_moves(other_->moved_in_cell<dim>(hit.facet, moving.on_opposite), moves, motion.reference[1]);
}

/// The element of a facet and a cell opposite to it, among those of the facet under work.
ContactDomain::PairPoints& ContactDomain::points_of(int facet, int opposite_group) {
  for (auto found = elements_.rbegin(); found != elements_.rend() && found->facet == facet; ++found)
    if (found->opposite_group == opposite_group) return *found;
  PairPoints& added = elements_.emplace_back();
  added.facet = facet;
  added.group = own_->group(facet);
  added.opposite_group = opposite_group;
  return added;
}

void ContactDomain::fill(int index, Element& element) const {
  const PairPoints& points = elements_[index];
  element.dimension = own_->body().mesh().dimension();
  element.points = static_cast<int>(points.own.weight.size());
  element.sides.resize(other_ ? 2 : 1);
  own_->cell(points.group).attach(element.sides[0], own_->body());
  points.own.attach(element.sides[0], true);
  hand_on_functions(own_->body(), own_->parent(points.facet).face, element.sides[0]);
  element.sides[0].map_geometry();
  if (other_) {
    other_->cell(points.opposite_group).attach(element.sides[1], other_->body());
    points.opposite.attach(element.sides[1], true);
    element.sides[1].map_geometry();
  }
  element.weight = points.own.weight;
  element.normal = points.normal;
  element.gap = points.gap;
  element.set_sizes(element.sides[0].diameter, trace_size_.at(points.facet));
  element.motion = &points.motion;
  element.constants.resize(constants_.size());
  for (std::size_t k = 0; k < constants_.size(); ++k) {
    const int side = constants_[k].side;
    const BodySurface& surface = side == 0 ? *own_ : *other_;
    const int group = side == 0 ? points.group : points.opposite_group;
    element.constants[k].assign(
        element.points,
        of_side_[side].value(constants_[k].number, group, surface.cell(group), surface.faces(group)));
  }
}

const int* ContactDomain::nodes(int index, int side, int block) const {
  const PairPoints& points = elements_[index];
  return side == 0 ? own_->cell(points.group).nodes[block].data()
                   : other_->cell(points.opposite_group).nodes[block].data();
}

int ContactDomain::add_constant(int side, std::shared_ptr<const CellConstant> constant, int region) {
  constants_.push_back({side, of_side_.at(side).add(std::move(constant), region)});
  return static_cast<int>(constants_.size()) - 1;
}

void ContactDomain::forget_constants(bool new_step) {
  for (CellConstants& constants : of_side_)
    constants.forget(new_step ? CellConstant::Refresh::step : CellConstant::Refresh::iteration);
}

std::string ContactDomain::description() const {
  return fmt::format("the surface of '{}' opposite to {}", own_->body().name(),
                     !other_ ? "an obstacle" : fmt::format("'{}'", other_->body().name()));
}

}  // namespace seam
