// SPDX-License-Identifier: BSD-3-Clause
#include "seam/surface/body_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "seam/field/field.hpp"

namespace seam {

void declare_backing(Schema& schema, const std::string& body) {
  Schema backing("Parts of the boundary that are not wet, and the way out of the mesh behind them.");
  backing.names("on", "Parts of the boundary of `" + body + "`").naming("boundary:" + body);
  backing
      .vector_expression(
          "by",
          "So far the surface is shifted there, as a function of the place in the body's mesh: out "
          "of the other field's mesh, however the body moves")
      .unit("m");
  schema.list("backing", "Where no field lies behind a part of the boundary", backing).otherwise("[]");
}

std::vector<Backing> backing_of(const Parameters& parameters) {
  std::vector<Backing> result;
  for (const Parameters& p : parameters.list("backing"))
    result.push_back({p.names("on"), p.vector_expression("by")});
  return result;
}

BodySurface::BodySurface(Field& body, const std::vector<std::string>& boundaries,
                         const std::string& displacement, const std::vector<Backing>& backing)
    : body_(&body),
      displacement_(displacement),
      boundary_(body_boundary(body.mesh().whole(), boundaries)),
      place_(body.place(displacement)) {
  const Space& space = *body.blocks()[place_.block].space;
  if (space.order() != body.mesh().order())
    throw Error(fmt::format(
        "the displacement of field '{}' has order {}, its mesh order {}: a body with an interface "
        "needs both alike; give its mesh the order of its displacement",
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
  for (const Backing& part : backing) {
    const std::vector<int> nodes = body_boundary(body.mesh().whole(), part.boundaries).node;
    for (std::size_t k = 0; k < boundary_.node.size(); ++k)
      if (std::ranges::find(nodes, boundary_.node[k]) != nodes.end()) {
        const int dim = boundary_.surface.dimension;
        double* x = &boundary_.surface.points[k * dim];
        std::array<double, 3> by{};
        for (int d = 0; d < dim; ++d) by[d] = part.by[d](x, dim, 0);
        for (int d = 0; d < dim; ++d) x[d] += by[d];
      }
  }
  find_places();
}

Surface BodySurface::now() const {
  Surface surface = boundary_.surface;
  const Block& block = body_->blocks()[place_.block];
  const int dim = surface.dimension;
  for (std::size_t k = 0; k < node_.size(); ++k)
    for (int d = 0; d < dim; ++d)
      surface.points[k * dim + d] +=
          block.now.value[static_cast<std::size_t>(node_[k]) * block.size + place_.offset + d];
  return surface;
}

double BodySurface::rest_area(int facet) const {
  const int dim = boundary_.surface.dimension;
  const int* vertex = &boundary_.surface.facets[static_cast<std::size_t>(facet) * dim];
  const auto along = [&](int k, int d) {
    const std::vector<double>& x = boundary_.surface.points;
    return x[static_cast<std::size_t>(vertex[k]) * dim + d] -
           x[static_cast<std::size_t>(vertex[0]) * dim + d];
  };
  if (dim == 2) return std::hypot(along(1, 0), along(1, 1));
  const auto minor = [&](int d, int e) { return along(1, d) * along(2, e) - along(1, e) * along(2, d); };
  return 0.5 * std::hypot(minor(1, 2), minor(2, 0), minor(0, 1));
}

double BodySurface::corner(int facet, int k, int d) const {
  const CellTopology& cell = topology(body_->mesh().type());
  const int node = boundary_.local[static_cast<std::size_t>(facet) * cell.dimension + k];
  return cell.node_coordinates[static_cast<std::size_t>(node) * cell.dimension + d];
}

void BodySurface::to_cell(int facet, const double* on_facet, std::vector<double>& reference) const {
  const int dim = body_->mesh().dimension();
  for (int d = 0; d < dim; ++d) {
    double x = corner(facet, 0, d);
    for (int k = 1; k < dim; ++k) x += on_facet[k - 1] * edge(facet, k, d);
    reference.push_back(x);
  }
}

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

}  // namespace seam
