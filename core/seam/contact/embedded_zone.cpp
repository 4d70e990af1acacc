// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <stdexcept>

#include "seam/contact/embedded_surface.hpp"

namespace seam {

EmbeddedZone::EmbeddedZone(std::shared_ptr<EmbeddedSurface> surface, EmbeddedSurface::Zone zone)
    : surface_(std::move(surface)),
      zone_(zone),
      movers_{{1, surface_->own().displacement()}},
      of_own_(surface_->own().body(), surface_->own().place()),
      of_other_(surface_->other().body(), surface_->other().place()) {
  if (zone == EmbeddedSurface::free || zone == EmbeddedSurface::covered) return;
  movers_.push_back({2, surface_->other().displacement()});
  if (zone != EmbeddedSurface::closed) return;
  movers_.push_back({3, surface_->own().displacement()});
  movers_.push_back({4, surface_->other().displacement()});
}

std::vector<Field*> EmbeddedZone::fields() const {
  std::vector<Field*> result{meets_field() ? &surface_->field() : &surface_->own().body(),
                             &surface_->own().body()};
  if (zone_ != EmbeddedSurface::free && zone_ != EmbeddedSurface::covered)
    result.push_back(&surface_->other().body());
  if (zone_ == EmbeddedSurface::closed) {
    result.push_back(&surface_->own().body());
    result.push_back(&surface_->other().body());
  }
  return result;
}

void EmbeddedZone::begin_step(double) {
  if (zone_ == EmbeddedSurface::free) surface_->begin_step();
}

bool EmbeddedZone::follow(double) { return zone_ == EmbeddedSurface::free && surface_->follow(); }

void EmbeddedZone::fill(int index, Element& element) const {
  const EmbeddedSurface::Element& from = surface_->elements(zone_)[index];
  element.dimension = surface_->field().mesh().dimension();
  element.points = static_cast<int>(from.outside.weight.size());
  element.sides.resize(fields().size());
  const auto attach = [&](int side, const BodySurface& surface, int group, const CutPoints& points) {
    surface.cell(group).attach(element.sides[side], surface.body());
    points.attach(element.sides[side], true);
  };
  if (meets_field()) {
    attach_cell(element.sides[0], surface_->field(), from.outside.cell, from.outside.part);
    from.outside.attach(element.sides[0], true);
  } else {
    attach(0, surface_->own(), from.group, from.own);
  }
  attach(1, surface_->own(), from.group, from.own);
  if (from.other_group >= 0) attach(2, surface_->other(), from.other_group, from.other);
  if (zone_ == EmbeddedSurface::closed) {
    attach(3, surface_->own(), from.own_edge_group, from.own_edge);
    attach(4, surface_->other(), from.other_edge_group, from.other_edge);
  }
  for (ElementSide& side : element.sides) side.map_geometry();
  element.weight = from.outside.weight;
  element.normal = from.normal;
  element.gap = from.gap;
  element.set_sizes(element.sides[0].diameter, from.trace_size);
  element.motion = &from.motion;
  element.constants.resize(constants_.size());
  for (std::size_t k = 0; k < constants_.size(); ++k) {
    const bool own = constants_[k].side == 1;
    const BodySurface& surface = own ? surface_->own() : surface_->other();
    const int group = own ? from.group : from.other_group;
    element.constants[k].assign(
        element.points, (own ? of_own_ : of_other_)
                            .value(constants_[k].number, group, surface.cell(group), surface.faces(group)));
  }
}

const int* EmbeddedZone::nodes(int index, int side, int block) const {
  const EmbeddedSurface::Element& from = surface_->elements(zone_)[index];
  switch (side) {
    case 0:
      if (!meets_field()) return surface_->own().cell(from.group).nodes[block].data();
      return surface_->field().cell_nodes(block, from.outside.cell, from.outside.part);
    case 1:
      return surface_->own().cell(from.group).nodes[block].data();
    case 2:
      return surface_->other().cell(from.other_group).nodes[block].data();
    case 3:
      return surface_->own().cell(from.own_edge_group).nodes[block].data();
    default:
      return surface_->other().cell(from.other_edge_group).nodes[block].data();
  }
}

int EmbeddedZone::add_constant(int side, std::shared_ptr<const CellConstant> constant, int region) {
  if (side != 1 && side != 2)
    throw std::logic_error("an embedded surface keeps constants of the bodies' cells only");
  constants_.push_back({side, (side == 1 ? of_own_ : of_other_).add(std::move(constant), region)});
  return static_cast<int>(constants_.size()) - 1;
}

void EmbeddedZone::forget_constants(bool new_step) {
  for (CellConstants* constants : {&of_own_, &of_other_})
    constants->forget(new_step ? CellConstant::Refresh::step : CellConstant::Refresh::iteration);
}

std::string EmbeddedZone::description() const {
  constexpr const char* name[] = {"free", "near", "closed", "shut", "covered"};
  return fmt::format("the {} surface of '{}' in field '{}'", name[zone_], surface_->own().body().name(),
                     surface_->field().name());
}

}  // namespace seam
