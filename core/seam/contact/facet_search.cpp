// SPDX-License-Identifier: BSD-3-Clause
#include "seam/contact/facet_search.hpp"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>

#include "seam/cut/facet_vertices.hpp"
#include "seam/cut/lattice.hpp"

namespace seam {
namespace {

namespace bg = boost::geometry;
using Corner = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Corner>;
using Entry = std::pair<Box, int>;

/// A line that passes this part of a facet's size beside it still meets it: none slips between two facets.
constexpr double slack = 1e-10;
/// Least cosine between the direction and what looks against it: at a grazing angle the way to a facet says
/// nothing about how far apart surfaces are.
constexpr double facing = 0.5;

using namespace cutting;

Vector vertex(const Surface& surface, int facet, int k) {
  const int dim = surface.dimension;
  const int p = surface.facets[static_cast<std::size_t>(facet) * dim + k];
  Vector x{};
  std::copy_n(&surface.points[static_cast<std::size_t>(p) * dim], dim, x.begin());
  return x;
}

/// Where the line x + s n meets a facet. @param cosine result: of the angle between its outward normal and -n
std::optional<FacetSearch::Hit> cross_segment(const Surface& surface, int facet, const Vector& x,
                                              const Vector& n, double& cosine) {
  const Vector b = vertex(surface, facet, 0), t = vertex(surface, facet, 1) - b, r = x - b;
  const double against = cross(t, n)[2];  // the outward normal times -n times the length
  cosine = against / std::sqrt(dot(t, t));
  const double share = cross(r, n)[2] / against;
  if (share < -slack || share > 1 + slack) return std::nullopt;
  return FacetSearch::Hit{facet, {share, 0}, dot(share * t - r, n)};
}

std::optional<FacetSearch::Hit> cross_triangle(const Surface& surface, int facet, const Vector& x,
                                               const Vector& n, double& cosine) {
  const Vector b = vertex(surface, facet, 0), first_edge = vertex(surface, facet, 1) - b,
               second_edge = vertex(surface, facet, 2) - b, area = cross(first_edge, second_edge), r = x - b,
               across = cross(n, r);
  const double against = -dot(area, n);
  cosine = against / std::sqrt(dot(area, area));
  const double first = -dot(second_edge, across) / against, second = dot(first_edge, across) / against;
  if (first < -slack || second < -slack || first + second > 1 + slack) return std::nullopt;
  return FacetSearch::Hit{facet, {first, second}, dot(first * first_edge + second * second_edge - r, n)};
}

std::optional<FacetSearch::Hit> cross_facet(const Surface& surface, int facet, const Vector& x,
                                            const Vector& n, double& cosine) {
  return (surface.dimension == 2 ? cross_segment : cross_triangle)(surface, facet, x, n, cosine);
}

Vector nearest_on_segment(const Vector& x, const Vector& a, const Vector& b) {
  const Vector along = b - a;
  return a + std::clamp(dot(x - a, along) / dot(along, along), 0.0, 1.0) * along;
}

double square_distance(const Vector& a, const Vector& b) { return dot(a - b, a - b); }

/// How far a point is from a facet, m.
double distance(const Surface& surface, int facet, const Vector& x) {
  const int dim = surface.dimension;
  const Vector a = vertex(surface, facet, 0), b = vertex(surface, facet, 1);
  double least = square_distance(x, nearest_on_segment(x, a, b));
  if (dim == 3) {
    const Vector c = vertex(surface, facet, 2), first = b - a, second = c - a, area = cross(first, second),
                 way = x - a;
    const double square = dot(area, area), height = dot(way, area);
    const double share1 = dot(cross(way, second), area) / square,
                 share2 = dot(cross(first, way), area) / square;
    if (share1 >= 0 && share2 >= 0 && share1 + share2 <= 1) return std::abs(height) / std::sqrt(square);
    least = std::min({least, square_distance(x, nearest_on_segment(x, b, c)),
                      square_distance(x, nearest_on_segment(x, c, a))});
  }
  return std::sqrt(least);
}

Box box_along(const Vector& x, const Vector& direction, double from, double to) {
  const double margin = slack * (to - from);
  Vector low{}, high{};
  for (int d = 0; d < 3; ++d) {
    const double back = x[d] + from * direction[d], front = x[d] + to * direction[d];
    low[d] = std::min(back, front) - margin;
    high[d] = std::max(back, front) + margin;
  }
  return {Corner(low[0], low[1], low[2]), Corner(high[0], high[1], high[2])};
}

}  // namespace

struct FacetSearch::Tree {
  bg::index::rtree<Entry, bg::index::quadratic<16>> index;
};

FacetSearch::FacetSearch(Surface surface) : surface_(std::move(surface)), tree_(std::make_unique<Tree>()) {
  const int dim = surface_.dimension;
  std::vector<Entry> entries;
  entries.reserve(surface_.facet_count());
  for (int f = 0; f < surface_.facet_count(); ++f) {
    Vector low = vertex(surface_, f, 0), high = low;
    for (int k = 1; k < dim; ++k) {
      const Vector x = vertex(surface_, f, k);
      for (int d = 0; d < dim; ++d) {
        low[d] = std::min(low[d], x[d]);
        high[d] = std::max(high[d], x[d]);
      }
    }
    entries.emplace_back(Box(Corner(low[0], low[1], low[2]), Corner(high[0], high[1], high[2])), f);
  }
  tree_->index = decltype(tree_->index)(entries.begin(), entries.end());
}

FacetSearch::~FacetSearch() = default;
FacetSearch::FacetSearch(FacetSearch&&) noexcept = default;
FacetSearch& FacetSearch::operator=(FacetSearch&&) noexcept = default;

void FacetSearch::find_near(const double* low, const double* high, const double* direction,
                            std::vector<int>& facets) const {
  const auto query =
      bg::index::intersects(Box(Corner(low[0], low[1], low[2]), Corner(high[0], high[1], high[2])));
  for (auto entry = tree_->index.qbegin(query); entry != tree_->index.qend(); ++entry) {
    const int dim = surface_.dimension, facet = entry->second;
    if (direction == nullptr) {
      facets.push_back(facet);
      continue;
    }
    const std::array<Vector, 3> corner{vertex(surface_, facet, 0), vertex(surface_, facet, 1),
                                       dim == 3 ? vertex(surface_, facet, 2) : Vector{}};
    const Vector outwards = facet_normal(dim, corner);
    double along = 0;
    for (int d = 0; d < dim; ++d) along += outwards[d] * direction[d];
    if (-along >= facing * std::sqrt(dot(outwards, outwards))) facets.push_back(facet);
  }
}

std::optional<FacetSearch::Hit> FacetSearch::find(const double* x, const double* direction, double depth,
                                                  double reach, const Exclude& exclude) const {
  const int dim = surface_.dimension;
  Vector point{}, along{};
  std::copy_n(x, dim, point.begin());
  std::copy_n(direction, dim, along.begin());
  std::optional<Hit> best;
  const auto query = bg::index::intersects(box_along(point, along, -depth, reach));
  for (auto entry = tree_->index.qbegin(query); entry != tree_->index.qend(); ++entry) {
    double cosine = 0;
    const auto hit = cross_facet(surface_, entry->second, point, along, cosine);
    if (!hit || cosine < facing || hit->gap < -depth || hit->gap > reach) continue;
    // Of two that share the border on which the line lies, the first: the tree's order says nothing.
    if (best && (std::abs(hit->gap) > std::abs(best->gap) ||
                 (std::abs(hit->gap) == std::abs(best->gap) && hit->facet > best->facet)))
      continue;
    if (exclude && exclude(hit->facet)) continue;
    best = hit;
  }
  return best;
}

bool FacetSearch::encloses(const double* x, const double* direction, double margin,
                           const Exclude& exclude) const {
  const int dim = surface_.dimension;
  Vector point{}, along{};
  std::copy_n(x, dim, point.begin());
  std::copy_n(direction, dim, along.begin());
  const auto counts = [&](const Entry& entry) { return !exclude || !exclude(entry.second); };
  const Box near(Corner(point[0] - margin, point[1] - margin, point[2] - margin),
                 Corner(point[0] + margin, point[1] + margin, point[2] + margin));
  // Boxes of facets say nothing of how near these are, but where they lie along an axis.
  const auto is_near = [&](const Entry& entry) {
    return counts(entry) && distance(surface_, entry.second, point) <= margin;
  };
  const auto around = bg::index::intersects(near) && bg::index::satisfies(is_near);
  if (tree_->index.qbegin(around) != tree_->index.qend()) return false;
  const Box all = tree_->index.bounds();
  const Corner &low = all.min_corner(), &high = all.max_corner();
  const double far =
      std::hypot(high.get<0>() - low.get<0>(), high.get<1>() - low.get<1>(), high.get<2>() - low.get<2>());
  double nearest = far, facing_away = 0;
  const auto ahead = bg::index::intersects(box_along(point, along, 0, far)) && bg::index::satisfies(counts);
  for (auto entry = tree_->index.qbegin(ahead); entry != tree_->index.qend(); ++entry) {
    double cosine = 0;
    const auto hit = cross_facet(surface_, entry->second, point, along, cosine);
    if (!hit || cosine == 0 || hit->gap < 0 || hit->gap >= nearest) continue;
    nearest = hit->gap;
    facing_away = -cosine;
  }
  return facing_away > 0;
}

}  // namespace seam
