// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "cut/cut_test.hpp"

/// What bodies leave of a cell, in any arithmetic: exact with rational numbers. Nothing of it is shared with
/// what it tests: simplices are bisected, nothing is linked, ordered or rounded.
namespace clipping {

template <class T>
using Position = std::array<T, 3>;

template <class T>
struct Simplex {
  std::array<Position<T>, 4> corner;  ///< 3 of them in the plane
  int sign = 1;
};

template <class T>
Position<T> position(const double* x, int dim) {
  Position<T> p{T(0), T(0), T(0)};
  for (int i = 0; i < dim; ++i) p[i] = T(x[i]);
  return p;
}

template <class T>
T area(const Position<T>& a, const Position<T>& b, const Position<T>& c) {
  return T((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

template <class T>
Position<T> normal(const Position<T>& a, const Position<T>& b, const Position<T>& c) {
  Position<T> n;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    n[i] = T((b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]));
  }
  return n;
}

template <class T>
T height(const Position<T>& n, const Position<T>& a, const Position<T>& p) {
  return T(n[0] * (p[0] - a[0]) + n[1] * (p[1] - a[1]) + n[2] * (p[2] - a[2]));
}

/// @return not negative
template <class T>
T size(const Simplex<T>& s, int dim) {
  T value = dim == 2
                ? T(area(s.corner[0], s.corner[1], s.corner[2]) / T(2))
                : T(height(normal(s.corner[0], s.corner[1], s.corner[2]), s.corner[0], s.corner[3]) / T(6));
  return value < T(0) ? T(-value) : value;
}

/// Appends the parts of a simplex where a linear function is not positive. @param value at its corners
template <class T>
void keep_below(const Simplex<T>& s, const std::array<T, 4>& value, int dim, std::vector<Simplex<T>>& parts) {
  for (int i = 0; i <= dim; ++i)
    for (int j = i + 1; j <= dim; ++j) {
      const bool up = value[i] < T(0) && value[j] > T(0), down = value[i] > T(0) && value[j] < T(0);
      if (!up && !down) continue;
      const T share = T(value[i] / (value[i] - value[j]));
      Position<T> middle{T(0), T(0), T(0)};
      for (int k = 0; k < dim; ++k) middle[k] = T(s.corner[i][k] + share * (s.corner[j][k] - s.corner[i][k]));
      for (const int end : {i, j}) {
        Simplex<T> part = s;
        std::array<T, 4> of_part = value;
        part.corner[end] = middle;
        of_part[end] = T(0);
        keep_below(part, of_part, dim, parts);
      }
      return;
    }
  for (int i = 0; i <= dim; ++i)
    if (value[i] > T(0)) return;
  parts.push_back(s);
}

template <class T, class Function>
std::vector<Simplex<T>> below(const std::vector<Simplex<T>>& parts, int dim, const Function& function) {
  std::vector<Simplex<T>> result;
  for (const Simplex<T>& s : parts) {
    std::array<T, 4> value{T(0), T(0), T(0), T(0)};
    for (int i = 0; i <= dim; ++i) value[i] = function(s.corner[i]);
    keep_below(s, value, dim, result);
  }
  return result;
}

template <class T>
T total(const std::vector<Simplex<T>>& parts, int dim) {
  T sum(0);
  for (const Simplex<T>& s : parts) {
    const T own = size(s, dim);
    sum = s.sign > 0 ? T(sum + own) : T(sum - own);
  }
  return sum;
}

/// A body's facets: corners, and whether the last coordinate's direction leads out (+1) or into the body.
template <class T>
struct Facet {
  std::array<Position<T>, 3> corner;
  std::array<double, 3> low, high;
};

template <class T>
std::vector<Facet<T>> facets(const seam::Surface& surface) {
  const int dim = surface.dimension;
  std::vector<Facet<T>> result;
  for (int f = 0; f < surface.facet_count(); ++f) {
    Facet<T>& facet = result.emplace_back();
    facet.low.fill(1e300);
    facet.high.fill(-1e300);
    for (int k = 0; k < dim; ++k) {
      const double* x = &surface.points[static_cast<std::size_t>(surface.facets[f * dim + k]) * dim];
      facet.corner[k] = position<T>(x, dim);
      for (int i = 0; i < dim; ++i) {
        facet.low[i] = std::min(facet.low[i], x[i]);
        facet.high[i] = std::max(facet.high[i], x[i]);
      }
    }
  }
  return result;
}

/// What lies below a facet (against the last coordinate) in some simplices.
template <class T>
std::vector<Simplex<T>> column(const std::vector<Simplex<T>>& parts, int dim, const Facet<T>& facet,
                               int side) {
  const Position<T>&a = facet.corner[0], &b = facet.corner[1], &c = facet.corner[2];
  const auto signed_by = [side](const T& x) { return side > 0 ? x : T(-x); };
  if (dim == 2) {
    auto result = below<T>(parts, 2, [&](const auto& p) { return T((p[0] - a[0]) * T(side > 0 ? -1 : 1)); });
    result = below<T>(result, 2, [&](const auto& p) { return T((p[0] - b[0]) * T(side > 0 ? 1 : -1)); });
    return below<T>(result, 2, [&](const auto& p) { return signed_by(area(a, b, p)); });
  }
  auto result = parts;
  for (const auto& [p0, p1] : {std::pair(&a, &b), std::pair(&b, &c), std::pair(&c, &a)})
    result = below<T>(result, 3,
                      [&, p0 = p0, p1 = p1](const auto& p) { return signed_by(T(-area(*p0, *p1, p))); });
  const Position<T> n = normal(a, b, c);
  return below<T>(result, 3, [&](const auto& p) { return signed_by(height(n, a, p)); });
}

/// Size of the part of some simplices that a body covers.
/// @param low, high box around the simplices
template <class T>
T covered(const std::vector<Simplex<T>>& parts, int dim, const std::vector<Facet<T>>& body,
          const std::array<double, 3>& low, const std::array<double, 3>& high) {
  T sum(0);
  const int last = dim - 1;
  for (const Facet<T>& f : body) {
    bool apart = f.high[last] <= low[last];  // all is above it
    for (int i = 0; i < last; ++i) apart = apart || f.high[i] <= low[i] || f.low[i] >= high[i];
    if (apart) continue;
    // In the plane the body is on the left: above a facet that runs to the right.
    const T turn =
        dim == 2 ? T(f.corner[1][0] - f.corner[0][0]) : area(f.corner[0], f.corner[1], f.corner[2]);
    if (turn == T(0)) continue;
    const bool right = turn > T(0);
    const T part = total(column(parts, dim, f, right ? 1 : -1), dim);
    // What is below the top counts, less what is below the bottom.
    const bool is_top = dim == 2 ? !right : right;
    sum = is_top ? T(sum + part) : T(sum - part);
  }
  return sum;
}

/// The part of some simplices in a convex body.
template <class T>
std::vector<Simplex<T>> within(std::vector<Simplex<T>> parts, int dim, const std::vector<Facet<T>>& body) {
  for (const Facet<T>& f : body) {
    if (dim == 2) {
      parts = below<T>(parts, 2, [&](const auto& p) { return T(-area(f.corner[0], f.corner[1], p)); });
    } else {
      const Position<T> n = normal(f.corner[0], f.corner[1], f.corner[2]);
      parts = below<T>(parts, 3, [&](const auto& p) { return height(n, f.corner[0], p); });
    }
  }
  return parts;
}

}  // namespace clipping
