// SPDX-License-Identifier: BSD-3-Clause
#include "seam/solve/level.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "seam/assembly/assembler.hpp"
#include "seam/base/disjoint_sets.hpp"
#include "seam/cut/cut_mesh.hpp"

namespace seam {
namespace {

/// Labels of the parts that reach an open boundary on this rank.
std::vector<int> open_parts(const LevelGroup::Member& member) {
  // In widths of a cell: a body that ends less than that short of a boundary covers it, too.
  constexpr double narrowest = 1e-9;
  const Field& field = *member.entry->field;
  const Mesh& mesh = field.mesh();
  std::vector<int> open;
  CutRule rule;
  for (const std::string& name : member.level->open_boundaries)
    for (const CellFace& face : mesh.boundary(name)) {
      if (!field.active_cells()[face.cell] || face.cell >= mesh.owned_cells()) continue;
      if (member.joined_faces.contains({face.cell, face.face})) continue;
      for (int p = 0; p < field.parts(face.cell); ++p) {
        if (field.is_cut(face.cell)) {
          field.cut()->face_rule(face.cell, face.face, 1, rule, p);
          const double wet = std::accumulate(rule.weight.begin(), rule.weight.end(), 0.0);
          if (wet <= narrowest * std::pow(mesh.diameter(face.cell), mesh.dimension() - 1)) continue;
        }
        open.push_back(member.label[field.cell_nodes(member.level->block, face.cell, p)[0]]);
      }
    }
  return open;
}

/// Labels of the parts where the scene prescribes the unknown at a node, which gives the level.
std::vector<int> prescribed_parts(const LevelGroup::Member& member) {
  const Block& block = member.block();
  std::vector<int> parts;
  for (int node = 0; node < block.space->owned_nodes(); ++node)
    if (block.active[node] && block.prescribed[member.unknown_of(node)]) parts.push_back(member.label[node]);
  return parts;
}

/// The node that may hold each part, by label: one that is not tied itself, which would come loose.
std::map<int, int> choose_nodes(const LevelGroup::Member& member) {
  const Field& field = *member.entry->field;
  const Space& space = *member.block().space;
  struct Candidate {
    int label, node;
    bool whole;
  };
  std::map<int, Candidate> best;
  const auto offer = [&](const Candidate& c) {
    const auto [found, is_new] = best.emplace(c.label, c);
    Candidate& known = found->second;
    if (!is_new && (c.whole != known.whole ? c.whole : c.node < known.node)) known = c;
  };
  for (int c = 0; c < field.mesh().owned_cells(); ++c)
    for (int p = 0; p < field.parts(c) && field.active_cells()[c]; ++p) {
      const int* nodes = field.cell_nodes(member.level->block, c, p);
      for (int a = 0; a < space.nodes_per_cell(); ++a)
        if (const int global = space.global_node(nodes[a]); !member.tied.contains(global))
          offer({member.label[nodes[a]], global, !field.is_cut(c)});
    }
  std::vector<Candidate> mine;
  for (const auto& [part, candidate] : best) mine.push_back(candidate);
  for (const Candidate& c : field.mesh().communicator().gather_all(mine)) offer(c);
  std::map<int, int> nodes;
  for (const auto& [part, candidate] : best) nodes[part] = candidate.node;
  return nodes;
}

/// Lets a node hold the level, on the ranks that know it.
void hold(const LevelGroup::Member& member, int global) {
  Block& block = member.block();
  const int node = block.space->local_node(global);
  if (node < 0) return;
  member.level->nodes.push_back(node);
  block.prescribed[member.unknown_of(node)] = 1;
  block.prescribed_value[member.unknown_of(node)] = member.level->value;
  block.prescribed_rate[member.unknown_of(node)] = block.prescribed_second_rate[member.unknown_of(node)] = 0;
}

void place_levels(LevelGroup& group) {
  std::set<std::size_t> held;  // parts whose level is given, or held
  for (LevelGroup::Member& member : group.members()) {
    for (const int node : member.level->nodes) member.block().prescribed[member.unknown_of(node)] = 0;
    member.level->nodes.clear();
    std::vector<int> open = open_parts(member);
    for (const int part : prescribed_parts(member)) open.push_back(part);
    std::sort(open.begin(), open.end());
    open.erase(std::unique(open.begin(), open.end()), open.end());
    for (const int label : member.entry->mesh->communicator().gather_all(open))
      held.insert(group.part(member, label));
  }
  for (LevelGroup::Member& member : group.members())
    for (const auto& [label, node] : choose_nodes(member))
      if (held.insert(group.part(member, label)).second) hold(member, node);
}

}  // namespace

LevelGroup::LevelGroup(std::vector<FieldEntry>& fields, const std::vector<const JoinsFields*>& joins,
                       FieldEntry& entry, LevelCondition& level) {
  find_members(fields, joins, entry, level);
  const Communicator& communicator = entry.mesh->communicator();
  std::vector<const JoinedFields*> own;
  for (const JoinsFields* join : joins)
    for (const JoinedFields& joined : join->joined()) {
      const Member *tied = member(joined.tied), *other = member(joined.other);
      if (tied == nullptr || other == nullptr) continue;
      own.push_back(&joined);
    }
  for (Member& of : members_) {
    std::vector<int> tied;
    for (const JoinedFields* joined : own)
      for (const auto& [side, nodes] : {std::pair(&joined->tied, true), std::pair(&joined->other, false)}) {
        if (member(*side) != &of) continue;
        for (const CellFace& face : side->faces) of.joined_faces.emplace(face.cell, face.face);
        for (std::size_t k = 0; k < joined->nodes.size() && nodes; ++k)
          tied.push_back(of.block().space->global_node(joined->nodes[k].first));
      }
    tied = communicator.gather_all(tied);
    of.tied.insert(tied.begin(), tied.end());
  }
  unite_parts(own, communicator);
}

const LevelGroup::Member* LevelGroup::member(const JoinedFields::Side& side) const {
  const auto found = std::ranges::find_if(members_, [&](const Member& of) {
    return of.entry->field.get() == side.field && of.level->block == side.block &&
           of.level->component == side.component;
  });
  return found == members_.end() ? nullptr : &*found;
}

void LevelGroup::find_members(std::vector<FieldEntry>& fields, const std::vector<const JoinsFields*>& joins,
                              FieldEntry& entry, LevelCondition& level) {
  const auto add = [&](FieldEntry& of, LevelCondition& its) {
    ConnectedNodes label(*of.field, its.block);
    std::vector<int> parts = label.parts();
    members_.push_back({&of, &its, std::move(label), std::move(parts), {}, {}});
  };
  const auto add_side = [&](const JoinedFields::Side& side) {
    for (FieldEntry& of : fields)
      for (LevelCondition& its : of.levels)
        if (of.field.get() == side.field && its.block == side.block && its.component == side.component) {
          add(of, its);
          return true;
        }
    return false;
  };
  add(entry, level);
  for (bool grows = true; grows;) {
    grows = false;
    for (const JoinsFields* join : joins)
      for (const JoinedFields& joined : join->joined()) {
        const bool first = member(joined.tied) != nullptr, second = member(joined.other) != nullptr;
        if (first != second) grows = add_side(first ? joined.other : joined.tied) || grows;
      }
  }
  // Whichever member asks, the same one comes first.
  members_.sort([](const Member& a, const Member& b) { return a.entry < b.entry; });
}

void LevelGroup::unite_parts(const std::vector<const JoinedFields*>& joins,
                             const Communicator& communicator) {
  std::vector<std::pair<const Member*, int>> all;
  for (const Member& of : members_)
    for (const int label : of.parts) {
      part_[{&of, label}] = all.size();
      all.emplace_back(&of, label);
    }
  std::vector<std::pair<std::size_t, std::size_t>> same;
  for (const JoinedFields* joined : joins) {
    const Member *tied = member(joined->tied), *other = member(joined->other);
    for (const auto& [node, to] : joined->nodes) {
      const auto one = part_.find({tied, tied->label[node]}), two = part_.find({other, other->label[to]});
      // Nodes of no active cell are of no part.
      if (one != part_.end() && two != part_.end()) same.emplace_back(one->second, two->second);
    }
  }
  std::ranges::sort(same);
  same.erase(std::unique(same.begin(), same.end()), same.end());
  DisjointSets sets(static_cast<int>(all.size()));
  for (const auto& [one, two] : communicator.gather_all(same))
    sets.unite(static_cast<int>(one), static_cast<int>(two));
  std::map<int, std::size_t> number;  // of a set
  for (std::size_t k = 0; k < all.size(); ++k)
    part_[all[k]] = number.emplace(sets.root(static_cast<int>(k)), number.size()).first->second;
  size_ = number.size();
}

std::size_t LevelGroup::part(const Member& member, int label) const { return part_.at({&member, label}); }

void place_levels(std::vector<FieldEntry>& fields, const std::vector<const JoinsFields*>& joins,
                  FieldEntry& entry) {
  for (LevelCondition& level : entry.levels) {
    LevelGroup group(fields, joins, entry, level);
    place_levels(group);
  }
}

void Problem::check_levels() {
  // What flows in at the boundary of a box and out nowhere is 0.45 and more of the flows through all nodes,
  // on any mesh; what goes together is less than 1e-9 of them. Where nothing flows, rounding is left of what
  // stands in the equations besides, as the loads of a stabilisation.
  constexpr double allowed = 1e-4, rounding = 1e-12;
  std::set<const LevelCondition*> done;
  for (FieldEntry& entry : fields_)
    for (LevelCondition& level : entry.levels) {
      if (done.contains(&level)) continue;
      LevelGroup group(fields_, joins_, entry, level);
      bool holds = false;
      for (const LevelGroup::Member& member : group.members()) {
        done.insert(member.level);
        holds = holds || !member.level->nodes.empty();
      }
      if (!communicator_.any(holds)) continue;
      const std::vector<double> through =
          assembler_->absolute_product([&](const Field&, const Block& of, int node, int c) {
            const bool is_level = std::ranges::any_of(group.members(), [&](const LevelGroup::Member& member) {
              return &of == &member.block() && c == member.level->component;
            });
            return is_level ? 0.0 : of.now.value[static_cast<std::size_t>(node) * of.size + c];
          });
      // The functions of a part add up to 1, its equations to what flows through its boundary.
      std::vector<double> sums(3 * group.size(), 0.0), closed(group.size(), 0.0);
      for (const LevelGroup::Member& member : group.members())
        for (int node = 0; node < member.block().space->owned_nodes(); ++node) {
          const int row =
              assembler_->row(*member.entry->field, member.level->block, node, member.level->component);
          if (row < 0 || assembler_->is_tied(row)) continue;  // what is tied has handed on its equation
          const std::size_t part = group.part(member, member.label[node]);
          sums[3 * part] += assembler_->full_residual()[row];
          sums[3 * part + 1] += through[row] * through[row];
          sums[3 * part + 2] += assembler_->magnitude()[row];
          if (std::ranges::find(member.level->nodes, node) != member.level->nodes.end()) closed[part] = 1;
        }
      communicator_.sum(sums);
      communicator_.sum(closed);
      double lost = 0;
      for (std::size_t part = 0; part < group.size(); ++part) {
        const double net = std::abs(sums[3 * part]);
        if (closed[part] > 0 && net > allowed * std::sqrt(sums[3 * part + 1]) + rounding * sums[3 * part + 2])
          lost = std::max(lost, net);
      }
      if (lost == 0) continue;
      throw Error(entry.conditions.empty() ? Location() : entry.conditions.front().where,
                  fmt::format("field '{}': nothing lets out of a closed part of it what is let in: {:.4g} "
                              "m^{}/s vanish at the "
                              "node "
                              "that holds the level of the {}. Either the velocities given on its boundary "
                              "and its bodies do not "
                              "balance; or a boundary has to be open; or a body takes it in, and sets the "
                              "level itself: then the "
                              "level "
                              "is not to be fixed (`fix_pressure: never`)",
                              entry.name, lost, entry.mesh->dimension(), level.unknown));
    }
}

}  // namespace seam
