// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/part_sets.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

#include "seam/base/disjoint_sets.hpp"
#include "seam/cut/cells_of_nodes.hpp"
#include "seam/state/entities.hpp"

namespace seam {
namespace {

constexpr int bits = 2;  ///< for the number of a set: at most 4
constexpr int per_word = 15;

/// Orders the sets of a node: first that in whose wet part it lies, which has number 0, then those that
/// undivided cells use, by the lowest number of a cell. Where the node lies in none of them number 0 is used
/// only when all others are taken.
struct Key {
  bool apart = true;  ///< the node lies elsewhere
  int undivided = std::numeric_limits<int>::max(), cell = undivided, part = 0;
  friend auto operator<=>(const Key&, const Key&) = default;
  void include(const Key& other) {
    apart = apart && other.apart;
    undivided = std::min(undivided, other.undivided);
    std::tie(cell, part) = std::min(std::pair(cell, part), std::pair(other.cell, other.part));
  }
};

/// The parts of cells around one node, and which of them are connected there.
class NodeParts {
 public:
  /// @param position of the node
  NodeParts(const CutMesh& cut, const std::vector<char>& active, std::span<const CellNode> cells,
            const double* position)
      : cut_(cut) {
    std::copy_n(position, cut.mesh().dimension(), position_.begin());
    for (const CellNode& c : cells)
      for (int p = 0; p < cut.parts(c.cell) && active[c.cell]; ++p) members_.push_back({c.cell, c.node, p});
  }
  struct Member {
    int cell, node, part;
  };

  /// Calls assign(member, set), unless all are of set 0.
  /// @return whether there are sets for all, so that none is shared
  template <class Assign>
  bool number(int most, const Assign& assign) const {
    const int count = static_cast<int>(members_.size());
    DisjointSets sets(count);
    connect(sets);
    std::map<int, Key> key;  // by root
    for (int k = 0; k < count; ++k) key[sets.root(k)];
    if (key.size() < 2) return true;
    for (int k = 0; k < count; ++k) key[sets.root(k)].include(key_of(members_[k]));
    std::map<Key, int> order;
    for (const auto& [root, k] : key) order[k] = 0;
    const int wanted = static_cast<int>(order.size());
    int next = order.begin()->first.apart && wanted < most ? 1 : 0;
    for (auto& [k, number] : order) number = std::min(next++, most - 1);
    for (int k = 0; k < count; ++k) assign(members_[k], order.at(key.at(sets.root(k))));
    return wanted <= most;
  }

 private:
  [[nodiscard]] Key key_of(const Member& m) const {
    // Nodes lie on the border of cells, where inside and outside are no clear question.
    constexpr double inward = 1e-7;
    std::array<double, 3> inside = position_;
    const std::array<double, 3> middle = cut_.cell_centre(m.cell);
    for (int d = 0; d < 3; ++d) inside[d] += inward * (middle[d] - inside[d]);
    const int global = cut_.mesh().global_cell(m.cell);
    return {!cut_.holds(m.cell, m.part, inside),
            cut_.parts(m.cell) == 1 ? global : std::numeric_limits<int>::max(), global, m.part};
  }
  void connect(DisjointSets& sets) const {
    const int faces = static_cast<int>(topology(cut_.mesh().type()).faces.size());
    for (std::size_t k = 0; k < members_.size(); ++k) {
      if (members_[k].part != 0) continue;
      for (int f = 0; f < faces; ++f) {
        const int other = cut_.neighbour(members_[k].cell, f);
        if (other < members_[k].cell) continue;
        const auto first =
            std::find_if(members_.begin(), members_.end(), [&](const Member& m) { return m.cell == other; });
        if (first == members_.end()) continue;
        for (const auto& [p, q] : cut_.joined(members_[k].cell, f))
          sets.unite(static_cast<int>(k) + p, static_cast<int>(first - members_.begin()) + q);
      }
    }
  }
  const CutMesh& cut_;
  std::array<double, 3> position_{};
  std::vector<Member> members_;  ///< those of a cell behind each other
};

}  // namespace

PartSets::Sets PartSets::choose(const CutMesh& cut, const std::vector<char>& active, const Space& space,
                                std::vector<std::array<double, 3>>& shared) const {
  const int per_cell = space.nodes_per_cell(), cells = field_->mesh().cells();
  Sets sets(cells);
  std::vector<char> wanted(space.nodes(), 0);
  for (int c = 0; c < cells; ++c) {
    if (!active[c]) continue;
    sets[c].assign(static_cast<std::size_t>(cut.parts(c)) * per_cell, 0);
    if (cut.state(c) == CellState::cut)
      for (int a = 0; a < per_cell; ++a) wanted[space.cell_nodes(c)[a]] = 1;
  }
  const CellsOfNodes cells_of(space, wanted);
  for (const int node : cells_of.nodes())
    if (!NodeParts(cut, active, cells_of.around(node), space.position(node))
             .number(space.sets(),
                     [&](const auto& m, int set) { sets[m.cell][m.part * per_cell + m.node] = set; }))
      std::copy_n(space.position(node), cut.mesh().dimension(), shared.emplace_back().begin());
  exchange(per_cell, sets);
  return sets;
}

/// Only the owner of a cell is sure to see all cells around its nodes.
void PartSets::exchange(int per_cell, Sets& sets) const {
  const Communicator& communicator = field_->mesh().communicator();
  if (communicator.size() == 1) return;
  int most = per_cell;
  for (const auto& of_cell : sets) most = std::max(most, static_cast<int>(of_cell.size()));
  most = communicator.max(most);
  for (int first = 0; first < most; first += per_word) {
    const auto count = [&](int c) {
      return std::clamp(static_cast<int>(sets[c].size()) - first, 0, per_word);
    };
    ghosts_.update(
        [&](int c) {
          int word = 0;
          for (int k = 0; k < count(c); ++k) word |= sets[c][first + k] << (bits * k);
          return word;
        },
        [&](int c, int word) {
          for (int k = 0; k < count(c); ++k) sets[c][first + k] = word >> (bits * k) & ((1 << bits) - 1);
        });
  }
}

std::shared_ptr<PartLayout> PartSets::find(const CutMesh& cut, const std::vector<char>& active) {
  shared_.clear();
  auto layout = std::make_shared<PartLayout>();
  layout->active = active;
  std::array<Sets, 2> sets;
  std::array<const Space*, 2> spaces{};
  for (const Block& block : field_->blocks()) {
    const int o = block.space->order() - 1;
    spaces[o] = block.space.get();
    sets[o] = choose(cut, active, *block.space, shared_);
  }
  const auto is_listed = [&](int c) {
    if (cut.parts(c) > 1) return true;
    for (const Sets& of_order : sets)
      if (!of_order.empty() &&
          std::any_of(of_order[c].begin(), of_order[c].end(), [](int set) { return set != 0; }))
        return true;
    return false;
  };
  for (int c = 0; c < field_->mesh().cells(); ++c) {
    layout->first.push_back(static_cast<int>(layout->parts.size()));
    if (!active[c] || !is_listed(c)) continue;
    for (int p = 0; p < cut.parts(c); ++p) {
      PartLayout::Sets& part = layout->parts.emplace_back();
      part.centre = cut.part_centre(c, p);
      for (int o = 0; o < 2; ++o) {
        if (spaces[o] == nullptr) continue;
        const int per_cell = spaces[o]->nodes_per_cell();
        const auto from = sets[o][c].begin() + static_cast<std::ptrdiff_t>(p) * per_cell;
        part.set[o].assign(from, from + per_cell);
        for (int a = 0; a < per_cell; ++a)
          part.node[o].push_back(spaces[o]->in_set(spaces[o]->cell_nodes(c)[a], part.set[o][a]));
      }
    }
  }
  layout->first.push_back(static_cast<int>(layout->parts.size()));
  return layout;
}

}  // namespace seam
