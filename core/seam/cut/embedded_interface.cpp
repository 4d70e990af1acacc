// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/embedded_interface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "seam/cut/cut_boundary.hpp"
#include "seam/cut/field_cut.hpp"

namespace seam {
namespace {

/// A body's surface with the cells behind it. Every rank holds all of it: surfaces are small beside volumes.
class BodySurface {
 public:
  BodySurface(Field& body, const std::vector<std::string>& boundaries, const std::string& displacement)
      : body_(&body),
        boundary_(body_boundary(body.mesh().whole(), boundaries)),
        place_(body.place(displacement)) {
    const Space& space = *body.blocks()[place_.block].space;
    if (space.order() != body.mesh().order())
      throw Error(
          fmt::format("the displacement of field '{}' has order {}, its mesh order {}: a body that cuts "
                      "another mesh needs both alike; give its mesh the order of its displacement",
                      body.name(), space.order(), body.mesh().order()));
    std::map<int, int> group;  // of a global cell
    std::vector<int> cells;
    for (const CellFace& parent : boundary_.parent) {
      const auto [found, is_new] = group.emplace(parent.cell, static_cast<int>(cells.size()));
      if (is_new) {
        cells.push_back(parent.cell);
        faces_.emplace_back();
      }
      group_.push_back(found->second);
      auto& faces = faces_[found->second];
      if (std::find(faces.begin(), faces.end(), parent.face) == faces.end()) faces.push_back(parent.face);
    }
    cells_ = fetch_cells(body, cells);
    for (const int node : boundary_.node) node_.push_back(space.local_node(node));
    mover_ = {1, displacement};
    find_places();
  }

  /// As it is deformed now.
  [[nodiscard]] Surface now() const {
    Surface surface = boundary_.surface;
    const Block& block = body_->blocks()[place_.block];
    const int dim = surface.dimension;
    for (std::size_t k = 0; k < node_.size(); ++k)
      for (int d = 0; d < dim; ++d)
        surface.points[k * dim + d] +=
            block.now.value[static_cast<std::size_t>(node_[k]) * block.size + place_.offset + d];
    return surface;
  }
  [[nodiscard]] const Operand& mover() const { return mover_; }
  /// Which nodes of the cell behind a facet the facet's vertices are, [dimension].
  [[nodiscard]] const int* places(int facet) const {
    return &place_in_cell_[static_cast<std::size_t>(facet) * body_->mesh().dimension()];
  }
  [[nodiscard]] Field& body() const { return *body_; }
  /// Number of the cell behind a facet, among those of the surface.
  [[nodiscard]] int group(int facet) const { return group_[facet]; }
  [[nodiscard]] const RemoteCell& cell(int group) const { return cells_[group]; }
  /// All faces of a cell that are part of the surface.
  [[nodiscard]] const std::vector<int>& faces(int group) const { return faces_[group]; }
  [[nodiscard]] const Field::Place& displacement() const { return place_; }
  /// Reference coordinates, in the cell behind a facet, of a point on it.
  /// @param on_facet the facet's own coordinates, [dimension - 1]
  void to_cell(int facet, const double* on_facet, std::vector<double>& reference) const {
    const int dim = body_->mesh().dimension();
    for (int d = 0; d < dim; ++d) {
      double x = corner(facet, 0, d);
      for (int k = 1; k < dim; ++k) x += on_facet[k - 1] * edge(facet, k, d);
      reference.push_back(x);
    }
  }
  /// The same for a point's motions relative to the facet. @param on_facet [dimension - 1][move]
  void motion_to_cell(int facet, const double* on_facet, std::vector<double>& reference) const {
    const int dim = body_->mesh().dimension(), moves = dim * dim;
    for (int d = 0; d < dim; ++d)
      for (int m = 0; m < moves; ++m) {
        double x = 0;
        for (int k = 1; k < dim; ++k) x += on_facet[(k - 1) * moves + m] * edge(facet, k, d);
        reference.push_back(x);
      }
  }

 private:
  /// Reference coordinate d of vertex k of a facet, and of the way to it from vertex 0.
  [[nodiscard]] double corner(int facet, int k, int d) const {
    const CellTopology& cell = topology(body_->mesh().type());
    const int node = boundary_.local[static_cast<std::size_t>(facet) * cell.dimension + k];
    return cell.node_coordinates[static_cast<std::size_t>(node) * cell.dimension + d];
  }
  [[nodiscard]] double edge(int facet, int k, int d) const {
    return corner(facet, k, d) - corner(facet, 0, d);
  }
  void find_places();

  Field* body_;
  BodyBoundary boundary_;
  Field::Place place_;
  std::vector<int> group_;               ///< [facet]
  std::vector<std::vector<int>> faces_;  ///< [group]
  std::vector<RemoteCell> cells_;
  std::vector<int> node_;           ///< [point]: local node
  std::vector<int> place_in_cell_;  ///< [facet][dimension]
  Operand mover_;
};

void BodySurface::find_places() {
  const int dim = body_->mesh().dimension();
  const Space& space = *body_->blocks()[place_.block].space;
  for (int facet = 0; facet < boundary_.surface.facet_count(); ++facet) {
    const std::vector<int>& nodes = cells_[group_[facet]].nodes[place_.block];
    for (int k = 0; k < dim; ++k) {
      const int node = node_[boundary_.surface.facets[static_cast<std::size_t>(facet) * dim + k]];
      const auto place = std::find(nodes.begin(), nodes.end(), node);
      if (place == nodes.end() || place - nodes.begin() >= space.nodes_per_cell())
        throw std::logic_error("a facet's vertex is no node of the cell behind it");
      place_in_cell_.push_back(static_cast<int>(place - nodes.begin()));
    }
  }
}

class EmbeddedBoundary final : public CutBoundary {
 public:
  EmbeddedBoundary(Field& field, const FieldCut& cut, int body, int degree,
                   std::shared_ptr<const BodySurface> surface)
      : CutBoundary(field, cut, body, degree),
        surface_(std::move(surface)),
        constants_(surface_->body(), surface_->displacement()) {}
  [[nodiscard]] const Operand* mover() const override { return &surface_->mover(); }
  int add_constant(std::shared_ptr<const CellConstant> constant) override {
    return constants_.add(std::move(constant));
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
  void add_partner(Piece& piece, const InterfaceRule& rule, const InterfaceMotion& motion,
                   const std::vector<int>& points) const override {
    const auto dim = static_cast<std::size_t>(surface_->body().mesh().dimension()), moves = dim * dim;
    PointMotion& moving = piece.motion;
    for (const int q : points) {
      const int facet = rule.facet[q];
      const auto at = static_cast<std::size_t>(q);
      surface_->to_cell(facet, &rule.facet_reference[at * (dim - 1)], piece.partner.reference);
      surface_->motion_to_cell(facet, &motion.facet_reference[at * (dim - 1) * moves], moving.reference);
      const int* places = surface_->places(facet);
      moving.node.insert(moving.node.end(), places, places + dim);
      const auto copy = [&](const std::vector<double>& from, std::size_t size, std::vector<double>& to) {
        to.insert(to.end(), &from[at * size], &from[at * size] + size);
      };
      copy(motion.position, dim * moves, moving.position);
      copy(motion.normal, dim * moves, moving.normal);
      copy(motion.relative_weight, moves, moving.relative_weight);
    }
    piece.partner.weight = piece.weight;
  }
  std::shared_ptr<const BodySurface> surface_;
  mutable CellConstants constants_;  ///< computed when they are asked for
};

}  // namespace

Schema EmbeddedInterface::schema() {
  Schema s("The surface of a field's deforming mesh, cut out of another field's mesh.");
  s.reference("field", "The field that lies outside the body", "field");
  s.reference("body", "The field whose mesh is the body", "field");
  s.names("boundaries", "Parts of the body's boundary; default all").naming("boundary:body").otherwise("[]");
  return s;
}

std::shared_ptr<IntegrationDomain> EmbeddedInterface::build(InterfaceSetup& setup) const {
  const std::string displacement = setup.displacement(1);
  if (displacement.empty())
    throw Error(parameters_.where("body"),
                fmt::format("field '{}' has no displacement, so that it cannot be a body in another field",
                            parameters_.text("body")));
  auto surface =
      std::make_shared<const BodySurface>(*setup.sides[1], parameters_.names("boundaries"), displacement);
  FieldCut& cut = setup.cut(0);
  const int number = cut.add_body([surface](double) { return surface->now(); });
  return std::make_shared<EmbeddedBoundary>(*setup.sides[0], cut, number, setup.degree, surface);
}

}  // namespace seam
