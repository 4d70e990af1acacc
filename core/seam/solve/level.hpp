// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <list>
#include <set>
#include <utility>
#include <vector>

#include "seam/constraint/joins_fields.hpp"
#include "seam/solve/connected_nodes.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

/// A level condition and all others whose unknowns are joined to its own, with the connected parts of their
/// fields' active cells: parts that are joined are one.
class LevelGroup {
 public:
  struct Member {
    FieldEntry* entry;
    LevelCondition* level;
    ConnectedNodes label;
    std::vector<int> parts;                      ///< labels
    std::set<std::pair<int, int>> joined_faces;  ///< cell and face
    std::set<int> tied;                          ///< global nodes
    [[nodiscard]] Block& block() const { return entry->field->blocks()[level->block]; }
    [[nodiscard]] std::size_t unknown_of(int node) const {
      return static_cast<std::size_t>(node) * block().size + level->component;
    }
  };
  /// Collective.
  LevelGroup(std::vector<FieldEntry>& fields, const std::vector<const JoinsFields*>& joins, FieldEntry& entry,
             LevelCondition& level);
  [[nodiscard]] std::list<Member>& members() { return members_; }
  /// How many parts there are.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// The number of the part that a member's part of this label belongs to.
  [[nodiscard]] std::size_t part(const Member& member, int label) const;

 private:
  [[nodiscard]] const Member* member(const JoinedFields::Side& side) const;
  void find_members(std::vector<FieldEntry>& fields, const std::vector<const JoinsFields*>& joins,
                    FieldEntry& entry, LevelCondition& level);
  void unite_parts(const std::vector<const JoinedFields*>& joins, const Communicator& communicator);
  std::list<Member> members_;
  std::map<std::pair<const Member*, int>, std::size_t> part_;
  std::size_t size_ = 0;
};

/// Chooses the nodes that hold the level of an unknown: in each connected part of the active cells, through
/// all fields that are joined, that has no face on an open boundary, the one with the lowest global number
/// among the nodes of whole cells (of any cells where there is none) of the first field. Collective.
/// @param entry with those joined to it
void place_levels(std::vector<FieldEntry>& fields, const std::vector<const JoinsFields*>& joins,
                  FieldEntry& entry);

}  // namespace seam
