// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "seam/physics/law.hpp"

namespace seam {

/// The first Piola-Kirchhoff stress, Pa, by a law of the name "stress".
template <int dim, class T>
Mat<dim, dim, T> stress(const Law& law, const Mat<dim, dim, T>& displacement_gradient) {
  Mat<dim, dim, T> result;
  result.c = evaluate<dim * dim, dim * dim, T>(law, dim, displacement_gradient.c);
  return result;
}

/// The stiffness at rest in compression without lateral strain by such a law, Pa.
inline double stiffness_at_rest(const Law& law, int dimension) {
  const std::size_t n = static_cast<std::size_t>(dimension) * dimension;
  const std::vector<double> rest(n, 0.0);
  std::vector<double> value(n), first(n * n);
  law.evaluate(dimension, rest.data(), value.data(), first.data(), nullptr);
  return first[0];
}

/// The formula of such a law, of a material that has
///   template <int dim, class T> Mat<dim, dim, T> stress(const Mat<dim, dim, T>& displacement_gradient)
///   const;
template <class Material>
struct StressFormula {
  Material material;
  static constexpr int arguments(int dim) { return dim * dim; }
  static constexpr int values(int dim) { return dim * dim; }
  template <int dim, class T>
  [[nodiscard]] std::array<T, dim * dim> at(const std::array<T, dim * dim>& x) const {
    Mat<dim, dim, T> gradient;
    gradient.c = x;
    return material.template stress<dim, T>(gradient).c;
  }
};

template <class Material>
class LawStress final : public LawOf<StressFormula<Material>> {
 public:
  explicit LawStress(Material material)
      : LawOf<StressFormula<Material>>(StressFormula<Material>{std::move(material)}) {}
};

}  // namespace seam
