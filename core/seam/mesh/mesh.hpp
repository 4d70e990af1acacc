// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "seam/base/communicator.hpp"
#include "seam/mesh/mesh_data.hpp"

namespace seam {

/// The part of a mesh that one rank holds: the cells it owns, then a ghost layer of the cells that share a
/// node with them. Every cell is owned by exactly one rank, and every rank knows the whole neighbourhood of
/// the nodes of its own cells.
class Mesh {
 public:
  /// Distributes `whole` by recursive coordinate bisection (Zoltan2's multijagged).
  /// @param weights cost of each cell; empty for equal cost
  Mesh(std::string name, std::shared_ptr<const MeshData> whole, const Communicator& communicator,
       const std::vector<double>& weights = {});

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const Communicator& communicator() const { return communicator_; }
  [[nodiscard]] int dimension() const { return whole_->dimension; }
  [[nodiscard]] CellType type() const { return whole_->type; }
  /// Polynomial order of the geometry.
  [[nodiscard]] int order() const { return whole_->order; }

  [[nodiscard]] int owned_cells() const { return owned_cells_; }
  /// Owned and ghost cells.
  [[nodiscard]] int cells() const { return static_cast<int>(global_cell_.size()); }
  [[nodiscard]] int global_cell(int cell) const { return global_cell_[cell]; }
  /// Rank that owns a local cell.
  [[nodiscard]] int owner(int cell) const { return owner_of_global_cell_[global_cell_[cell]]; }
  /// Corner coordinates of a cell's geometry nodes, [node][dimension]: a pointer into one array of all cells.
  [[nodiscard]] const double* geometry(int cell) const {
    return &geometry_[static_cast<std::size_t>(cell) * nodes_per_cell_ * dimension()];
  }
  [[nodiscard]] int geometry_nodes() const { return nodes_per_cell_; }
  /// Largest distance between two vertices, m.
  [[nodiscard]] double diameter(int cell) const { return diameter_[cell]; }
  /// m^dimension.
  [[nodiscard]] double volume(int cell) const { return volume_[cell]; }

  /// Local cells and their faces that carry a name. @throws Error listing the known names
  [[nodiscard]] const std::vector<CellFace>& boundary(const std::string& name) const;
  [[nodiscard]] const std::map<std::string, std::vector<CellFace>>& boundaries() const { return boundaries_; }
  /// Faces between two local cells of which the one with the lower global number is owned: each interior face
  /// of the whole mesh occurs on exactly one rank. Built at the first call.
  struct InteriorFace {
    CellFace side[2];
  };
  [[nodiscard]] const std::vector<InteriorFace>& interior_faces() const;
  /// Faces with no local cell behind them, named or not, those of owned cells first: there nothing is behind
  /// them. Built at the first call.
  [[nodiscard]] const std::vector<CellFace>& outer_faces() const;

  /// The undistributed mesh, kept for as long as the mesh: surfaces and spaces read it.
  [[nodiscard]] const MeshData& whole() const { return *whole_; }
  [[nodiscard]] const std::vector<int>& owner_of_global_cell() const { return owner_of_global_cell_; }

 private:
  void assign_owners(const std::vector<double>& weights);
  void choose_cells();
  void copy_geometry();
  void copy_boundaries();

  std::string name_;
  std::shared_ptr<const MeshData> whole_;
  Communicator communicator_;
  int nodes_per_cell_ = 0;
  int owned_cells_ = 0;
  std::vector<int> owner_of_global_cell_;
  std::vector<int> global_cell_;
  std::vector<double> geometry_;
  std::vector<double> diameter_;
  std::vector<double> volume_;
  std::map<std::string, std::vector<CellFace>> boundaries_;
  void find_faces() const;
  mutable std::vector<InteriorFace> interior_faces_;
  mutable std::vector<CellFace> outer_faces_;
  mutable bool faces_found_ = false;
};

}  // namespace seam
