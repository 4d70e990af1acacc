// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace seam {

/// Steps to try, relative to the scale on which f changes; the best one counts. With the right one,
/// truncation and rounding are both some 1e-12 relative; a nearly incompressible body changes on a much
/// shorter scale than its cells, and its large modulus makes the rounding of its small stresses visible.
inline constexpr double difference_steps[] = {1e-3, 1e-2, 1e-4, 1e-5, 1e-6};

/// Derivative of f(s), a vector, at s = 0 by central differences of fourth order.
template <class Function>
std::vector<double> central_difference(Function&& f, double step) {
  const std::vector<double> p1 = f(step), m1 = f(-step), p2 = f(2 * step), m2 = f(-2 * step);
  std::vector<double> result(p1.size());
  for (std::size_t i = 0; i < p1.size(); ++i)
    result[i] = (8 * (p1[i] - m1[i]) - (p2[i] - m2[i])) / (12 * step);
  return result;
}

/// The larger of two errors; a NaN, which would lose every comparison, is the largest.
inline double worse(double a, double b) {
  return std::isnan(b) ? std::numeric_limits<double>::infinity() : std::max(a, b);
}

/// Largest relative error that a tangent may have against finite differences.
inline constexpr double tangent_tolerance = 1e-6;

}  // namespace seam
