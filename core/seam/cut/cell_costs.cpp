// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/cell_costs.hpp"

#include "seam/cut/cut_mesh.hpp"

namespace seam {

std::vector<double> cut_cell_costs(const Mesh& whole, const std::vector<Surface>& bodies) {
  CutMesh cut(whole);
  cut.cut(bodies);
  std::vector<double> cost(whole.cells());
  for (int c = 0; c < whole.cells(); ++c) {
    const CellState state = cut.state(c);
    cost[whole.global_cell(c)] = state == CellState::wet ? 1.0 : state == CellState::cut ? 4.0 : 0.05;
  }
  return cost;
}

}  // namespace seam
