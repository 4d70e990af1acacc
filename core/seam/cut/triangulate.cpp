// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/triangulate.hpp"

#include <algorithm>
#include <numeric>

namespace seam::cutting {
namespace {

using Loop = std::vector<Vector>;

/// Twice the signed area.
double turn(const Vector& a, const Vector& b, const Vector& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double twice_area(const Loop& loop) {
  double sum = 0;
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) sum += turn(loop[0], loop[k], loop[k + 1]);
  return sum;
}

bool contains(const Loop& loop, const Vector& x) {
  bool inside = false;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vector &a = loop[k], &b = loop[(k + 1) % loop.size()];
    if ((a[1] > x[1]) == (b[1] > x[1])) continue;
    inside ^= (turn(a, b, x) > 0) == (b[1] > a[1]);
  }
  return inside;
}

bool cross_each_other(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

bool meets(const Vector& a, const Vector& b, const Loop& loop) {
  for (std::size_t k = 0; k < loop.size(); ++k)
    if (cross_each_other(a, b, loop[k], loop[(k + 1) % loop.size()])) return true;
  return false;
}

/// Makes a hole part of the outline around it: there and back along the shortest way that meets neither of
/// them nor another hole.
void join(Loop& outer, const Loop& hole, const std::vector<Loop>& others) {
  std::vector<std::pair<std::size_t, std::size_t>> ways;
  for (std::size_t i = 0; i < outer.size(); ++i)
    for (std::size_t j = 0; j < hole.size(); ++j) ways.emplace_back(i, j);
  const auto length = [&](const auto& way) {
    const Vector step = hole[way.second] - outer[way.first];
    return dot(step, step);
  };
  std::sort(ways.begin(), ways.end(), [&](const auto& a, const auto& b) { return length(a) < length(b); });
  const auto free = std::find_if(ways.begin(), ways.end(), [&](const auto& way) {
    const Vector &a = outer[way.first], &b = hole[way.second];
    return !meets(a, b, outer) && !meets(a, b, hole) &&
           std::none_of(others.begin(), others.end(), [&](const Loop& other) { return meets(a, b, other); });
  });
  const auto [i, j] = free == ways.end() ? ways.front() : *free;
  Loop detour(hole.begin() + static_cast<std::ptrdiff_t>(j), hole.end());
  detour.insert(detour.end(), hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(j) + 1);
  detour.push_back(outer[i]);
  outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(i) + 1, detour.begin(), detour.end());
}

/// Whether the corner can be cut off: it is convex, and no other corner lies in the triangle.
bool is_ear(const Loop& loop, std::size_t k) {
  const std::size_t n = loop.size();
  const Vector &a = loop[(k + n - 1) % n], &b = loop[k], &c = loop[(k + 1) % n];
  if (turn(a, b, c) <= 0) return false;
  return std::none_of(loop.begin(), loop.end(), [&](const Vector& x) {
    return x != a && x != b && x != c && turn(a, b, x) >= 0 && turn(b, c, x) >= 0 && turn(c, a, x) >= 0;
  });
}

/// Cuts off one ear after the other, that with the shortest base first. What rounding has left without any
/// ear loses the corner with the shortest base: then the area is still right.
void cut_ears(Loop loop, std::vector<Triangle>& triangles) {
  while (loop.size() > 2) {
    const std::size_t n = loop.size();
    std::vector<std::size_t> corner(n);
    std::iota(corner.begin(), corner.end(), std::size_t{0});
    std::vector<double> base(n);
    for (std::size_t k = 0; k < n; ++k) {
      const Vector step = loop[(k + 1) % n] - loop[(k + n - 1) % n];
      base[k] = dot(step, step);
    }
    std::sort(corner.begin(), corner.end(), [&](std::size_t a, std::size_t b) { return base[a] < base[b]; });
    const auto found =
        std::find_if(corner.begin(), corner.end(), [&](std::size_t k) { return is_ear(loop, k); });
    const std::size_t k = found == corner.end() ? corner.front() : *found;
    triangles.push_back({loop[(k + n - 1) % n], loop[k], loop[(k + 1) % n]});
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

}  // namespace

std::vector<Triangle> triangulate(const std::vector<std::vector<Vector>>& outlines) {
  std::vector<Loop> outer, holes;
  for (const Loop& loop : outlines) (twice_area(loop) > 0 ? outer : holes).push_back(loop);
  // A hole that runs within rounding of its outline may stick out of all of them; its area is rounding, too.
  while (!holes.empty()) {
    const Loop hole = std::move(holes.back());
    holes.pop_back();
    const auto around = std::find_if(outer.begin(), outer.end(), [&](const Loop& loop) {
      return std::any_of(hole.begin(), hole.end(), [&](const Vector& x) { return contains(loop, x); });
    });
    if (around != outer.end()) join(*around, hole, holes);
  }
  std::vector<Triangle> triangles;
  for (const Loop& loop : outer) cut_ears(loop, triangles);
  return triangles;
}

}  // namespace seam::cutting
