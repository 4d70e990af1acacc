// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "seam/field/part_layout.hpp"
#include "seam/field/unknown.hpp"
#include "seam/space/space.hpp"

namespace seam {

class CutMesh;
class Law;
class StateStore;
template <class T>
class StateArray;

/// Nodal values of a block at one instant, as its field's store of states keeps them: [node][component], and
/// their rates as the time scheme defines them.
struct NodalState {
  std::vector<double>&value, &rate, &second_rate;
  /// Of value and rate over the step that led here; null unless the time scheme carries them on.
  std::vector<double>*mean_rate = nullptr, *mean_second_rate = nullptr;
  /// Rate, as the time scheme carries it on, of the momentum that what is tied hands on; null where nothing
  /// is.
  std::vector<double>* momentum_rate = nullptr;
};

/// All unknowns of a field that share a Lagrange space; given ones have a block of their own, and so have
/// those of the same parts of the boundary. Those of a node are contiguous. The states cover every node of
/// the mesh, active or not, so that a changing set of active unknowns leaves them in place.
struct Block {
  /// @param name of its states @param time_order per component
  Block(StateStore& store, const std::string& name, std::unique_ptr<Space> on, bool is_given,
        std::vector<int> components_of_unknowns, std::vector<int> time_orders);
  std::unique_ptr<Space> space;
  int size = 0;        ///< unknowns per node
  bool given = false;  ///< nodal data (see Unknown): never active, known everywhere
  NodalState now;
  NodalState old;                        ///< at the start of the step
  std::vector<char>& known;              ///< per local node: its states mean something; they are carried over
                                         ///< when a moving body leaves or enters its cells
  std::vector<char> active;              ///< per local node: carries unknowns of the system
  std::vector<char> prescribed;          ///< per unknown of a local node: its value is given,
  std::vector<double> prescribed_value;  ///< namely this, to be reached by the end of the step,
  /// with these rates; where they are no numbers, those of the time scheme.
  std::vector<double> prescribed_rate, prescribed_second_rate;
  std::vector<int> time_order;  ///< per component
  /// Per unknown of a local node: a number that tells what hands momentum on to it; null where nothing does.
  std::vector<double>* momentum_of = nullptr;
  std::vector<int> components;  ///< of each unknown
  /// Parts of the boundary on which its unknowns live, see Unknown; null: on all of the mesh.
  std::optional<std::vector<std::string>> boundaries;
  /// Per local node, where they live on boundaries: how much of these it stands for, see surface_shares().
  std::vector<double> surface_share;
  std::vector<char> left_out;  ///< the same: nodes without unknowns, see Unknown::multiplier_of
  std::vector<std::vector<int>> beside_left_out;  ///< [owned node]: those that have them; empty without any

  /// @param nodes of a cell
  [[nodiscard]] bool knows_any(const int* nodes) const {
    return std::any_of(nodes, nodes + space->nodes_per_cell(), [&](int n) { return known[n] != 0; });
  }

 private:
  struct States {
    StateArray<double>&value, &rate, &second_rate;
    StateArray<char>& known;
  };
  Block(const States& states, std::unique_ptr<Space>&& on);
};

/// A field: unknowns on a mesh.
class Field {
 public:
  /// Collective. @param sets of unknowns that a node can have at most, see PartLayout
  Field(std::string name, const Mesh& mesh, std::vector<Unknown> unknowns, int sets = 1);
  ~Field();
  Field(const Field&) = delete;
  Field& operator=(const Field&) = delete;

  struct ComponentRange {
    int block;   ///< index into blocks()
    int offset;  ///< first component within the block
    int components;
  };
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
  [[nodiscard]] const std::vector<Unknown>& unknowns() const { return unknowns_; }
  /// Highest polynomial order of the unknowns.
  [[nodiscard]] int order() const;
  /// @throws Error listing the field's unknowns
  [[nodiscard]] ComponentRange place(const std::string& unknown) const;
  /// A constant that the field's physics makes known, such as "viscosity".
  /// @throws Error listing those it has
  [[nodiscard]] double constant(const std::string& name) const;
  [[nodiscard]] bool has_constant(const std::string& name) const { return constants_.contains(name); }
  void set_constant(const std::string& name, double value) { constants_[name] = value; }
  /// A law that the field's physics makes known, such as "stress", as it holds in one of the regions that it
  /// tells apart; null when it does not.
  [[nodiscard]] std::shared_ptr<const Law> law(const std::string& name, int region) const {
    const auto found = laws_.find({name, region});
    return found == laws_.end() ? nullptr : found->second;
  }
  void set_law(const std::string& name, int region, std::shared_ptr<const Law> law) {
    laws_[{name, region}] = std::move(law);
  }
  /// Number of regions that the field's physics tells apart (FieldSetup::divide): 1 unless it does.
  [[nodiscard]] int regions() const { return regions_; }
  /// The region in which a cell of the whole mesh lies.
  [[nodiscard]] int region(int global_cell) const {
    return region_of_cell_.empty() ? 0 : region_of_cell_[global_cell];
  }
  /// @param region_of_cell of each cell of the whole mesh
  void divide(int regions, std::vector<int> region_of_cell) {
    regions_ = regions;
    region_of_cell_ = std::move(region_of_cell);
  }
  /// All that goes back with the field when a step is rewound; others add to it what they keep about it.
  [[nodiscard]] StateStore& state() const { return *state_; }
  /// From now on states have mean rates. Before the first step.
  void keep_mean_rates();
  /// From now on states have what others hand on to their unknowns, see NodalState::momentum_rate.
  void keep_momentum();
  [[nodiscard]] std::vector<Block>& blocks() { return blocks_; }
  [[nodiscard]] const std::vector<Block>& blocks() const { return blocks_; }

  /// How many sets of unknowns a node may have: 1 where the parts of a cell are not told apart.
  [[nodiscard]] int sets() const { return sets_; }
  /// Which parts use which sets; null as long as all states are of set 0 or none has been chosen. The states
  /// are not touched.
  void set_layout(std::shared_ptr<const PartLayout> layout) { layout_ = std::move(layout); }
  [[nodiscard]] const std::shared_ptr<const PartLayout>& layout() const { return layout_; }
  /// Number of parts of a local cell that have unknowns of their own.
  [[nodiscard]] int parts(int cell) const { return layout_ ? layout_->count(cell) : 1; }
  /// Local nodes of a part of a cell. @param space of one of the blocks
  [[nodiscard]] const int* cell_nodes(const Space& space, int cell, int part = 0) const {
    const PartLayout::Sets* listed = layout_ ? layout_->part(cell, part) : nullptr;
    return listed ? listed->node[space.order() - 1].data() : space.cell_nodes(cell);
  }
  [[nodiscard]] const int* cell_nodes(int block, int cell, int part = 0) const {
    return cell_nodes(*blocks_[block].space, cell, part);
  }

  /// Says that nodes of a block are one and the same though no cell has two of them, as where what is around
  /// is periodic.
  /// @param groups of global numbers, the same on all ranks
  void join(int block, std::vector<std::vector<int>> groups) { joined_[block] = std::move(groups); }
  /// Null where no nodes of the block are.
  [[nodiscard]] const std::vector<std::vector<int>>* joined(int block) const {
    const auto found = joined_.find(block);
    return found == joined_.end() ? nullptr : &found->second;
  }
  /// Collective. Makes nodes of other ranks' cells known here, for an interface (see Space::add_foreign).
  void add_foreign(int block, const std::vector<Space::ForeignNode>& nodes);

  /// Takes the unknowns of some nodes out of a block that lives on boundaries. Collective.
  /// @param nodes local ones, of which those owned count
  void leave_out(int block, const std::vector<int>& nodes);
  /// Gives nodes that were left out the mean value of those beside them: nothing but pictures reads it.
  /// Collective.
  void show_left_out();

  /// Restricts the field to some of its cells: a node is active exactly where one of them, or
  /// a part of one, has it. Collective.
  /// @param cell_is_active per local cell, ghosts included
  /// @param cut how bodies cut these cells; null where active cells are whole. Must outlive its use.
  void occupy(std::vector<char> cell_is_active, const CutMesh* cut = nullptr);
  /// Per local cell.
  [[nodiscard]] const std::vector<char>& active_cells() const { return active_cells_; }
  [[nodiscard]] const CutMesh* cut() const { return cut_; }
  /// True when this local cell is active and only partly occupied, or kept active though a body has covered
  /// it altogether.
  [[nodiscard]] bool is_cut(int cell) const;
  /// True when this local cell is kept active though a body has covered it altogether: nothing is integrated
  /// over it and nothing of it is shown.
  [[nodiscard]] bool is_covered(int cell) const;
  /// While it is true, interior faces that have counted as faces of a cut cell go on to do so: with the set
  /// of them the ghost penalty would jump.
  void keep_cut_faces(bool keep) { keeps_cut_faces_ = keep; }
  [[nodiscard]] bool keeps_cut_faces() const { return keeps_cut_faces_; }
  /// From now on it is known which interior faces have counted as faces of a cut cell. Once, where bodies cut
  /// the field.
  void remember_cut_faces();
  /// Those, or those of them that are wet in part, [interior face of the mesh]; null where nothing cuts it.
  [[nodiscard]] std::vector<char>* cut_faces(bool wet) const;

 private:
  void resize(Block& block) const;
  static void mark_surface(Block& block);
  std::unique_ptr<StateStore> state_;
  std::string name_;
  const Mesh* mesh_;
  std::vector<Unknown> unknowns_;
  std::vector<ComponentRange> places_;
  std::map<std::string, double> constants_;
  std::map<std::pair<std::string, int>, std::shared_ptr<const Law>> laws_;  ///< by name and region
  int regions_ = 1;
  std::vector<int> region_of_cell_;
  std::vector<Block> blocks_;
  std::map<int, std::vector<std::vector<int>>> joined_;  ///< by block
  std::vector<char> active_cells_;
  const CutMesh* cut_ = nullptr;
  bool keeps_cut_faces_ = false;
  StateArray<char>*cut_faces_ = nullptr, *wet_cut_faces_ = nullptr;
  int sets_;
  std::shared_ptr<const PartLayout> layout_;
};

}  // namespace seam
