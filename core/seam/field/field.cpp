// SPDX-License-Identifier: BSD-3-Clause
#include "seam/field/field.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "seam/base/diagnostics.hpp"
#include "seam/cut/cut_mesh.hpp"

namespace seam {

Field::Field(std::string name, const Mesh& mesh, std::vector<Unknown> unknowns, int sets)
    : name_(std::move(name)),
      mesh_(&mesh),
      unknowns_(std::move(unknowns)),
      active_cells_(mesh.cells(), 1),
      sets_(sets) {
  for (const Unknown& unknown : unknowns_) {
    int b = 0;
    const auto shared = [&](const Block& block) {
      return block.space->order() == unknown.order && block.given == unknown.given;
    };
    while (b < static_cast<int>(blocks_.size()) && !shared(blocks_[b])) ++b;
    if (b == static_cast<int>(blocks_.size())) {
      blocks_.emplace_back();
      blocks_[b].space = std::make_unique<Space>(mesh, unknown.order, sets);
      blocks_[b].given = unknown.given;
    }
    places_.push_back({b, blocks_[b].size, unknown.components});
    blocks_[b].size += unknown.components;
    blocks_[b].components.push_back(unknown.components);
    blocks_[b].time_order.insert(blocks_[b].time_order.end(), unknown.components, unknown.time_order);
  }
  for (Block& block : blocks_) resize(block);
}

/// Gives every node of the space a place in the block's arrays; new ones start active, free and at zero.
void Field::resize(Block& block) {
  const std::size_t n = static_cast<std::size_t>(block.space->nodes()) * block.size;
  block.now.resize(n);
  block.old.resize(n);
  block.active.resize(block.space->nodes(), block.given ? 0 : 1);
  block.known.resize(block.space->nodes(), 1);
  block.prescribed.resize(n, 0);
  block.prescribed_value.resize(n, 0.0);
}

void Field::add_foreign(int block, const std::vector<Space::ForeignNode>& nodes) {
  blocks_[block].space->add_foreign(nodes);
  resize(blocks_[block]);
}

int Field::order() const {
  int order = 1;
  for (const Block& block : blocks_) order = std::max(order, block.space->order());
  return order;
}

Field::ComponentRange Field::place(const std::string& unknown) const {
  std::vector<std::string> names;
  for (std::size_t u = 0; u < unknowns_.size(); ++u) {
    if (unknowns_[u].name == unknown) return places_[u];
    names.push_back(unknowns_[u].name);
  }
  throw Error(
      fmt::format("field '{}' has no unknown '{}'; it has: {}", name_, unknown, fmt::join(names, ", ")));
}

double Field::constant(const std::string& name) const {
  const auto found = constants_.find(name);
  if (found != constants_.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : constants_) names.push_back(entry.first);
  throw Error(
      fmt::format("field '{}' has no constant '{}'; it has: {}", name_, name, fmt::join(names, ", ")));
}

void Field::occupy(std::vector<char> cell_is_active, const CutMesh* cut) {
  active_cells_ = std::move(cell_is_active);
  cut_ = cut;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    Block& block = blocks_[b];
    if (block.given) continue;
    std::fill(block.active.begin(), block.active.end(), 0);
    for (int c = 0; c < mesh_->cells(); ++c)
      for (int p = 0; p < parts(c) && active_cells_[c]; ++p) {
        const int* nodes = cell_nodes(static_cast<int>(b), c, p);
        for (int a = 0; a < block.space->nodes_per_cell(); ++a) block.active[nodes[a]] = 1;
      }
    // The owner knows every cell of its nodes; a rank's outermost ghosts do not.
    block.space->halo().update(block.active, 1);
  }
}

bool Field::is_covered(int cell) const {
  return cut_ && active_cells_[cell] && cut_->state(cell) == CellState::body;
}

bool Field::is_cut(int cell) const {
  return cut_ && active_cells_[cell] && cut_->state(cell) != CellState::wet;
}

}  // namespace seam
