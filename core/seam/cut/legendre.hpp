// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

namespace seam::cutting {

/// Highest degree of a volume rule.
constexpr int max_degree = 20;

/// Legendre polynomials of degree 0..n on [0,1]; their squares integrate to 1 / (2k + 1).
inline void legendre(int n, double x, double* value) {
  const double t = 2 * x - 1;
  value[0] = 1;
  if (n > 0) value[1] = t;
  for (int k = 2; k <= n; ++k) value[k] = ((2 * k - 1) * t * value[k - 1] - (k - 1) * value[k - 2]) / k;
}

/// Their integrals from 0 to x; `value` holds those of degree 0..n+1 afterwards.
inline void legendre_integral(int n, double x, double* value, double* integral) {
  legendre(n + 1, x, value);
  integral[0] = x;
  for (int k = 1; k <= n; ++k) integral[k] = (value[k + 1] - value[k - 1]) / (2 * (2 * k + 1));
}

}  // namespace seam::cutting
