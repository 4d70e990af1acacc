// SPDX-License-Identifier: BSD-3-Clause
#include "seam/base/rates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seam {
namespace {

constexpr int points = 7;

struct Rates {
  std::array<double, 2> value{}, error{};
};

/// That of the polynomial through values that lie a length apart. The error is seen from what the two
/// farthest ones add: one alone may add nothing by chance.
Rates differences(const std::array<double, points>& values, double length) {
  // Newton's backward differences: D = sum of difference_k / k, D^2 = sum of factor_k difference_k.
  constexpr std::array<double, points> second{0, 0, 1, 1, 11.0 / 12, 5.0 / 6, 137.0 / 180};
  std::array<double, points> difference = values;
  Rates rates;
  double size = 0;
  for (const double value : values) size = std::max(size, std::abs(value));
  for (int k = 1; k < points; ++k) {
    for (int i = 0; i + k < points; ++i) difference[i] -= difference[i + 1];
    const double terms[2] = {difference[0] / k / length, second[k] * difference[0] / length / length};
    for (int order = 0; order < 2; ++order) {
      rates.value[order] += terms[order];
      rates.error[order] =
          k + 1 < points ? std::abs(terms[order]) : std::max(rates.error[order], std::abs(terms[order]));
    }
  }
  const double rounding = 32 * std::numeric_limits<double>::epsilon() * size;
  rates.error[0] += rounding / std::abs(length);
  rates.error[1] += rounding / length / length;
  return rates;
}

}  // namespace

std::array<double, 2> rates_of(const std::function<double(double)>& function, double time) {
  constexpr int lengths = 40;
  Rates best;
  best.value.fill(std::numeric_limits<double>::quiet_NaN());
  best.error.fill(std::numeric_limits<double>::infinity());
  for (const double side : {1.0, -1.0}) {
    // Some number that periods of functions in scenes are no multiples of.
    double length = side * 0.1127 * std::max(1.0, std::abs(time));
    for (int k = 0; k < lengths; ++k, length /= 2) {
      std::array<double, points> values{};
      for (int i = 0; i < points; ++i) values[i] = function(time - i * length);
      const Rates rates = differences(values, length);
      for (int order = 0; order < 2; ++order)
        if (rates.error[order] < best.error[order]) {
          best.value[order] = rates.value[order];
          best.error[order] = rates.error[order];
        }
    }
    if (std::isfinite(best.value[0]) && std::isfinite(best.value[1])) break;
  }
  return best.value;
}

}  // namespace seam
