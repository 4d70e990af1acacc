// SPDX-License-Identifier: BSD-3-Clause
#include "seam/contact/facet_search.hpp"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>

#include "seam/term/tensor.hpp"

namespace seam {
namespace {

namespace bg = boost::geometry;
using Corner = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Corner>;
using Entry = std::pair<Box, int>;

/// A line that passes this part of a facet's size beside it still meets it: none slips between two facets.
constexpr double slack = 1e-10;
/// Cosine between direction and facet from which on the line counts as parallel to it.
constexpr double parallel = 1e-3;

template <int dim>
Vec<dim, double> vertex(const Surface& surface, int facet, int k) {
  Vec<dim, double> x;
  const int p = surface.facets[static_cast<std::size_t>(facet) * dim + k];
  for (int d = 0; d < dim; ++d) x[d] = surface.points[static_cast<std::size_t>(p) * dim + d];
  return x;
}

std::optional<FacetSearch::Hit> meet(const Surface& surface, int facet, const Vec<2, double>& x,
                                     const Vec<2, double>& n) {
  const Vec<2, double> b = vertex<2>(surface, facet, 0), t = vertex<2>(surface, facet, 1) - b;
  const double against = t[0] * n[1] - t[1] * n[0];  // -(outward normal . n) times the length
  if (against < parallel * std::sqrt(dot(t, t))) return std::nullopt;
  const Vec<2, double> r = x - b;
  const double share = (r[0] * n[1] - r[1] * n[0]) / against;
  if (share < -slack || share > 1 + slack) return std::nullopt;
  return FacetSearch::Hit{facet, {share, 0}, dot(share * t - r, n)};
}

std::optional<FacetSearch::Hit> meet(const Surface& surface, int facet, const Vec<3, double>& x,
                                     const Vec<3, double>& n) {
  const Vec<3, double> b = vertex<3>(surface, facet, 0), e1 = vertex<3>(surface, facet, 1) - b,
                       e2 = vertex<3>(surface, facet, 2) - b, area = cross(e1, e2);
  const double against = -dot(area, n);
  if (against < parallel * std::sqrt(dot(area, area))) return std::nullopt;
  const Vec<3, double> r = x - b, across = cross(n, r);
  const double first = -dot(e2, across) / against, second = dot(e1, across) / against;
  if (first < -slack || second < -slack || first + second > 1 + slack) return std::nullopt;
  return FacetSearch::Hit{facet, {first, second}, dot(first * e1 + second * e2 - r, n)};
}

template <int dim>
std::optional<FacetSearch::Hit> meet(const Surface& surface, int facet, const double* x, const double* n) {
  Vec<dim, double> point, direction;
  std::copy_n(x, dim, point.c.begin());
  std::copy_n(n, dim, direction.c.begin());
  return meet(surface, facet, point, direction);
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
    std::array<double, 3> low{}, high{};
    for (int d = 0; d < dim; ++d) {
      low[d] = 1e300;
      high[d] = -1e300;
      for (int k = 0; k < dim; ++k) {
        const int p = surface_.facets[static_cast<std::size_t>(f) * dim + k];
        low[d] = std::min(low[d], surface_.points[static_cast<std::size_t>(p) * dim + d]);
        high[d] = std::max(high[d], surface_.points[static_cast<std::size_t>(p) * dim + d]);
      }
    }
    entries.emplace_back(Box(Corner(low[0], low[1], low[2]), Corner(high[0], high[1], high[2])), f);
  }
  tree_->index = decltype(tree_->index)(entries.begin(), entries.end());
}

FacetSearch::~FacetSearch() = default;
FacetSearch::FacetSearch(FacetSearch&&) noexcept = default;
FacetSearch& FacetSearch::operator=(FacetSearch&&) noexcept = default;

std::optional<FacetSearch::Hit> FacetSearch::find(const double* x, const double* direction, double depth,
                                                  double reach, const Exclude& exclude) const {
  const int dim = surface_.dimension;
  const double margin = slack * (depth + reach);
  std::array<double, 3> low{}, high{};
  for (int d = 0; d < dim; ++d) {
    const double back = x[d] - depth * direction[d], front = x[d] + reach * direction[d];
    low[d] = std::min(back, front) - margin;
    high[d] = std::max(back, front) + margin;
  }
  const Box box(Corner(low[0], low[1], low[2]), Corner(high[0], high[1], high[2]));
  std::optional<Hit> best;
  const auto query = bg::index::intersects(box);
  for (auto entry = tree_->index.qbegin(query); entry != tree_->index.qend(); ++entry) {
    const auto hit = dim == 2 ? meet<2>(surface_, entry->second, x, direction)
                              : meet<3>(surface_, entry->second, x, direction);
    if (!hit || hit->gap < -depth || hit->gap > reach) continue;
    // Of two that share the border on which the line lies, the first: the tree's order says nothing.
    if (best && (std::abs(hit->gap) > std::abs(best->gap) ||
                 (std::abs(hit->gap) == std::abs(best->gap) && hit->facet > best->facet)))
      continue;
    if (exclude && exclude(hit->facet, hit->gap)) continue;
    best = hit;
  }
  return best;
}

}  // namespace seam
