// SPDX-License-Identifier: BSD-3-Clause
#include "seam/solve/level.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "seam/assembly/assembler.hpp"
#include "seam/cut/cut_mesh.hpp"
#include "seam/solve/connected_nodes.hpp"

namespace seam {
namespace {

/// Labels of the parts that reach an open boundary on this rank.
std::vector<int> open_parts(const Field& field, int block, const ConnectedNodes& label,
                            const std::vector<std::string>& boundaries) {
  // In widths of a cell: a body that ends less than that short of a boundary covers it, too.
  constexpr double narrowest = 1e-9;
  const Mesh& mesh = field.mesh();
  std::vector<int> open;
  CutRule rule;
  for (const std::string& name : boundaries)
    for (const CellFace& face : mesh.boundary(name)) {
      if (!field.active_cells()[face.cell] || face.cell >= mesh.owned_cells()) continue;
      for (int p = 0; p < field.parts(face.cell); ++p) {
        if (field.is_cut(face.cell)) {
          field.cut()->face_rule(face.cell, face.face, 1, rule, p);
          const double wet = std::accumulate(rule.weight.begin(), rule.weight.end(), 0.0);
          if (wet <= narrowest * std::pow(mesh.diameter(face.cell), mesh.dimension() - 1)) continue;
        }
        open.push_back(label[field.cell_nodes(block, face.cell, p)[0]]);
      }
    }
  return open;
}

/// Labels of the parts where the scene prescribes the unknown at a node, which gives the level.
std::vector<int> prescribed_parts(const Block& block, int component, const ConnectedNodes& label) {
  std::vector<int> parts;
  for (int node = 0; node < block.space->owned_nodes(); ++node)
    if (block.active[node] && block.prescribed[static_cast<std::size_t>(node) * block.size + component])
      parts.push_back(label[node]);
  return parts;
}

/// The node that holds each closed part, by label.
std::map<int, int> choose_nodes(const Field& field, int block, const ConnectedNodes& label,
                                const std::vector<int>& open) {
  const Space& space = *field.blocks()[block].space;
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
      const int* nodes = field.cell_nodes(block, c, p);
      if (std::find(open.begin(), open.end(), label[nodes[0]]) != open.end()) continue;
      for (int a = 0; a < space.nodes_per_cell(); ++a)
        offer({label[nodes[a]], space.global_node(nodes[a]), !field.is_cut(c)});
    }
  std::vector<Candidate> mine;
  for (const auto& [part, candidate] : best) mine.push_back(candidate);
  for (const Candidate& c : field.mesh().communicator().gather_all(mine)) offer(c);
  std::map<int, int> nodes;
  for (const auto& [part, candidate] : best) nodes[part] = candidate.node;
  return nodes;
}

}  // namespace

void place_levels(FieldEntry& entry) {
  Field& field = *entry.field;
  for (LevelCondition& level : entry.levels) {
    Block& block = field.blocks()[level.block];
    const auto unknown_of = [&](int node) {
      return static_cast<std::size_t>(node) * block.size + level.component;
    };
    for (const int node : level.nodes) block.prescribed[unknown_of(node)] = 0;
    level.nodes.clear();
    const ConnectedNodes label(field, level.block);
    std::vector<int> open = open_parts(field, level.block, label, level.open_boundaries);
    for (const int part : prescribed_parts(block, level.component, label)) open.push_back(part);
    std::sort(open.begin(), open.end());
    open.erase(std::unique(open.begin(), open.end()), open.end());
    open = field.mesh().communicator().gather_all(open);
    for (const auto& [part, global] : choose_nodes(field, level.block, label, open)) {
      const int node = block.space->local_node(global);
      if (node < 0) continue;
      level.nodes.push_back(node);
      block.prescribed[unknown_of(node)] = 1;
      block.prescribed_value[unknown_of(node)] = level.value;
    }
  }
}

void Problem::check_levels() const {
  // What flows in at the boundary of a box and out nowhere is 0.45 and more of the flows through all nodes,
  // on any mesh; what goes together is less than 1e-9 of them. Where nothing flows, rounding is left of what
  // stands in the equations besides, as the loads of a stabilisation.
  constexpr double allowed = 1e-4, rounding = 1e-12;
  for (const FieldEntry& entry : fields_)
    for (const LevelCondition& level : entry.levels) {
      const Block& block = entry.field->blocks()[level.block];
      if (!communicator_.any(!level.nodes.empty())) continue;
      const std::vector<double> through =
          assembler_->absolute_product([&](const Field&, const Block& of, int node, int c) {
            const bool is_level = &of == &block && c == level.component;
            return is_level ? 0.0 : of.now.value[static_cast<std::size_t>(node) * of.size + c];
          });
      // The functions of a part add up to 1, its equations to what flows through its boundary.
      const ConnectedNodes label(*entry.field, level.block);
      const std::vector<int> parts = label.parts();
      std::vector<double> sums(3 * parts.size(), 0.0), closed(parts.size(), 0.0);
      for (int node = 0; node < block.space->owned_nodes(); ++node) {
        const int row = assembler_->row(*entry.field, level.block, node, level.component);
        const auto part = std::ranges::lower_bound(parts, label[node]) - parts.begin();
        if (row < 0 || assembler_->is_tied(row)) continue;  // what is tied has handed on its equation
        sums[3 * part] += assembler_->full_residual()[row];
        sums[3 * part + 1] += through[row] * through[row];
        sums[3 * part + 2] += assembler_->magnitude()[row];
        if (std::ranges::find(level.nodes, node) != level.nodes.end()) closed[part] = 1;
      }
      communicator_.sum(sums);
      communicator_.sum(closed);
      double lost = 0;
      for (std::size_t part = 0; part < parts.size(); ++part) {
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
