// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/cut_mesh.hpp"

#include <algorithm>
#include <stdexcept>

#include "seam/cut/clip.hpp"
#include "seam/cut/coverage.hpp"
#include "seam/cut/geometry.hpp"
#include "seam/cut/slivers.hpp"

namespace seam {
namespace {

using namespace cutting;

/// Facets that may meet each cell, [cell, facet] in ascending order.
std::vector<std::pair<int, int>> candidates(const CellSearch& search, const Facets& facets) {
  std::vector<std::pair<int, int>> pairs;
  std::vector<int> cells;
  const double hair = 4 * facets.lattice.spacing();  // what rounding to the lattice moves
  for (int f = 0; f < static_cast<int>(facets.list.size()); ++f) {
    Vector low = facets.position[facets.list[f].vertex[0]], high = low;
    for (int k = 1; k < facets.dimension; ++k)
      for (int i = 0; i < 3; ++i) {
        const double x = facets.position[facets.list[f].vertex[k]][i];
        low[i] = std::min(low[i], x);
        high[i] = std::max(high[i], x);
      }
    const Vector margin{hair, hair, hair};
    cells.clear();
    search.find(low - margin, high + margin, cells);
    for (const int c : cells) pairs.emplace_back(c, f);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<CutCell> clip(const ClipInput& input, const std::vector<std::pair<int, int>>& pairs) {
  std::vector<CutCell> cells;
  std::vector<int> facets;
  for (std::size_t k = 0; k < pairs.size();) {
    CutCell cell;
    cell.cell = pairs[k].first;
    facets.clear();
    for (; k < pairs.size() && pairs[k].first == cell.cell; ++k) facets.push_back(pairs[k].second);
    clip_segments(input, facets, cell);
    if (!cell.pieces.empty()) cells.push_back(std::move(cell));
  }
  return cells;
}

}  // namespace

CutMesh::CutMesh(const Mesh& mesh)
    : mesh_(&mesh), state_(mesh.cells(), CellState::fluid), geometry_(std::make_unique<Geometry>(mesh)) {
  geometry_->index.assign(mesh.cells(), -1);
}

CutMesh::~CutMesh() = default;

void CutMesh::cut(std::span<const Surface> bodies) {
  Geometry& g = *geometry_;
  g.bodies.assign(bodies.begin(), bodies.end());
  const Lattice before = g.facets.lattice;
  g.facets = collect_facets(g.outline, bodies);
  if (g.vertex.empty() || !(g.facets.lattice == before)) {
    g.vertex.clear();
    for (const Vector& x : g.outline.position) g.vertex.push_back(g.facets.lattice.round(x));
  }
  const ClipInput input{g.outline, g.vertex, g.facets};
  g.cells = clip(input, candidates(g.search, g.facets));
  g.coverage = spread_coverage(*mesh_, g.outline, g.vertex, g.facets, g.cells);
  for (int c = 0; c < mesh_->cells(); ++c) {
    const int vertex = g.outline.sides[g.outline.first_side[c]].vertex[0];
    state_[c] = g.coverage[vertex] > 0 ? CellState::body : CellState::fluid;
  }
  for (CutCell& c : g.cells) {
    find_wet_sides(input, g.coverage, c);
    measure(g.outline, c);
  }
  settle_slivers(g.outline, g.cells, state_);
  g.index.assign(mesh_->cells(), -1);
  cut_cells_.clear();
  for (std::size_t k = 0; k < g.cells.size(); ++k) {
    g.index[g.cells[k].cell] = static_cast<int>(k);
    cut_cells_.push_back(g.cells[k].cell);
  }
}

const CutCell& CutMesh::Geometry::at(int cell) const {
  if (index[cell] < 0) throw std::logic_error("CutMesh: the cell is not cut");
  return cells[index[cell]];
}

double CutMesh::fluid_volume(int cell) const { return geometry_->at(cell).fluid_volume; }
double CutMesh::cell_volume(int cell) const { return geometry_->at(cell).volume; }
double CutMesh::interface_area(int cell) const { return geometry_->at(cell).interface_area; }

}  // namespace seam
