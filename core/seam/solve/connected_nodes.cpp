// SPDX-License-Identifier: BSD-3-Clause
#include "seam/solve/connected_nodes.hpp"

#include <algorithm>
#include <limits>

#include "seam/base/disjoint_sets.hpp"

namespace seam {

ConnectedNodes::ConnectedNodes(const Field& field, int block) : field_(field), block_(block) {
  const Space& space = *field.blocks()[block].space;
  label_.resize(space.nodes());
  for (int n = 0; n < space.nodes(); ++n) label_[n] = space.global_node(n);
  bool changed = true;
  while (space.mesh().communicator().any(changed)) {
    changed = merge();
    // Labels travel from owners to ghosts, one rank further each time.
    std::vector<int> before = label_;
    space.halo().update(label_, 1);
    changed = merge_joined() || changed || before != label_;
  }
}

/// Gives the nodes of each local component their lowest label.
bool ConnectedNodes::merge() {
  const Space& space = *field_.blocks()[block_].space;
  DisjointSets sets(space.nodes());
  for (int c = 0; c < space.mesh().cells(); ++c)
    for (int p = 0; p < field_.parts(c) && field_.active_cells()[c]; ++p) {
      const int* nodes = field_.cell_nodes(block_, c, p);
      for (int a = 1; a < space.nodes_per_cell(); ++a) sets.unite(nodes[a], nodes[0]);
    }
  std::vector<int> lowest(space.nodes(), std::numeric_limits<int>::max());
  for (int n = 0; n < space.nodes(); ++n) {
    int& least = lowest[sets.root(n)];
    least = std::min(least, label_[n]);
  }
  bool changed = false;
  for (int n = 0; n < space.nodes(); ++n) {
    const int least = lowest[sets.root(n)];
    changed = changed || label_[n] != least;
    label_[n] = least;
  }
  return changed;
}

/// Gives nodes that are one and the same, on whatever rank, their lowest label.
bool ConnectedNodes::merge_joined() {
  const std::vector<std::vector<int>>* groups = field_.joined(block_);
  if (groups == nullptr) return false;
  const Space& space = *field_.blocks()[block_].space;
  const std::vector<int> before = label_;
  struct Label {
    std::size_t group;
    int label;
  };
  std::vector<Label> own;
  for (std::size_t g = 0; g < groups->size(); ++g)
    for (const int global : (*groups)[g])
      if (const int node = space.local_node(global); node >= 0 && node < space.owned_nodes())
        own.push_back({g, label_[node]});
  std::vector<int> lowest(groups->size(), std::numeric_limits<int>::max());
  for (const Label& l : space.mesh().communicator().gather_all(own))
    lowest[l.group] = std::min(lowest[l.group], l.label);
  for (std::size_t g = 0; g < groups->size(); ++g)
    for (const int global : (*groups)[g])
      if (const int node = space.local_node(global); node >= 0) label_[node] = lowest[g];
  return label_ != before;
}

std::vector<int> ConnectedNodes::parts() const {
  const auto sort = [](std::vector<int>& labels) {
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  };
  std::vector<int> labels;
  for (int c = 0; c < field_.mesh().owned_cells(); ++c)
    for (int p = 0; p < field_.parts(c) && field_.active_cells()[c]; ++p)
      labels.push_back(label_[field_.cell_nodes(block_, c, p)[0]]);
  sort(labels);
  labels = field_.mesh().communicator().gather_all(labels);
  sort(labels);
  return labels;
}

}  // namespace seam
