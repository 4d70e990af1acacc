// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/embedded_interface.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "seam/cut/cut_boundary.hpp"
#include "seam/cut/field_cut.hpp"
#include "seam/cut/interface_motion.hpp"
#include "seam/interface/cell_constant.hpp"
#include "seam/interface/cell_constants.hpp"
#include "seam/surface/body_surface.hpp"
#include "seam/surface/moving_facet.hpp"

namespace seam {
namespace {

class EmbeddedBoundary final : public CutBoundary {
 public:
  EmbeddedBoundary(Field& field, const FieldCut& cut, int body, int degree,
                   std::shared_ptr<const BodySurface> surface)
      : CutBoundary(field, cut, body, degree),
        surface_(std::move(surface)),
        movers_{{1, surface_->displacement()}},
        constants_(surface_->body(), surface_->place()) {}
  [[nodiscard]] const std::vector<Operand>& movers() const override { return movers_; }
  [[nodiscard]] int swept_side() const override { return 0; }
  int add_constant(int side, std::shared_ptr<const CellConstant> constant, int region) override {
    if (side != 1) throw std::logic_error("an embedded interface keeps constants of its body's cells only");
    return constants_.add(std::move(constant), region);
  }
  void forget_constants(bool new_step) override {
    constants_.forget(new_step ? CellConstant::Refresh::step : CellConstant::Refresh::iteration);
  }
  [[nodiscard]] std::vector<Field*> fields() const override {
    return {CutBoundary::fields().front(), &surface_->body()};
  }
  void fill(int index, Element& element) const override {
    element.sides.resize(2);
    CutBoundary::fill(index, element);
    surface_->cell(piece(index).group).attach(element.sides[1], surface_->body());
    piece(index).partner.attach(element.sides[1], true);
    element.sides[1].map_geometry();
    element.constants.resize(constants_.count());
    for (int k = 0; k < constants_.count(); ++k) {
      const int group = piece(index).group;
      element.constants[k].assign(element.points,
                                  constants_.value(k, group, surface_->cell(group), surface_->faces(group)));
    }
  }
  [[nodiscard]] const int* nodes(int index, int side, int block) const override {
    return side == 0 ? CutBoundary::nodes(index, side, block)
                     : surface_->cell(piece(index).group).nodes[block].data();
  }
  [[nodiscard]] std::string description() const override {
    return fmt::format("the surface of '{}' in field '{}'", surface_->body().name(),
                       CutBoundary::fields().front()->name());
  }

 private:
  [[nodiscard]] int group(int facet) const override { return surface_->group(facet); }
  void add_partner(PointGroup& piece, const InterfaceRule& rule, const InterfaceMotion& motion,
                   const std::vector<int>& points) const override {
    if (surface_->body().mesh().dimension() == 2)
      add_partner<2>(piece, rule, motion, points);
    else
      add_partner<3>(piece, rule, motion, points);
  }
  template <int dim>
  void add_partner(PointGroup& piece, const InterfaceRule& rule, const InterfaceMotion& motion,
                   const std::vector<int>& points) const {
    constexpr std::size_t moves = dim * dim;
    PointMotion& moving = piece.motion;
    for (const int q : points) {
      const int facet = rule.facet[q];
      const MovingPoint<dim, 1>& point = motion.points<dim>()[q];
      surface_->to_cell(facet, &rule.facet_reference[static_cast<std::size_t>(q) * (dim - 1)],
                        piece.partner.reference);
      const int* places = surface_->places(facet);
      moving.node.insert(moving.node.end(), places, places + dim);
      append_moves(surface_->moved_in_cell<dim>(facet, point.on_facet), moves, moving.reference[1]);
      append_moves(point.position, moves, moving.position);
      append_moves(point.normal, moves, moving.normal);
      append_moves(point.relative_weight, moves, moving.relative_weight);
    }
    piece.partner.weight = piece.weight;
  }
  std::shared_ptr<const BodySurface> surface_;
  std::vector<Operand> movers_;
  mutable CellConstants constants_;  ///< computed when they are asked for
};

}  // namespace

Schema EmbeddedInterface::schema() {
  Schema s("The surface of a field's deforming mesh, cut out of another field's mesh.");
  s.reference("field", "The field that lies outside the body", "field");
  s.reference("body", "The field whose mesh is the body", "field");
  s.names("boundaries", "Parts of the body's boundary; default all").naming("boundary:body").otherwise("[]");
  declare_backing(s, "body");
  return s;
}

std::vector<InterfacePart> EmbeddedInterface::build(InterfaceSetup& setup) const {
  const std::string displacement = setup.displacement(1);
  if (displacement.empty())
    throw Error(parameters_.where("body"),
                fmt::format("field '{}' has no displacement, so that it cannot be a body in another field",
                            parameters_.text("body")));
  auto surface = std::make_shared<const BodySurface>(*setup.sides[1], parameters_.names("boundaries"),
                                                     displacement, backing_of(parameters_));
  FieldCut& cut = setup.cut(0);
  const int number = cut.add_body([surface](double) { return surface->now(); }, setup.sides[1]->name());
  return {
      {"", std::make_shared<EmbeddedBoundary>(*setup.sides[0], cut, number, facet_degree(setup), surface)}};
}

}  // namespace seam
