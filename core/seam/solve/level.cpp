// SPDX-License-Identifier: BSD-3-Clause
#include "seam/solve/level.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "seam/base/disjoint_sets.hpp"
#include "seam/cut/cut_mesh.hpp"

namespace seam {
namespace {

constexpr int none = std::numeric_limits<int>::max();

/// Labels connected nodes by their lowest global number. Cells that share a node are connected.
class ConnectedNodes {
 public:
  ConnectedNodes(const Field& field, int block)
      : field_(field), block_(block), space_(*field.blocks()[block].space) {
    label_.resize(space_.nodes());
    for (int n = 0; n < space_.nodes(); ++n) label_[n] = space_.global_node(n);
    bool changed = true;
    while (space_.mesh().communicator().any(changed)) {
      changed = merge();
      // Labels travel from owners to ghosts, one rank further each time.
      std::vector<int> before = label_;
      space_.halo().update(label_, 1);
      changed = changed || before != label_;
    }
  }
  [[nodiscard]] int operator[](int node) const { return label_[node]; }

 private:
  /// Gives the nodes of each local component their lowest label.
  bool merge() {
    DisjointSets sets(space_.nodes());
    for (int c = 0; c < space_.mesh().cells(); ++c)
      for (int p = 0; p < field_.parts(c) && field_.active_cells()[c]; ++p) {
        const int* nodes = field_.cell_nodes(block_, c, p);
        for (int a = 1; a < space_.nodes_per_cell(); ++a) sets.unite(nodes[a], nodes[0]);
      }
    std::vector<int> lowest(space_.nodes(), none);
    for (int n = 0; n < space_.nodes(); ++n) {
      int& least = lowest[sets.root(n)];
      least = std::min(least, label_[n]);
    }
    bool changed = false;
    for (int n = 0; n < space_.nodes(); ++n) {
      const int least = lowest[sets.root(n)];
      changed = changed || label_[n] != least;
      label_[n] = least;
    }
    return changed;
  }
  const Field& field_;
  int block_;
  const Space& space_;
  std::vector<int> label_;
};

/// Labels of the parts that reach an open boundary, on every rank.
std::vector<int> open_parts(const Field& field, int block, const ConnectedNodes& label,
                            const std::vector<std::string>& boundaries) {
  std::vector<int> open;
  CutRule rule;
  for (const std::string& name : boundaries)
    for (const CellFace& face : field.mesh().boundary(name)) {
      if (!field.active_cells()[face.cell] || face.cell >= field.mesh().owned_cells()) continue;
      for (int p = 0; p < field.parts(face.cell); ++p) {
        if (field.is_cut(face.cell)) {
          field.cut()->face_rule(face.cell, face.face, 1, rule, p);
          if (rule.count() == 0) continue;
        }
        open.push_back(label[field.cell_nodes(block, face.cell, p)[0]]);
      }
    }
  std::sort(open.begin(), open.end());
  open.erase(std::unique(open.begin(), open.end()), open.end());
  return field.mesh().communicator().gather_all(open);
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
    const std::vector<int> open = open_parts(field, level.block, label, level.open_boundaries);
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
  // on any mesh; what goes together is less than 1e-9 of them.
  constexpr double allowed = 1e-4;
  for (const FieldEntry& entry : fields_)
    for (const LevelCondition& level : entry.levels) {
      const Block& block = entry.field->blocks()[level.block];
      if (!communicator_.any(!level.nodes.empty())) continue;
      const std::vector<double> through =
          assembler_->absolute_product([&](const Field&, const Block& of, int component, double value) {
            return &of == &block && component == level.component ? 0.0 : std::abs(value);
          });
      double lost = 0, square = 0;
      for (int node = 0; node < block.space->owned_nodes(); ++node) {
        const int row = assembler_->row(*entry.field, level.block, node, level.component);
        if (row < 0) continue;
        square += through[row] * through[row];
        if (std::ranges::find(level.nodes, node) != level.nodes.end())
          lost = std::max(lost, std::abs(assembler_->full_residual()[row]));
      }
      lost = communicator_.max(lost);
      const double flow = std::sqrt(communicator_.sum(square));
      if (lost <= allowed * flow) continue;
      throw Error(fmt::format(
          "field '{}': nothing lets out of a closed part of it what is let in: {:.4g} m^{}/s vanish at the "
          "node "
          "that holds the level of the {}. Either the velocities given on its boundary and its bodies do not "
          "balance; or a boundary has to be open; or a body takes it in, and sets the level itself: then the "
          "level "
          "is not to be fixed (`fix_pressure: never`)",
          entry.name, lost, entry.mesh->dimension(), level.unknown));
    }
}

}  // namespace seam
