// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/coverage.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "seam/base/diagnostics.hpp"

namespace seam::cutting {
namespace {

constexpr int all_bodies = -1;
constexpr int unknown = std::numeric_limits<int>::min();

/// Change of the coverage along each edge. Every cell at an edge found the same crossings: the first counts.
std::vector<int> steps_along_edges(const Outline& outline, const std::vector<CutCell>& cells, int body) {
  std::vector<int> steps(outline.edges.size(), 0), counted_by(outline.edges.size(), -1);
  for (const CutCell& c : cells)
    for (const Crossing& x : c.crossings) {
      if (body != all_bodies && x.body != body) continue;
      const bool plane = outline.dimension == 2;
      const int edge = plane ? outline.sides[x.place].edge[0] : x.place;
      if (counted_by[edge] == -1) counted_by[edge] = c.cell;
      if (counted_by[edge] == c.cell) steps[edge] += x.step * (plane ? outline.sides[x.place].forward[0] : 1);
    }
  return steps;
}

std::vector<int> spread(const Mesh& mesh, const Outline& outline, const std::vector<LatticePoint>& vertex,
                        const Facets& facets, const std::vector<CutCell>& cells, int body) {
  const std::vector<int> steps = steps_along_edges(outline, cells, body);
  std::vector<int> coverage(vertex.size(), unknown), front;
  for (int seed = 0; seed < static_cast<int>(vertex.size()); ++seed) {
    if (coverage[seed] != unknown) continue;
    coverage[seed] =
        body == all_bodies ? coverage_at(facets, vertex[seed]) : winding(facets, body, vertex[seed]);
    front.assign(1, seed);
    while (!front.empty()) {
      const int v = front.back();
      front.pop_back();
      for (int k = outline.first_edge_of_vertex[v]; k < outline.first_edge_of_vertex[v + 1]; ++k) {
        const int e = outline.edges_of_vertex[k];
        const bool forward = outline.edges[e][0] == v;
        const int other = outline.edges[e][forward ? 1 : 0];
        const int value = coverage[v] + (forward ? steps[e] : -steps[e]);
        if (coverage[other] == unknown) {
          coverage[other] = value;
          front.push_back(other);
        } else if (coverage[other] != value) {
          throw Error(
              fmt::format("the surfaces that cut mesh '{}' are not closed inside of it: near ({}) inside and "
                          "outside lie on the "
                          "same side; let open surfaces end outside the mesh or on its boundary",
                          mesh.name(), fmt::join(outline.position[v], ", ")));
        }
      }
    }
  }
  return coverage;
}

}  // namespace

Coverage::Coverage(const Mesh& mesh, const Outline& outline, const std::vector<LatticePoint>& vertex,
                   const Facets& facets, const std::vector<CutCell>& cells, bool united) {
  if (united) {
    count_ = spread(mesh, outline, vertex, facets, cells, all_bodies);
    windings_.push_back(count_);
    return;
  }
  count_.assign(vertex.size(), 0);
  for (int body = 0; body < static_cast<int>(facets.far.size()); ++body) {
    windings_.push_back(spread(mesh, outline, vertex, facets, cells, body));
    for (std::size_t v = 0; v < vertex.size(); ++v) count_[v] += windings_.back()[v] > 0 ? 1 : 0;
  }
}

bool Coverage::overlap_in(const Outline& outline, const CutCell& cell) const {
  if (cell.pieces.empty()) return false;
  const int body = cell.pieces[0].body;
  if (windings_.size() > 1 && std::any_of(cell.pieces.begin(), cell.pieces.end(),
                                          [&](const FacetPiece& p) { return p.body != body; }))
    return true;
  for (int s = outline.first_side[cell.cell]; s < outline.first_side[cell.cell + 1]; ++s)
    for (int k = 0; k < outline.dimension; ++k) {
      const int v = outline.sides[s].vertex[k];
      for (int b = 0; b < static_cast<int>(windings_.size()); ++b) {
        const int w = windings_[b][v];
        if (w < 0 || w > 1 || (w == 1 && windings_.size() > 1 && b != body)) return true;
      }
    }
  return false;
}

}  // namespace seam::cutting
