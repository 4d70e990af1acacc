// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/border.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace seam::cutting {
namespace {

/// Cosine between normals from which on a facet faces a side: less stand on it.
constexpr double facing = 0.5;
/// Steps of the lattice: beyond what rounding moves a facet and a side.
constexpr double steps = 8;

double length(const Vector& a) { return std::sqrt(dot(a, a)); }

std::vector<Border::Side> border_sides(const Outline& outline, int owned, const Communicator& communicator) {
  std::vector<Border::Side> mine;
  for (int c = 0; c < owned; ++c)
    for (int s = outline.first_side[c]; s < outline.first_side[c + 1]; ++s) {
      const auto& from = outline.sides[s];
      if (outline.neighbour[c][from.face] >= 0) continue;
      Border::Side& side = mine.emplace_back();
      for (int k = 0; k < 3; ++k)
        side.corner[k] = outline.position[from.vertex[std::min(k, outline.dimension - 1)]];
      side.normal = side_normal(outline, from);
      side.size = std::pow(outline.volume(c), 1.0 / outline.dimension);
    }
  // In an order that does not depend on who has which.
  std::vector<Border::Side> all = communicator.gather_all(mine);
  std::sort(all.begin(), all.end());
  return all;
}

std::pair<Vector, Vector> box_around(const Vector* x, int count, double margin) {
  Vector low = x[0], high = x[0];
  for (int k = 1; k < count; ++k)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], x[k][i]);
      high[i] = std::max(high[i], x[k][i]);
    }
  const Vector m{margin, margin, margin};
  return {low - m, high + m};
}

std::vector<std::pair<Vector, Vector>> boxes(const std::vector<Border::Side>& sides) {
  std::vector<std::pair<Vector, Vector>> result;
  for (const Border::Side& s : sides)
    result.push_back(box_around(s.corner.data(), 3, Border::flush_reach * s.size));
  return result;
}

}  // namespace

/// A plane of the border in which a vertex comes to lie.
struct Border::Plane {
  Vector normal;
  double offset;
  bool behind;  ///< the body lies behind the border

  /// Moves a position to a height above several planes, or as near as they allow.
  static Vector onto(const std::vector<Plane>& planes, Vector x, double height) {
    constexpr double independent = 0.1;  // sine of the angle to planes before: less would carry it away
    std::vector<Vector> used;            // orthonormal
    for (const Plane& p : planes) {
      const double wanted = p.offset + (p.behind ? -height : height) - dot(p.normal, x);
      Vector free = p.normal;
      for (const Vector& u : used) free = free - dot(free, u) * u;
      if (length(free) < independent) {
        x = x + wanted * p.normal;
        continue;
      }
      x = x + wanted / dot(free, p.normal) * free;
      used.push_back(1 / length(free) * free);
    }
    return x;
  }

  static void add(std::vector<Plane>& planes, const Plane& plane) {
    constexpr double same = 1 - 1e-12;  // cosine
    for (Plane& p : planes)
      if (dot(p.normal, plane.normal) > same) {
        p.behind = p.behind || plane.behind;
        return;
      }
    planes.push_back(plane);
  }
};

Border::Border(const Outline& outline, int owned, const Communicator& communicator)
    : sides_(border_sides(outline, owned, communicator)), search_(boxes(sides_)) {}

bool Border::is_flush(const Facets& facets, const Facet& facet, const Side& side) const {
  if (std::abs(dot(facet.normal, side.normal)) < facing) return false;
  for (int k = 0; k < facets.dimension; ++k)
    if (std::abs(dot(facets.position[facet.vertex[k]] - side.corner[0], side.normal)) >=
        flush_reach * side.size)
      return false;
  return true;
}

std::vector<Vector> Border::lay_flush(Facets& facets, int first_facet) const {
  // Vertices at one place stay together.
  std::map<LatticePoint, std::vector<Plane>> planes;
  std::vector<int> found;
  for (int f = first_facet; f < static_cast<int>(facets.list.size()); ++f) {
    const Facet& facet = facets.list[f];
    std::array<Vector, 3> x{};
    for (int k = 0; k < facets.dimension; ++k) x[k] = facets.position[facet.vertex[k]];
    const auto [low, high] = box_around(x.data(), facets.dimension, 0);
    found.clear();
    search_.find(low, high, found);
    std::sort(found.begin(), found.end());
    for (const int s : found) {
      const Side& side = sides_[s];
      if (!is_flush(facets, facet, side)) continue;
      const bool behind = dot(facet.normal, side.normal) > 0;
      for (int k = 0; k < facets.dimension; ++k)
        Plane::add(planes[facets.point[facet.vertex[k]]],
                   {side.normal, dot(side.normal, side.corner[0]), behind});
    }
  }
  std::vector<Vector> outward;
  if (planes.empty()) return outward;
  outward.resize(facets.point.size());
  for (std::size_t v = 0; v < facets.point.size(); ++v) {
    const auto here = planes.find(facets.point[v]);
    if (here == planes.end()) continue;
    facets.position[v] = Plane::onto(here->second, facets.position[v], 0);
    facets.point[v] =
        facets.lattice.round(Plane::onto(here->second, facets.position[v], steps * facets.lattice.spacing()));
    for (const Plane& p : here->second) outward[v] = outward[v] + p.normal;
  }
  return outward;
}

}  // namespace seam::cutting
