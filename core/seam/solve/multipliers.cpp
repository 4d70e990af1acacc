// SPDX-License-Identifier: BSD-3-Clause
#include "seam/solve/multipliers.hpp"

#include <map>
#include <set>
#include <string>
#include <vector>

#include "seam/field/field.hpp"

namespace seam {
namespace {

/// @param tied of the field: block and global node
void leave_out(Field& field, const std::set<std::pair<int, int>>& tied) {
  std::map<std::pair<std::string, int>, std::set<int>> holders;  // by unknown and global node: blocks
  const auto for_each = [&](const auto& use) {
    for (const Unknown& unknown : field.unknowns()) {
      if (!unknown.boundaries || unknown.multiplier_of.empty()) continue;
      const int number = field.place(unknown.name).block;
      const Block& block = field.blocks()[number];
      for (int node = 0; node < block.space->owned_nodes(); ++node)
        if (block.surface_share[node] > 0) use(unknown, number, block, node);
    }
  };
  for_each([&](const Unknown& unknown, int number, const Block& block, int node) {
    holders[{unknown.multiplier_of, block.space->global_node(node)}].insert(number);
  });
  std::map<int, std::vector<int>> nodes;  // by block
  for_each([&](const Unknown& unknown, int number, const Block& block, int node) {
    const Field::ComponentRange held = field.place(unknown.multiplier_of);
    const Block& of = field.blocks()[held.block];
    const int global = block.space->global_node(node);
    bool is_given =
        holders.at({unknown.multiplier_of, global}).size() > 1 || tied.contains({held.block, global});
    if (const int there = of.space->local_node(global); there >= 0)
      for (int c = held.offset; c < held.offset + held.components; ++c)
        is_given = is_given || of.prescribed[static_cast<std::size_t>(there) * of.size + c] != 0;
    if (is_given) nodes[number].push_back(node);
  });
  for (std::size_t b = 0; b < field.blocks().size(); ++b)
    if (field.blocks()[b].boundaries) field.leave_out(static_cast<int>(b), nodes[static_cast<int>(b)]);
}

}  // namespace

void leave_out_multipliers(const std::vector<Field*>& fields, const std::vector<Ties::Resolved>& ties) {
  int first = 0;  // number of a field's first block among those of all
  for (Field* field : fields) {
    const int count = static_cast<int>(field->blocks().size());
    std::set<std::pair<int, int>> tied;
    for (const Ties::Resolved& tie : ties)
      if (tie.unknown.block >= first && tie.unknown.block < first + count)
        tied.emplace(tie.unknown.block - first, tie.unknown.node);
    leave_out(*field, tied);
    first += count;
  }
}

}  // namespace seam
