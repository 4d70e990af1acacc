// SPDX-License-Identifier: BSD-3-Clause
#include "seam/assembly/remote_cells.hpp"

#include <algorithm>
#include <unordered_map>

#include "seam/assembly/element.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"

namespace seam {

void RemoteCell::attach(ElementSide& side, const Field& field) const {
  side.field = &field;
  side.global_cell = global_cell;
  side.geometry = geometry.data();
  side.diameter = diameter;
  side.nodes.resize(nodes.size());
  for (std::size_t b = 0; b < nodes.size(); ++b) side.nodes[b] = nodes[b].data();
}

std::vector<RemoteCell> fetch_cells(Field& field, const std::vector<int>& global_cells) {
  const Mesh& mesh = field.mesh();
  const Communicator& communicator = mesh.communicator();
  const int dim = mesh.dimension(), ranks = communicator.size();
  std::vector<std::vector<int>> wanted(ranks);
  for (const int cell : global_cells) wanted[mesh.owner_of_global_cell()[cell]].push_back(cell);
  const auto asked = communicator.exchange(wanted);

  std::unordered_map<int, int> local;
  for (int c = 0; c < mesh.owned_cells(); ++c) local[mesh.global_cell(c)] = c;
  // Geometry and diameter; then, per block, number and owner of each node, and its position.
  std::vector<std::vector<double>> geometry(ranks), positions(ranks);
  std::vector<std::vector<int>> nodes(ranks);
  for (int r = 0; r < ranks; ++r)
    for (const int global : asked[r]) {
      const int cell = local.at(global);
      geometry[r].insert(geometry[r].end(), mesh.geometry(cell),
                         mesh.geometry(cell) + mesh.geometry_nodes() * dim);
      geometry[r].push_back(mesh.diameter(cell));
      for (const Block& block : field.blocks())
        for (int a = 0; a < block.space->nodes_per_cell(); ++a) {
          const int node = block.space->cell_nodes(cell)[a];
          nodes[r].push_back(block.space->global_node(node));
          nodes[r].push_back(block.space->owner(node));
          positions[r].insert(positions[r].end(), block.space->position(node),
                              block.space->position(node) + dim);
        }
    }
  const auto got_geometry = communicator.exchange(geometry);
  const auto got_nodes = communicator.exchange(nodes);
  const auto got_positions = communicator.exchange(positions);

  std::vector<RemoteCell> result(global_cells.size());
  std::vector<std::vector<Space::ForeignNode>> foreign(field.blocks().size());
  std::vector<std::size_t> geometry_at(ranks, 0), node_at(ranks, 0);
  for (std::size_t k = 0; k < global_cells.size(); ++k) {
    const int r = mesh.owner_of_global_cell()[global_cells[k]];
    RemoteCell& cell = result[k];
    cell.global_cell = global_cells[k];
    const std::size_t length = static_cast<std::size_t>(mesh.geometry_nodes()) * dim;
    const auto from = got_geometry[r].begin() + static_cast<std::ptrdiff_t>(geometry_at[r]);
    cell.geometry.assign(from, from + static_cast<std::ptrdiff_t>(length));
    cell.diameter = *(from + static_cast<std::ptrdiff_t>(length));
    geometry_at[r] += length + 1;
    cell.nodes.resize(field.blocks().size());
    for (std::size_t b = 0; b < field.blocks().size(); ++b)
      for (int a = 0; a < field.blocks()[b].space->nodes_per_cell(); ++a, ++node_at[r]) {
        Space::ForeignNode node{got_nodes[r][2 * node_at[r]], got_nodes[r][2 * node_at[r] + 1], {0, 0, 0}};
        for (int d = 0; d < dim; ++d) node.position[d] = got_positions[r][node_at[r] * dim + d];
        foreign[b].push_back(node);
        cell.nodes[b].push_back(node.global);
      }
  }
  for (std::size_t b = 0; b < field.blocks().size(); ++b) {
    field.add_foreign(static_cast<int>(b), foreign[b]);
    for (RemoteCell& cell : result)
      for (int& node : cell.nodes[b]) node = field.blocks()[b].space->local_node(node);
  }
  return result;
}

}  // namespace seam
