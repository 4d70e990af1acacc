// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "seam/term/fad.hpp"

namespace seam {

/// Carries derivatives through a function that is known by numbers: its Taylor polynomial about `at`, the
/// plain value of x. As x - at has no value but derivatives only, all derivatives that T holds are exact.
/// @param first [n], second [n][n], third [n][n][n]: those up to the depth of T are read
template <int n, class T>
T taylor(const std::array<T, n>& x, const double* at, double value, const double* first, const double* second,
         const double* third) {
  constexpr int depth = derivative_depth<T>;
  T result(value);
  if constexpr (depth > 0) {
    std::array<T, n> step;
    for (int i = 0; i < n; ++i) step[i] = x[i] - at[i];
    for (int i = 0; i < n; ++i) {
      if (first[i] != 0) result += first[i] * step[i];
      if constexpr (depth > 1)
        for (int j = 0; j < n; ++j) {
          if (second[i * n + j] != 0) result += (0.5 * second[i * n + j]) * (step[i] * step[j]);
          if constexpr (depth > 2)
            for (int k = 0; k < n; ++k)
              if (const double c = third[(i * n + j) * n + k]; c != 0)
                result += (c / 6) * (step[i] * step[j] * step[k]);
        }
    }
  }
  return result;
}

}  // namespace seam
