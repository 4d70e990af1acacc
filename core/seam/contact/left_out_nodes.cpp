// SPDX-License-Identifier: BSD-3-Clause
#include "seam/contact/left_out_nodes.hpp"

#include <algorithm>

#include "seam/assembly/element.hpp"
#include "seam/field/field.hpp"

namespace seam {

void hand_on_functions(const Field& field, int face, ElementSide& side) {
  side.own_functions.clear();
  const CellTopology& cell = topology(field.mesh().type());
  for (std::size_t b = 0; b < field.blocks().size(); ++b) {
    const Block& block = field.blocks()[b];
    if (!block.boundaries) continue;
    const int order = block.space->order();
    std::vector<int> kept, left_out;  // places in the cell
    for (int a = 0; a < topology(cell.face_type).nodes(order); ++a) {
      const int place = cell.face_nodes[face][a];
      (block.left_out[side.nodes[b][place]] != 0 ? left_out : kept).push_back(place);
    }
    if (left_out.empty() || kept.empty()) continue;
    side.own_functions.resize(field.blocks().size());
    ShapeTable& own = side.own_functions[b];
    own = *side.table[order - 1];
    for (auto* numbers : {&own.value, &own.gradient, &own.hessian})
      for (auto row = numbers->begin(); row != numbers->end(); row += own.stride)
        for (const int from : left_out) {
          for (const int to : kept) row[to] += row[from] / static_cast<double>(kept.size());
          row[from] = 0;
        }
  }
}

}  // namespace seam
