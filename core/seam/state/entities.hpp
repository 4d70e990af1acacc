// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "seam/base/communicator.hpp"

namespace seam {

class Mesh;
class Space;

/// What the numbers of a state stand on: nodes, cells, points, or the run as a whole. Those of this rank are
/// numbered from 0, its own first and then those that it knows of other ranks; a global number stays the same
/// on any number of ranks.
class Entities {
 public:
  virtual ~Entities() = default;
  /// One of them, for messages: "node".
  [[nodiscard]] virtual std::string name() const = 0;
  [[nodiscard]] virtual const Communicator& communicator() const = 0;
  [[nodiscard]] virtual int owned() const = 0;
  /// With those of other ranks.
  [[nodiscard]] virtual int count() const = 0;
  [[nodiscard]] virtual int global(int local) const = 0;
  /// One above the largest global number.
  [[nodiscard]] virtual int global_bound() const = 0;
  /// Whether they are the nodes of this space.
  [[nodiscard]] virtual bool are_nodes_of(const Space&) const { return false; }
  /// First and one behind the last of those that a local cell of this mesh has for itself.
  [[nodiscard]] virtual std::pair<int, int> in_cell(const Mesh&, int) const { return {0, 0}; }
};

/// Sets of unknowns at the nodes of a space, which must outlive this, as meshes must below.
[[nodiscard]] std::shared_ptr<const Entities> nodes_of(const Space& space);
[[nodiscard]] std::shared_ptr<const Entities> cells_of(const Mesh& mesh);
/// Points of a rule that is the same in each cell. @param points of a cell
[[nodiscard]] std::shared_ptr<const Entities> points_of_cells(const Mesh& mesh, int points);
/// Faces between two cells that this rank knows. They have no global numbers: states on them last for a step.
[[nodiscard]] std::shared_ptr<const Entities> interior_faces_of(const Mesh& mesh);
/// A single one, which all ranks have alike.
[[nodiscard]] std::shared_ptr<const Entities> the_run(const Communicator& communicator);

}  // namespace seam
