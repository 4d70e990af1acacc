// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <tuple>

#include "seam/cut/cells_of_nodes.hpp"
#include "seam/cut/part_sets.hpp"
#include "seam/state/state_store.hpp"

namespace seam {
namespace {

constexpr int none = -1;

/// The part of a cell that one of its parts was before; none where the cell was no part of the field.
int former_part(const PartLayout& before, const CutMesh& cut, int cell, int part) {
  if (!before.active[cell]) return none;
  const int count = before.count(cell);
  if (count == 1) return 0;
  const auto centre = cut.part_centre(cell, part);
  int nearest = 0;
  double least = std::numeric_limits<double>::max();
  for (int p = 0; p < count; ++p) {
    double square = 0;
    for (int d = 0; d < 3; ++d) {
      const double way = before.part(cell, p)->centre[d] - centre[d];
      square += way * way;
    }
    if (square < least) nearest = p;
    least = std::min(least, square);
  }
  return nearest;
}

int set_at(const PartLayout& layout, int order, int cell, int part, int node) {
  const PartLayout::Sets* listed = layout.part(cell, part);
  return listed ? listed->set[order - 1][node] : 0;
}

/// What speaks for one set of a node having been another.
struct Vote {
  int now, before;
  double volume;
};

/// What a set of a node was before.
struct Source {
  int set = none;
  bool shared = false;  ///< another one has a better claim to it
};

/// [set now]
std::vector<Source> elect(const std::vector<Vote>& votes, int sets) {
  std::vector<std::vector<double>> sum(sets, std::vector<double>(sets, 0.0));
  for (const Vote& v : votes) sum[v.now][v.before] += v.volume;
  std::vector<std::tuple<double, int, int>> candidates;
  for (int k = 0; k < sets; ++k)
    for (int m = 0; m < sets; ++m)
      if (sum[k][m] > 0) candidates.emplace_back(-sum[k][m], k, m);
  std::sort(candidates.begin(), candidates.end());
  std::vector<Source> source(sets);
  std::vector<char> taken(sets, 0);
  for (const auto& [volume, now, before] : candidates)
    if (source[now].set == none && !taken[before]) {
      source[now].set = before;
      taken[before] = 1;
    }
  for (const auto& [volume, now, before] : candidates)
    if (source[now].set == none) source[now] = {before, true};
  return source;
}

/// @return whether anything moved
bool move_states(const std::vector<StateArray<double>*>& states, Block& block, int node,
                 const std::vector<Source>& source, const std::vector<char>& used) {
  const Space& space = *block.space;
  const int sets = space.sets();
  bool same = true;
  for (int k = 0; k < sets; ++k) same = same && (!used[k] || (source[k].set == k && !source[k].shared));
  if (same) return false;
  for (StateArray<double>* state : states)
    for (std::vector<double>& values : state->all_levels())
      for (int c = 0; c < state->size(); ++c) {
        std::vector<double> former(sets);
        const auto at = [&](int set) -> double& {
          return values[static_cast<std::size_t>(space.in_set(node, set)) * state->size() + c];
        };
        for (int k = 0; k < sets; ++k) former[k] = at(k);
        for (int k = 0; k < sets; ++k)
          if (source[k].set != none) at(k) = former[source[k].set];
      }
  std::vector<char> known(sets);
  for (int k = 0; k < sets; ++k) known[k] = block.known[space.in_set(node, k)];
  for (int k = 0; k < sets; ++k) {
    char& now = block.known[space.in_set(node, k)];
    now = source[k].set == none ? 0 : known[source[k].set];
    if (now == 1 && source[k].shared) now = known_if_needed;
  }
  return true;
}

/// Nodes owned here around which parts are or were told apart.
std::vector<char> affected_nodes(const Space& space, const PartLayout& before, const PartLayout& now) {
  std::vector<char> affected(space.nodes(), 0);
  for (int c = 0; c < space.mesh().cells(); ++c)
    if (before.part(c, 0) != nullptr || now.part(c, 0) != nullptr)
      for (int a = 0; a < space.nodes_per_cell(); ++a)
        if (const int n = space.cell_nodes(c)[a]; n < space.owned_nodes()) affected[n] = 1;
  return affected;
}

}  // namespace

void carry_over(Field& field, const PartLayout& before, const PartLayout& now, const CutMesh& cut) {
  for (Block& block : field.blocks()) {
    const Space& space = *block.space;
    const std::vector<StateArray<double>*> states = field.state().extended_on(space);
    const int order = space.order();
    bool changed = false;
    const CellsOfNodes cells_of(space, affected_nodes(space, before, now));
    for (const int node : cells_of.nodes()) {
      std::vector<Vote> votes;
      std::vector<char> used(space.sets(), 0);
      for (const auto& [cell, a] : cells_of.around(node)) {
        for (int p = 0; p < now.count(cell) && now.active[cell]; ++p) {
          const int set = set_at(now, order, cell, p, a), former = former_part(before, cut, cell, p);
          used[set] = 1;
          const double share =
              cut.state(cell) == CellState::cut ? cut.wet_volume(cell, p) / cut.cell_volume(cell) : 1.0;
          // However thin a part is, it has a say where it is the only one.
          if (former != none)
            votes.push_back({set, set_at(before, order, cell, former, a), std::max(share, 1e-9)});
        }
      }
      changed = move_states(states, block, node, elect(votes, space.sets()), used) || changed;
    }
    if (!field.mesh().communicator().any(changed)) continue;
    for (StateArray<double>* state : states)
      for (std::vector<double>& values : state->all_levels()) space.halo().update(values, state->size());
    space.halo().update(block.known, 1);
  }
}

}  // namespace seam
