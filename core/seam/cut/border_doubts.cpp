// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "seam/cut/border.hpp"
#include "seam/cut/convex.hpp"

namespace seam::cutting {
namespace {

/// In cells: a body that ends farther short of the border is meant to.
constexpr double beside = 1e-2;
/// Of a side: less is rounding.
constexpr double negligible = 1e-6;

/// Length or area of what a facet covers of a side, both in its plane.
double common(int dimension, const Vector* facet, const Border::Side& side) {
  if (dimension == 2) {
    const Vector along = side.corner[1] - side.corner[0];
    const double whole = std::sqrt(dot(along, along));
    const double from = dot(facet[0] - side.corner[0], along) / whole,
                 to = dot(facet[1] - side.corner[0], along) / whole;
    return std::max(0.0, std::min(whole, std::max(from, to)) - std::max(0.0, std::min(from, to)));
  }
  const Polygon own(side.corner.begin(), side.corner.end()), other(facet, facet + 3);
  const Polygon part = common_part(own, turned_to(side.normal, other), side.normal, 0);
  return std::abs(dot(vector_area(part), side.normal));
}

double size_of(int dimension, const Border::Side& side) {
  return common(dimension, side.corner.data(), side);
}

}  // namespace

Border::Doubts Border::doubts(const Facets& facets) const {
  Doubts result;
  result.covered.assign(sides_.size(), 0.0);
  double largest = 0;
  for (const Side& side : sides_) largest = std::max(largest, side.size);
  const Vector margin{beside * largest, beside * largest, beside * largest};
  std::vector<int> found;
  for (const Facet& facet : facets.list) {
    std::array<Vector, 3> x{};
    Vector low = facets.position[facet.vertex[0]], high = low;
    for (int k = 0; k < facets.dimension; ++k) {
      x[k] = facets.position[facet.vertex[k]];
      for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], x[k][i]);
        high[i] = std::max(high[i], x[k][i]);
      }
    }
    found.clear();
    search_.find(low - margin, high + margin, found);
    std::sort(found.begin(), found.end());
    for (const int s : found) {
      const Side& side = sides_[s];
      if (dot(facet.normal, side.normal) < 0.5) continue;  // not a body behind the border
      double nearest = 1e300, farthest = -1e300;
      for (int k = 0; k < facets.dimension; ++k) {
        const double height = dot(x[k] - side.corner[0], side.normal) / side.size;
        nearest = std::min(nearest, height);
        farthest = std::max(farthest, height);
      }
      if (std::abs(nearest) < flush_reach && std::abs(farthest) < flush_reach) {
        result.covered[s] += common(facets.dimension, x.data(), side) / size_of(facets.dimension, side);
        continue;
      }
      const bool ends_short = nearest > -flush_reach && farthest < beside;
      const bool is_further = !result.short_of_it || farthest > result.short_of_it->width;
      if (ends_short && is_further &&
          common(facets.dimension, x.data(), side) > negligible * size_of(facets.dimension, side))
        result.short_of_it = Doubts::Gap{x[0], farthest};
    }
  }
  for (std::size_t s = 0; s < sides_.size() && !result.covered_partly; ++s)
    if (result.covered[s] > negligible && result.covered[s] < 1 - negligible)
      result.covered_partly = sides_[s].corner[0];
  return result;
}

}  // namespace seam::cutting
