// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <stdexcept>

#include "seam/contact/surface_in_fluid.hpp"

namespace seam {

SurfacePart::SurfacePart(std::shared_ptr<SurfaceInFluid> surface, SurfaceInFluid::Part part)
    : surface_(std::move(surface)),
      part_(part),
      movers_{{1, surface_->own().displacement()}},
      of_own_(surface_->own().body(), surface_->own().place()),
      of_other_(surface_->other().body(), surface_->other().place()) {
  if (part != SurfaceInFluid::free) movers_.push_back({2, surface_->other().displacement()});
  if (part != SurfaceInFluid::closed) return;
  movers_.push_back({3, surface_->own().displacement()});
  movers_.push_back({4, surface_->other().displacement()});
}

std::vector<Field*> SurfacePart::fields() const {
  std::vector<Field*> result{&surface_->fluid(), &surface_->own().body()};
  if (part_ != SurfaceInFluid::free) result.push_back(&surface_->other().body());
  if (part_ == SurfaceInFluid::closed) {
    result.push_back(&surface_->own().body());
    result.push_back(&surface_->other().body());
  }
  return result;
}

bool SurfacePart::follow(double) { return part_ == SurfaceInFluid::free && surface_->follow(); }

void SurfacePart::fill(int index, Element& element) const {
  const SurfaceInFluid::Element& from = surface_->elements(part_)[index];
  element.dimension = surface_->fluid().mesh().dimension();
  element.points = static_cast<int>(from.fluid.weight.size());
  element.sides.resize(fields().size());
  attach_cell(element.sides[0], surface_->fluid(), from.fluid.cell, from.fluid.part);
  from.fluid.attach(element.sides[0], true);
  const auto attach = [&](int side, const BodySurface& surface, int group, const CutPoints& points) {
    surface.cell(group).attach(element.sides[side], surface.body());
    points.attach(element.sides[side], true);
  };
  attach(1, surface_->own(), from.group, from.own);
  if (part_ != SurfaceInFluid::free) attach(2, surface_->other(), from.other_group, from.other);
  if (part_ == SurfaceInFluid::closed) {
    attach(3, surface_->own(), from.own_edge_group, from.own_edge);
    attach(4, surface_->other(), from.other_edge_group, from.other_edge);
  }
  for (ElementSide& side : element.sides) side.map_geometry();
  element.weight = from.fluid.weight;
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

const int* SurfacePart::nodes(int index, int side, int block) const {
  const SurfaceInFluid::Element& from = surface_->elements(part_)[index];
  switch (side) {
    case 0:
      return surface_->fluid().cell_nodes(block, from.fluid.cell, from.fluid.part);
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

int SurfacePart::add_constant(int side, std::shared_ptr<const CellConstant> constant) {
  if (side != 1 && side != 2)
    throw std::logic_error("a surface in a fluid keeps constants of the bodies' cells only");
  constants_.push_back({side, (side == 1 ? of_own_ : of_other_).add(std::move(constant))});
  return static_cast<int>(constants_.size()) - 1;
}

void SurfacePart::forget_constants(bool new_step) {
  for (CellConstants* constants : {&of_own_, &of_other_})
    constants->forget(new_step ? CellConstant::Refresh::step : CellConstant::Refresh::iteration);
}

std::string SurfacePart::description() const {
  constexpr const char* name[] = {"free", "near", "closed"};
  return fmt::format("the {} surface of '{}' in field '{}'", name[part_], surface_->own().body().name(),
                     surface_->fluid().name());
}

}  // namespace seam
