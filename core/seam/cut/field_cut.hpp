// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "seam/cut/cut_mesh.hpp"
#include "seam/cut/extension.hpp"
#include "seam/surface/body.hpp"

namespace seam {

class Field;
struct PartLayout;
class PartSets;
template <class T>
class StateArray;

/// The bodies that cut a field's mesh, and what their motion means for the field: which cells and nodes are
/// active, and how states reach nodes that come alive (thesis 3.2).
///
/// Where the field has several sets of unknowns per node, parts of its cells that a body keeps apart get
/// their own (PartLayout), and states follow the parts.
///
/// Connected parts of less than two cells' volume are no part of the field: neither could the mesh resolve
/// what goes on in them, nor would a body that closes them let what is incompressible go. Those that reach
/// an open boundary or a body that lets them drain stay. The first cut of a step decides; whatever it keeps
/// stays for the step, and what it drops stays out, also where it creeps into cells that were body. What was
/// dropped stays out until it joins another part, however much it grows.
class FieldCut {
 public:
  explicit FieldCut(Field& field);
  ~FieldCut();
  FieldCut(const FieldCut&) = delete;
  FieldCut& operator=(const FieldCut&) = delete;

  /// The surface of a body at a time; must give the same on all ranks.
  using Body = MovingSurface;
  /// @param of the field whose mesh the body is; "" where it is none's
  /// @return the body's number, as InterfaceRule::body has it
  int add_body(Body body, const std::string& of = "");

  /// In diameters of a cell, the thickness of a film between bodies that has closed.
  static constexpr double closed_film = 1e-5;
  /// The same of one that has opened again: were it that which closes, films between flat bodies in touch
  /// would come and go.
  static constexpr double open_film = 1e-3;
  /// Parts that reach these boundaries are never dropped.
  void keep_at(std::vector<std::string> boundaries) { open_boundaries_ = std::move(boundaries); }
  /// The same of parts that this body's surface bounds, which lets through what they hold.
  void keep_at(int body) { draining_.insert(body); }
  /// The next cut decides anew which parts are dropped.
  void begin_step() { decided_ = false; }

  /// Cells that are active now stay so to the end of the step: covered ones keep their unknowns, held by
  /// ghost penalties alone (thesis 6.3.2), and faces that bear these go on to do so.
  void hold();

  /// Cuts the mesh with the bodies as they are at `time` and extends all states, old ones included, to nodes
  /// that come alive. A time other than that of the last call begins a step. Occupying the cells is left to
  /// the caller. Collective.
  /// @return false when nothing has changed since the last call
  /// @throws Error when the bodies cannot be cut out at the start, or end on each other in the mesh
  /// (refuse_unsound_surfaces), StepRefused when they cannot later, or when a cell comes alive that no known
  /// state reaches
  bool update(double time);

  [[nodiscard]] const CutMesh& mesh() const { return mesh_; }
  /// Length of a cut cell that scales Nitsche penalties: its volume over the area of the interface in it, as
  /// it was when a body first cut the cell in this step, so that it need not be differentiated. Where the
  /// interface just clips a corner the length stays below four cells.
  [[nodiscard]] double trace_size(int cell) const;
  /// True when nodes are active whose states are not known, as after a failed step was rewound. Collective.
  [[nodiscard]] bool has_new_nodes() const { return !states_match(); }
  /// Per local cell.
  [[nodiscard]] const std::vector<char>& active_cells() const { return active_; }
  /// Of the parts left out at present, on all ranks, m^d.
  [[nodiscard]] double dropped_volume() const { return dropped_volume_; }

 private:
  /// What the first cut of a step made of a local cell.
  enum class Decision : char { none, body, kept, dropped };
  /// States are those of a step that ended at `time`: cuts at that time follow what had been decided by then,
  /// and the next step decides anew.
  void return_to(double time);
  void cut(const std::vector<Surface>& surfaces);
  [[nodiscard]] Decision decision(int cell) const;
  [[nodiscard]] bool states_match() const;
  void uncover(const std::vector<char>& before);
  void choose_sets();
  void warn_of_shared_sets();
  void warn_of_doubts();
  void warn(const std::string& kind, const std::string& message);
  void check_motion(const PartLayout& before) const;
  void accept_states(bool at_start);
  [[nodiscard]] std::vector<double> draining_thickness(const WetParts& parts) const;
  [[nodiscard]] std::vector<char> open_parts(const WetParts& parts,
                                             const std::vector<double>& thickness) const;
  [[nodiscard]] std::vector<double> count(Decision made, const WetParts& parts) const;
  /// Whether any node of a local cell has one, in any of its parts.
  [[nodiscard]] bool has_state(int cell) const;
  [[nodiscard]] std::vector<int> decide();
  [[nodiscard]] std::vector<int> follow_decision() const;
  Field* field_;
  CutMesh mesh_;
  std::vector<Body> bodies_;
  std::vector<std::string> fields_of_bodies_;  ///< "" for those of none
  std::vector<Surface> surfaces_;              ///< at the last update
  std::vector<char> active_;
  std::set<int> draining_;  ///< bodies
  std::vector<std::string> open_boundaries_;
  // In the field's store of states: with those of nodes, all that a cut depends on.
  StateArray<char>& decision_;  ///< Decision of each cell
  StateArray<char>& held_;      ///< cells, see hold()
  bool was_cut_ = false;        ///< ever
  bool decided_ = false;        ///< in this step
  bool is_first_cut_ = false;   ///< the present cut is the one that decided
  bool is_filling_ = false;     ///< cells of kept parts wait for a state
  double time_ = 0;             ///< of the last update
  double dropped_volume_ = 0;
  std::map<int, double> area_;  ///< of the interface in cells, when first cut in the step
  Extension extension_;
  std::unique_ptr<PartSets> sets_;  ///< null where parts are not told apart
  std::shared_ptr<const PartLayout> layout_;
  std::set<std::string> warned_;  ///< what was said, once in a run
};

}  // namespace seam
