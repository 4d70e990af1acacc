// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "seam/cut/cut_mesh.hpp"
#include "seam/cut/ghost_values.hpp"
#include "seam/field/field.hpp"

namespace seam {

/// Chooses the sets of unknowns that the parts of a field's cells use.
class PartSets {
 public:
  /// Collective.
  explicit PartSets(const Field& field) : field_(&field), ghosts_(field.mesh()) {}

  /// Collective. @param cut whose parts are told apart
  /// @param active per local cell
  [[nodiscard]] std::shared_ptr<PartLayout> find(const CutMesh& cut, const std::vector<char>& active);

  /// Positions of local nodes around which there were more parts than a node has sets: some of these share
  /// unknowns.
  [[nodiscard]] const std::vector<std::array<double, 3>>& shared() const { return shared_; }

 private:
  using Sets = std::vector<std::vector<int>>;  ///< [cell][part, node of the cell]
  /// @param shared gets the positions of nodes that have fewer sets than parts around them
  [[nodiscard]] Sets choose(const CutMesh& cut, const std::vector<char>& active, const Space& space,
                            std::vector<std::array<double, 3>>& shared) const;
  void exchange(int per_cell, Sets& sets) const;
  const Field* field_;
  cutting::GhostValues ghosts_;
  std::vector<std::array<double, 3>> shared_;
};

/// In Block::known, until the states are extended.
constexpr char known_if_needed = 2;

/// Brings states to the sets that the same wet parts use now: a new set takes over from that one of
/// the node which the parts around it used before, by their volume; a part is recognised in its cell by its
/// centre. Sets that take over from none are not known afterwards. A set that finds its own taken gets the
/// same states marked `known_if_needed`: what comes apart had the same functions everywhere, but what
/// that a body has swept into a cell had others. Collective.
/// @param cut how bodies cut the field now
void carry_over(Field& field, const PartLayout& before, const PartLayout& now, const CutMesh& cut);

}  // namespace seam
