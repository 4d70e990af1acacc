// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unordered_map>
#include <vector>

#include "seam/mesh/mesh.hpp"
#include "seam/space/halo.hpp"

namespace seam {

/// The nodes of the continuous Lagrange elements of one order on a mesh. Global node numbers follow from the
/// undistributed mesh and so do not depend on the number of ranks; for the geometry's own order they are the
/// mesh's node numbers. Locally, owned nodes come first, then ghosts, each ascending.
class Space {
 public:
  /// Collective. @param order 1 or 2
  /// @param sets how many sets of unknowns a node may have, where bodies part its cells (see PartLayout)
  Space(const Mesh& mesh, int order, int sets = 1);

  [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
  [[nodiscard]] int order() const { return order_; }
  [[nodiscard]] int nodes_per_cell() const { return nodes_per_cell_; }
  /// Local node numbers of a cell, ordered as CellTopology says: those of set 0.
  [[nodiscard]] const int* cell_nodes(int cell) const {
    return &cell_nodes_[static_cast<std::size_t>(cell) * nodes_per_cell_];
  }
  [[nodiscard]] int owned_nodes() const { return owned_nodes_; }
  [[nodiscard]] int nodes() const { return static_cast<int>(global_.size()); }
  [[nodiscard]] int global_node(int node) const { return global_[node]; }
  [[nodiscard]] int owner(int node) const { return owner_[node]; }
  /// A set of unknowns of a node counts as a node of its own, at the same place; its global number is that of
  /// set 0 plus a multiple of the number of places.
  [[nodiscard]] int sets() const { return sets_; }
  /// The node of another set at the place of a node of set 0.
  [[nodiscard]] int in_set(int node, int set) const {
    return node + set * (node < owned_nodes_ ? owned_nodes_ : ghost_nodes_) / sets_;
  }
  /// Local number of a global node, -1 if this rank does not hold it.
  [[nodiscard]] int local_node(int global) const;
  /// One above the largest global node number of the space.
  [[nodiscard]] int global_bound() const { return global_bound_; }
  /// Reference position of a local node, `dimension` entries.
  [[nodiscard]] const double* position(int node) const {
    return &position_[static_cast<std::size_t>(node) * mesh_->dimension()];
  }
  [[nodiscard]] const Halo& halo() const { return halo_; }

  /// The set of a node; foreign nodes have set 0 only.
  [[nodiscard]] int set_of(int node) const {
    if (node < owned_nodes_) return node / (owned_nodes_ / sets_);
    return node < owned_nodes_ + ghost_nodes_ ? (node - owned_nodes_) / (ghost_nodes_ / sets_) : 0;
  }

  /// A node that an interface needs here although no local cell has it.
  struct ForeignNode {
    int global;
    int owner;
    double position[3];
  };
  /// Collective. Appends those not yet held as ghosts; existing local numbers stay.
  void add_foreign(const std::vector<ForeignNode>& nodes);

 private:
  std::vector<int> global_cell_nodes(const MeshData& whole);
  void number_locally(const std::vector<int>& all_cell_nodes);
  void add_sets();
  void place_nodes();
  void build_halo();

  const Mesh* mesh_;
  int order_;
  int nodes_per_cell_;
  int sets_;
  int owned_nodes_ = 0;
  int ghost_nodes_ = 0;  ///< without foreign ones
  int global_bound_ = 0;
  std::vector<int> cell_nodes_;
  std::vector<int> global_;
  std::vector<int> owner_;
  std::vector<double> position_;
  std::unordered_map<int, int> local_of_global_;
  Halo halo_;
};

}  // namespace seam
