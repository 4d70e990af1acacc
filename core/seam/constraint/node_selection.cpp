// SPDX-License-Identifier: BSD-3-Clause
#include "seam/constraint/node_selection.hpp"

#include <algorithm>

namespace seam {

std::vector<int> components_of(const Field& field, int block, const std::vector<std::string>& names) {
  for (const std::string& name : names) static_cast<void>(field.place(name));
  std::vector<int> result;
  for (const Unknown& unknown : field.unknowns()) {
    const Field::ComponentRange place = field.place(unknown.name);
    if (unknown.given || place.block != block) continue;
    if (!names.empty() && std::ranges::find(names, unknown.name) == names.end()) continue;
    for (int c = 0; c < place.components; ++c) result.push_back(place.offset + c);
  }
  return result;
}

bool is_free(const Block& block, int node, int component) {
  return block.active[node] != 0 &&
         block.prescribed[static_cast<std::size_t>(node) * block.size + component] == 0;
}

}  // namespace seam
