// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/coverage.hpp"

#include <fmt/ranges.h>

#include <limits>

#include "seam/base/diagnostics.hpp"

namespace seam::cutting {
namespace {

constexpr int unknown = std::numeric_limits<int>::min();

/// Change of the coverage along each edge. Every cell at an edge found the same crossings: the first counts.
std::vector<int> steps_along_edges(const Outline& outline, const std::vector<CutCell>& cells) {
  std::vector<int> steps(outline.edges.size(), 0), counted_by(outline.edges.size(), -1);
  for (const CutCell& c : cells)
    for (const Crossing& x : c.crossings) {
      const bool plane = outline.dimension == 2;
      const int edge = plane ? outline.sides[x.place].edge[0] : x.place;
      if (counted_by[edge] == -1) counted_by[edge] = c.cell;
      if (counted_by[edge] == c.cell) steps[edge] += x.step * (plane ? outline.sides[x.place].forward[0] : 1);
    }
  return steps;
}

}  // namespace

std::vector<int> spread_coverage(const Mesh& mesh, const Outline& outline,
                                 const std::vector<LatticePoint>& vertex, const Facets& facets,
                                 const std::vector<CutCell>& cells) {
  const std::vector<int> steps = steps_along_edges(outline, cells);
  std::vector<int> coverage(vertex.size(), unknown), front;
  for (int seed = 0; seed < static_cast<int>(vertex.size()); ++seed) {
    if (coverage[seed] != unknown) continue;
    coverage[seed] = coverage_at(facets, vertex[seed]);
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
              fmt::format("the surfaces that cut mesh '{}' are not closed inside of it: near ({}) body and "
                          "fluid lie on the "
                          "same side; let open surfaces end outside the mesh or on its boundary",
                          mesh.name(), fmt::join(outline.position[v], ", ")));
        }
      }
    }
  }
  return coverage;
}

}  // namespace seam::cutting
