// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "seam/assembly/remote_cells.hpp"
#include "seam/field/field.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/scene/schema.hpp"
#include "seam/surface/body.hpp"
#include "seam/term/tensor.hpp"

namespace seam {

/// Parts of a body's boundary behind which there is nothing: its surface is shifted there, so that what it
/// encloses takes in the space behind them.
struct Backing {
  std::vector<std::string> boundaries;
  std::vector<Expression> by;  ///< m, [dimension], of the place in the mesh
};
/// Adds the key `backing`. @param body the key that names the body
void declare_backing(Schema& schema, const std::string& body);
std::vector<Backing> backing_of(const Parameters& parameters);

/// The surface of a deforming body as planar facets, with the cells behind them. Every rank holds all of it:
/// surfaces are small beside volumes.
class BodySurface {
 public:
  /// Collective. @param boundaries parts of the mesh's boundary; empty for all of it
  /// @param displacement name of the unknown that displaces the mesh
  /// @param backing parts that are shifted
  /// @throws Error when mesh and displacement differ in order, or a boundary is unknown
  BodySurface(Field& body, const std::vector<std::string>& boundaries, const std::string& displacement,
              const std::vector<Backing>& backing = {});

  /// As it is deformed now.
  [[nodiscard]] Surface now() const;
  [[nodiscard]] const Surface& at_rest() const { return boundary_.surface; }
  [[nodiscard]] int facet_count() const { return boundary_.surface.facet_count(); }
  [[nodiscard]] Field& body() const { return *body_; }
  [[nodiscard]] const std::string& displacement() const { return displacement_; }
  [[nodiscard]] const Field::ComponentRange& place() const { return place_; }

  /// The face of the mesh that a facet is part of; its cell by global number.
  [[nodiscard]] const CellFace& parent(int facet) const { return boundary_.parent[facet]; }
  /// Where the body is not deformed, m^(d-1).
  [[nodiscard]] double rest_area(int facet) const;
  /// Number of the cell behind a facet, among those of the surface.
  [[nodiscard]] int group(int facet) const { return group_[facet]; }
  [[nodiscard]] int group_count() const { return static_cast<int>(cells_.size()); }
  [[nodiscard]] const RemoteCell& cell(int group) const { return cells_[group]; }
  /// All faces of a cell that are part of the surface.
  [[nodiscard]] const std::vector<int>& faces(int group) const { return faces_[group]; }
  /// Which nodes of the cell behind a facet the facet's vertices are, [dimension].
  [[nodiscard]] const int* places(int facet) const {
    return &place_in_cell_[static_cast<std::size_t>(facet) * body_->mesh().dimension()];
  }
  /// Appends the reference coordinates, in the cell behind a facet, of a point on it.
  /// @param on_facet the facet's own coordinates, [dimension - 1]
  void to_cell(int facet, const double* on_facet, std::vector<double>& reference) const;
  /// The same of a point that slides along the facet: of what is returned the derivatives count.
  template <int dim, class T>
  [[nodiscard]] Vec<dim, T> moved_in_cell(int facet, const Vec<dim - 1, T>& on_facet) const {
    Vec<dim, T> reference;
    for (int d = 0; d < dim; ++d)
      for (int k = 1; k < dim; ++k) reference[d] += edge(facet, k, d) * on_facet[k - 1];
    return reference;
  }

 private:
  /// Reference coordinate d of vertex k of a facet, and of the way to it from vertex 0.
  [[nodiscard]] double corner(int facet, int k, int d) const;
  [[nodiscard]] double edge(int facet, int k, int d) const {
    return corner(facet, k, d) - corner(facet, 0, d);
  }
  void find_places();

  Field* body_;
  std::string displacement_;
  BodyBoundary boundary_;
  Field::ComponentRange place_;
  std::vector<int> group_;               ///< [facet]
  std::vector<std::vector<int>> faces_;  ///< [group]
  std::vector<RemoteCell> cells_;
  std::vector<int> node_;           ///< [point]: local node
  std::vector<int> place_in_cell_;  ///< [facet][dimension]
};

}  // namespace seam
