// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

/// Integration over polygons by other means than the cut's own: half planes cut them to a convex cell
/// (Sutherland and Hodgman, 1974), and Green's theorem with polynomials multiplied out integrates monomials.
using Precise = long double;
using PlanePoint = std::array<Precise, 2>;

/// Part of a polygon to the left of a -> b.
inline std::vector<PlanePoint> left_of(const std::vector<PlanePoint>& polygon, const PlanePoint& a,
                                       const PlanePoint& b) {
  const auto height = [&](const PlanePoint& p) {
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
  };
  std::vector<PlanePoint> part;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const PlanePoint &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const Precise hp = height(p), hq = height(q);
    if (hp >= 0) part.push_back(p);
    if ((hp < 0) != (hq < 0)) {
      const Precise t = hp / (hp - hq);
      part.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
    }
  }
  return part;
}

/// Integral of x^i y^j, by the sum over edges of x^(i+1) y^j / (i+1) dy.
inline Precise monomial_integral(const std::vector<PlanePoint>& polygon, int i, int j) {
  Precise sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const PlanePoint &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    std::vector<Precise> product{1};
    const auto multiply = [&](Precise constant, Precise slope) {
      product.push_back(0);
      for (std::size_t n = product.size() - 1; n > 0; --n)
        product[n] = constant * product[n] + slope * product[n - 1];
      product[0] *= constant;
    };
    for (int n = 0; n <= i; ++n) multiply(p[0], q[0] - p[0]);
    for (int n = 0; n < j; ++n) multiply(p[1], q[1] - p[1]);
    Precise edge = 0;
    for (std::size_t n = 0; n < product.size(); ++n) edge += product[n] / (n + 1);
    sum += edge * (q[1] - p[1]) / (i + 1);
  }
  return sum;
}
