// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "seam/cut/cut_mesh.hpp"
#include "seam/cut/extension.hpp"

namespace seam {

/// The bodies that cut a field's mesh, and what their motion means for the field: which cells and nodes are
/// active, and how states reach nodes that come alive (thesis 3.2).
class FieldCut {
 public:
  explicit FieldCut(Field& field);

  /// The surface of a body at a time; must give the same on all ranks.
  using Body = std::function<Surface(double time)>;
  /// @return the body's number, as InterfaceRule::body has it
  int add_body(Body body);

  /// Cuts the mesh with the bodies as they are at `time` and extends all states, old ones included, to nodes
  /// that come alive. Occupying the cells is left to the caller. Collective.
  /// @return false when nothing has changed since the last call
  /// @throws StepRefused when a cell comes alive that no known state reaches
  bool update(double time);

  [[nodiscard]] const CutMesh& mesh() const { return mesh_; }
  /// True when nodes are active whose states are not known, as after a failed step was rewound. Collective.
  [[nodiscard]] bool has_new_nodes() const { return !states_match(); }
  /// Per local cell.
  [[nodiscard]] const std::vector<char>& active_cells() const { return active_; }

 private:
  [[nodiscard]] bool states_match() const;
  Field* field_;
  CutMesh mesh_;
  std::vector<Body> bodies_;
  std::vector<Surface> surfaces_;  ///< at the last update
  std::vector<char> active_;
  Extension extension_;
};

}  // namespace seam
