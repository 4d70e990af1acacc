// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace seam {
namespace {

using Vector = std::array<double, 3>;

/// By how much of all directions a facet is seen from a point, with a sign.
double part_of_view(const Surface& s, int facet, const double* x) {
  const int dim = s.dimension;
  Vector r[3]{};
  for (int k = 0; k < dim; ++k)
    for (int d = 0; d < dim; ++d)
      r[k][d] = s.points[static_cast<std::size_t>(s.facets[facet * dim + k]) * dim + d] - x[d];
  if (dim == 2)
    return std::atan2(r[0][0] * r[1][1] - r[0][1] * r[1][0], r[0][0] * r[1][0] + r[0][1] * r[1][1]) /
           (2 * std::numbers::pi);
  // van Oosterom and Strackee, 1983.
  const auto dot = [](const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const Vector &a = r[0], &b = r[1], &c = r[2];
  const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
  const double volume = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                        a[2] * (b[0] * c[1] - b[1] * c[0]);
  return std::atan2(volume, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb) /
         (2 * std::numbers::pi);
}

/// Whether the body is what lies around the surface: its normals point inwards then.
bool surrounds(const Surface& s) {
  double volume = 0;
  for (int f = 0; f < s.facet_count(); ++f) {
    Vector p[3]{};
    for (int k = 0; k < s.dimension; ++k)
      for (int d = 0; d < s.dimension; ++d)
        p[k][d] = s.points[static_cast<std::size_t>(s.facets[f * s.dimension + k]) * s.dimension + d];
    volume += s.dimension == 2 ? p[0][0] * p[1][1] - p[0][1] * p[1][0]
                               : p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
                                     p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
                                     p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
  }
  return volume < 0;
}

struct Box {
  Vector least, most;
  explicit Box(const Surface& s) {
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < s.points.size(); ++k) {
      const std::size_t d = k % s.dimension;
      least[d] = std::min(least[d], s.points[k]);
      most[d] = std::max(most[d], s.points[k]);
    }
  }
};

/// Whether a body that a closed surface bounds, or surrounds, is at a point in the box around the surface.
class Inside {
 public:
  explicit Inside(const Surface& surface) : s_(surface), box_(surface), around_(surrounds(surface)) {
    for (int d = 0; d < s_.dimension; ++d) size_ = std::max(size_, box_.most[d] - box_.least[d]);
  }
  bool operator()(const double* x) const {
    // What touches does not overlap.
    for (int d = 0; d < s_.dimension; ++d)
      if (x[d] <= box_.least[d] + 1e-9 * size_ || x[d] >= box_.most[d] - 1e-9 * size_) return false;
    double view = 0;
    for (int f = 0; f < s_.facet_count(); ++f) view += part_of_view(s_, f, x);
    return around_ ? std::abs(view) < 0.25 : view > 0.75;
  }

 private:
  const Surface& s_;
  Box box_;
  bool around_;
  double size_ = 0;
};

std::optional<std::vector<double>> vertex_within(const Surface& a, const Surface& b) {
  const Inside inside(b);
  for (int v = 0; v < a.point_count(); ++v) {
    const double* x = &a.points[static_cast<std::size_t>(v) * a.dimension];
    if (inside(x)) return std::vector<double>(x, x + a.dimension);
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<double>> vertex_inside(const Surface& a, const Surface& b) {
  if (!a.closed || !b.closed) return std::nullopt;
  if (auto found = vertex_within(a, b)) return found;
  return vertex_within(b, a);
}

bool is_inside(const Surface& surface, const double* x) { return surface.closed && Inside(surface)(x); }

}  // namespace seam
