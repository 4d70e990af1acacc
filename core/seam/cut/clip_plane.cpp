// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "seam/cut/clip.hpp"

namespace seam::cutting {
namespace {

/// Where a facet enters (+1) or leaves (-1) a cell.
struct Event {
  double share;  ///< of the facet's length
  int step;
  Vector position;
};

/// Twice the area of abc, made to agree with its exact sign: where it does not, it is mere rounding.
double area(const Vector& a, const Vector& b, const Vector& c, int sign) {
  const double value = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  return std::max(0.0, sign * value);
}

/// a / (a + b); where rounding leaves nothing of both, that of the same sizes on the lattice.
template <class OnLattice>
double ratio(double a, double b, const OnLattice& on_lattice) {
  if (a + b > 0) return a / (a + b);
  const auto [c, d] = on_lattice();
  return c + d > 0 ? c / (c + d) : 0.5;
}

/// Of the way from a to b, of the point next to x.
double share(const Vector& a, const Vector& b, const Vector& x) {
  const double square = dot(b - a, b - a);
  return square > 0 ? dot(x - a, b - a) / square : 0.5;
}

double between(double x, double a, double b) { return std::clamp(x, std::min(a, b), std::max(a, b)); }

/// Whether a body's vertex lies in a cell, by a ray along the x axis. A vertex (infinitesimally translated)
/// is never level with one of the cell's.
bool contains(const ClipInput& input, int cell, const LatticePoint& p) {
  bool inside = false;
  for (int s = input.outline.first_side[cell]; s < input.outline.first_side[cell + 1]; ++s) {
    const auto& side = input.outline.sides[s];
    const LatticePoint &a = input.vertex[side.vertex[0]], &b = input.vertex[side.vertex[1]];
    const bool a_above = a.x[1] > p.x[1], b_above = b.x[1] > p.x[1];
    if (a_above != b_above && side_of_mesh_edge(a, b, p) == (b_above ? 1 : -1)) inside = !inside;
  }
  return inside;
}

void find_events(const ClipInput& input, const Facet& facet, CutCell& cell, std::vector<Event>& events) {
  const LatticePoint &p = input.facets.point[facet.vertex[0]], &q = input.facets.point[facet.vertex[1]];
  const Vector &xp = input.facets.position[facet.vertex[0]], &xq = input.facets.position[facet.vertex[1]];
  events.clear();
  for (int s = input.outline.first_side[cell.cell]; s < input.outline.first_side[cell.cell + 1]; ++s) {
    const Side& side = input.outline.sides[s];
    // Evaluated in the direction of the edge, neighbours find the same numbers.
    const auto& edge = input.outline.edges[side.edge[0]];
    const LatticePoint &a = input.vertex[edge[0]], &b = input.vertex[edge[1]];
    const int side_a = side_of_facet(p, q, a), side_b = side_of_facet(p, q, b);
    if (side_a == side_b) continue;
    const int side_p = side_of_mesh_edge(a, b, p), side_q = side_of_mesh_edge(a, b, q);
    if (side_p == side_q) continue;
    const Vector &xa = input.outline.position[edge[0]], &xb = input.outline.position[edge[1]];
    const double at = ratio(area(xp, xq, xa, side_a), area(xp, xq, xb, side_b),
                            [&] { return std::pair(std::abs(size(p, q, a)), std::abs(size(p, q, b))); });
    // Of two that run along each other rounding alone says where they meet, but not beyond the end of one.
    const double on_edge = std::clamp(between(at, share(xa, xb, xp), share(xa, xb, xq)), 0.0, 1.0);
    const Vector position = xa + on_edge * (xb - xa);
    const double on_facet = share(xp, xq, position);
    const int along = side.forward[0] > 0 ? 1 : -1;
    cell.crossings.push_back({facet.body, s, along * side_b, along > 0 ? on_edge : 1 - on_edge, position});
    events.push_back({on_facet, along * side_q, position});
  }
  std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.share < b.share; });
  // Passages through one point are the only ones whose order rounding can reverse.
  bool inside = contains(input, cell.cell, p);
  for (std::size_t k = 0; k < events.size(); inside = !inside, ++k) {
    const int expected = inside ? -1 : 1;
    const auto next =
        std::find_if(events.begin() + k, events.end(), [&](const Event& e) { return e.step == expected; });
    if (next != events.end()) std::swap(events[k], *next);
  }
}

}  // namespace

void clip_segments(const ClipInput& input, std::span<const int> facets, CutCell& cell) {
  static thread_local std::vector<Event> events;
  for (const int f : facets) {
    const Facet& facet = input.facets.list[f];
    find_events(input, facet, cell, events);
    bool inside = contains(input, cell.cell, input.facets.point[facet.vertex[0]]);
    Vector from = input.facets.position[facet.vertex[0]];
    const auto add = [&](const Vector& to) {
      cell.pieces.push_back({facet.body, facet.facet, static_cast<int>(cell.points.size()), 2, facet.normal});
      cell.points.push_back(from);
      cell.points.push_back(to);
    };
    for (const Event& e : events) {
      if (inside) add(e.position);
      from = e.position;
      inside = !inside;
    }
    if (inside) add(input.facets.position[facet.vertex[1]]);
  }
}

void find_wet_sides(const ClipInput& input, const std::vector<int>& coverage, CutCell& cell) {
  std::sort(cell.crossings.begin(), cell.crossings.end(), [](const Crossing& a, const Crossing& b) {
    return std::pair(a.place, a.share) < std::pair(b.place, b.share);
  });
  auto crossing = cell.crossings.begin();
  for (int s = input.outline.first_side[cell.cell]; s < input.outline.first_side[cell.cell + 1]; ++s) {
    const Side& side = input.outline.sides[s];
    int covered = coverage[side.vertex[0]];
    Vector from = input.outline.position[side.vertex[0]];
    const Vector normal = side_normal(input.outline, side);
    const Vector along{-normal[1], normal[0], 0};
    const auto add = [&](const Vector& to) {
      if (covered != 0) return;
      cell.wet.push_back({side.face, normal, {from, to, to}, 1.0, dot(to - from, along)});
    };
    for (; crossing != cell.crossings.end() && crossing->place == s; ++crossing) {
      // Bodies are united: only rounding can have two crossings in a row go the same way, of facets that run
      // along the side.
      const int step = covered == 0 ? 1 : -1;
      const auto next = std::find_if(crossing, cell.crossings.end(),
                                     [&](const Crossing& c) { return c.place == s && c.step == step; });
      if (next != cell.crossings.end()) std::iter_swap(crossing, next);
      add(crossing->position);
      covered += crossing->step;
      from = crossing->position;
    }
    add(input.outline.position[side.vertex[1]]);
  }
}

}  // namespace seam::cutting
