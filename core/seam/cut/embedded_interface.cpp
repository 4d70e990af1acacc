// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/embedded_interface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

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
      if (is_new) cells.push_back(parent.cell);
      group_.push_back(found->second);
    }
    cells_ = fetch_cells(body, cells);
    for (const int node : boundary_.node) node_.push_back(space.local_node(node));
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
  [[nodiscard]] Field& body() const { return *body_; }
  /// Number of the cell behind a facet, among those of the surface.
  [[nodiscard]] int group(int facet) const { return group_[facet]; }
  [[nodiscard]] const RemoteCell& cell(int group) const { return cells_[group]; }
  /// Reference coordinates, in the cell behind a facet, of a point on it.
  /// @param on_facet the facet's own coordinates, [dimension - 1]
  void to_cell(int facet, const double* on_facet, std::vector<double>& reference) const {
    const CellTopology& cell = topology(body_->mesh().type());
    const int dim = cell.dimension;
    const int* corners = &boundary_.local[static_cast<std::size_t>(facet) * dim];
    const auto corner = [&](int k, int d) {
      return cell.node_coordinates[static_cast<std::size_t>(corners[k]) * dim + d];
    };
    for (int d = 0; d < dim; ++d) {
      double x = corner(0, d);
      for (int k = 1; k < dim; ++k) x += on_facet[k - 1] * (corner(k, d) - corner(0, d));
      reference.push_back(x);
    }
  }

 private:
  Field* body_;
  BodyBoundary boundary_;
  Field::Place place_;
  std::vector<int> group_;  ///< [facet]
  std::vector<RemoteCell> cells_;
  std::vector<int> node_;  ///< [point]: local node
};

class EmbeddedBoundary final : public CutBoundary {
 public:
  EmbeddedBoundary(Field& field, int body, int degree, std::shared_ptr<const BodySurface> surface)
      : CutBoundary(field, body, degree), surface_(std::move(surface)) {}
  [[nodiscard]] std::vector<Field*> fields() const override {
    return {CutBoundary::fields().front(), &surface_->body()};
  }
  void fill(int index, Element& element) const override {
    CutBoundary::fill(index, element);
    element.sides.resize(2);
    surface_->cell(piece(index).group).attach(element.sides[1], surface_->body());
    piece(index).partner.attach(element.sides[1]);
    element.sides[1].map_geometry();
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
  void add_partner(Piece& piece, const InterfaceRule& rule, const std::vector<int>& points) const override {
    const auto on_facet = static_cast<std::size_t>(surface_->body().mesh().dimension() - 1);
    std::vector<double> reference;
    for (const int q : points)
      surface_->to_cell(rule.facet[q], &rule.facet_reference[static_cast<std::size_t>(q) * on_facet],
                        reference);
    piece.partner.weight = piece.weight;
    piece.partner.fill(surface_->body(), reference, true);
  }
  std::shared_ptr<const BodySurface> surface_;
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
  const int number = setup.cut(0).add_body([surface](double) { return surface->now(); });
  return std::make_shared<EmbeddedBoundary>(*setup.sides[0], number, setup.degree, surface);
}

}  // namespace seam
