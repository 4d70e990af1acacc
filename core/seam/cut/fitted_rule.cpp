// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/fitted_rule.hpp"

#include <map>
#include <stdexcept>
#include <utility>

#include "seam/mesh/quadrature.hpp"

namespace seam::cutting {

const FittedRule& FittedRule::get(int dimension, int degree) {
  if (degree < 0 || degree > max_degree) throw std::logic_error("FittedRule: degree must be in [0, 20]");
  static std::map<std::pair<int, int>, FittedRule> rules;
  return rules.try_emplace({dimension, degree}, dimension, degree).first->second;
}

FittedRule::FittedRule(int dimension, int degree) : dimension_(dimension), n_(degree + 1) {
  const Quadrature line = gauss(n_);
  int total = 1;
  for (int d = 0; d < dimension; ++d) total *= n_;
  for (int q = 0; q < total; ++q)
    for (int d = 0, index = q; d < dimension; ++d, index /= n_) points_.push_back(line.points[index % n_]);
  std::array<double, max_degree + 2> value{};
  for (int q = 0; q < n_; ++q) {
    legendre(degree, line.points[q], value.data());
    for (int k = 0; k < n_; ++k) table_.push_back(line.weights[q] * value[k] * (2 * k + 1));
  }
}

void FittedRule::weights(double* moment, double* weight) const {
  // One direction after the other: the first index becomes that of a point and moves to the end.
  double *from = moment, *to = weight;
  const int total = count(), rest = total / n_;
  for (int d = 0; d < dimension_; ++d, std::swap(from, to))
    for (int r = 0; r < rest; ++r)
      for (int q = 0; q < n_; ++q) {
        double sum = 0;
        for (int k = 0; k < n_; ++k) sum += table_[q * n_ + k] * from[r * n_ + k];
        to[q * rest + r] = sum;
      }
  if (from != weight)
    for (int q = 0; q < total; ++q) weight[q] = from[q];
}

}  // namespace seam::cutting
