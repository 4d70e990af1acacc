// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/cut/legendre.hpp"

namespace seam::cutting {

/// Weights for the Gauss points of the unit square or cube (`degree` + 1 per direction) that reproduce given
/// moments of all products of Legendre polynomials up to `degree` in each direction. As those are orthogonal,
/// w_q = g_q sum_k P_k(x_q) M_k / |P_k|^2 with the Gauss weights g needs no system to be solved.
class FittedRule {
 public:
  /// @param dimension of the square (2), cube (3) or segment (1)
  static const FittedRule& get(int dimension, int degree);

  [[nodiscard]] int count() const { return static_cast<int>(points_.size()) / dimension_; }
  /// [point][dimension]
  [[nodiscard]] const std::vector<double>& points() const { return points_; }
  /// @param moment [k0 + n (k1 + n k2)] with n = degree + 1; overwritten
  /// @param weight [point]
  void weights(double* moment, double* weight) const;

  FittedRule(int dimension, int degree);

 private:
  int dimension_, n_;
  std::vector<double> points_;
  std::vector<double> table_;  ///< [point of a line][polynomial]: g_q P_k(x_q) / |P_k|^2
};

}  // namespace seam::cutting
