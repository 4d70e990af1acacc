// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/joined.hpp"

#include <cmath>
#include <map>

#include "seam/base/disjoint_sets.hpp"

namespace seam::cutting {
namespace {

using Edge = std::array<LatticePoint, 2>;  ///< the ends of an edge; in the plane twice the same point
using Signs = std::map<int, int>;  ///< by surface: how often its rim runs here, and in which direction

void note(std::map<Edge, Signs>& rims, int surface, const LatticePoint& a, const LatticePoint& b, int sign) {
  (a < b ? rims[{a, b}][surface] : rims[{b, a}][surface]) += a < b || a == b ? sign : -sign;
}

void note_rims(const Surface& surface, int number, const Lattice& lattice, std::map<Edge, Signs>& rims) {
  const int dim = surface.dimension;
  for (int f = 0; f < surface.facet_count(); ++f) {
    std::array<LatticePoint, 3> p;
    for (int k = 0; k < dim; ++k) {
      Vector x{};
      for (int i = 0; i < dim; ++i)
        x[i] = surface.points[static_cast<std::size_t>(surface.facets[f * dim + k]) * dim + i];
      p[k] = lattice.round(x);
    }
    if (dim == 2) {
      note(rims, number, p[0], p[0], -1);
      note(rims, number, p[1], p[1], 1);
    } else {
      for (int k = 0; k < 3; ++k)
        if (p[k] != p[(k + 1) % 3]) note(rims, number, p[k], p[(k + 1) % 3], 1);
    }
  }
}

void append(const Surface& from, int number, Surface& to, std::vector<std::array<int, 2>>& origin) {
  const int first = to.point_count();
  to.dimension = from.dimension;
  to.points.insert(to.points.end(), from.points.begin(), from.points.end());
  for (const int v : from.facets) to.facets.push_back(first + v);
  for (int f = 0; f < from.facet_count(); ++f) origin.push_back({number, f});
}

}  // namespace

Solids join(std::span<const Surface> surfaces, const Lattice& lattice) {
  const int count = static_cast<int>(surfaces.size());
  std::map<Edge, Signs> rims;
  for (int s = 0; s < count; ++s)
    if (!surfaces[s].closed) note_rims(surfaces[s], s, lattice, rims);
  DisjointSets sets(count);
  for (const auto& [place, signs] : rims)
    for (const auto& [a, sign_a] : signs)
      for (const auto& [b, sign_b] : signs)
        if (sign_a * sign_b < 0) sets.unite(a, b);
  std::vector<char> has_rim(count, 0);  // [root]
  for (const auto& [place, signs] : rims) {
    std::map<int, int> left;  // by root
    for (const auto& [s, sign] : signs) left[sets.root(s)] += sign;
    for (const auto& [root, sign] : left)
      if (sign != 0) has_rim[root] = 1;
  }
  Solids result;
  std::map<int, std::vector<int>> members;
  for (int s = 0; s < count; ++s) members[sets.root(s)].push_back(s);
  for (const auto& [root, of_solid] : members) {
    Surface& solid = result.surfaces.emplace_back();
    auto& origin = result.origin.emplace_back();
    for (const int s : of_solid) append(surfaces[s], s, solid, origin);
    solid.closed = of_solid.size() > 1 ? has_rim[root] == 0 : surfaces[root].closed;
  }
  return result;
}

}  // namespace seam::cutting
