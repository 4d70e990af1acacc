// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "seam/physics/taylor.hpp"
#include "seam/term/tensor.hpp"

namespace seam {

/// How a body answers its deformation: the first Piola-Kirchhoff stress as a function of the displacement
/// gradient. What a physics makes known of itself so that a coupling can take the body's traction.
class StressLaw {
 public:
  virtual ~StressLaw() = default;
  /// @param gradient of the displacement, [dimension][dimension], the derivative's direction runs fastest
  /// @param stress Pa, [n] with n = dimension^2
  /// @param first its derivative, [n][n]; null when not wanted
  /// @param second derivative, [n][n][n]; null when not wanted
  virtual void evaluate(int dimension, const double* gradient, double* stress, double* first,
                        double* second) const = 0;
};

/// The stress at a displacement gradient of any scalar type, nested twice at most, with exact derivatives.
template <int dim, class T>
Mat<dim, dim, T> stress(const StressLaw& law, const Mat<dim, dim, T>& gradient) {
  constexpr int n = dim * dim, depth = derivative_depth<T>;
  static_assert(depth <= 2, "a stress law has first and second derivatives");
  double at[n], value[n], first[depth > 0 ? n * n : 1], second[depth > 1 ? n * n * n : 1];
  for (int i = 0; i < n; ++i) at[i] = plain(gradient.c[i]);
  law.evaluate(dim, at, value, depth > 0 ? first : nullptr, depth > 1 ? second : nullptr);
  Mat<dim, dim, T> result;
  for (int i = 0; i < n; ++i)
    result.c[i] = taylor<n, T>(gradient.c, at, value[i], first + i * n * (depth > 0),
                               second + i * n * n * (depth > 1), nullptr);
  return result;
}

/// Makes a StressLaw of a law that is written once, as a template on dimension and scalar type:
///
///   struct Law { template <int dim, class T> Mat<dim, dim, T> stress(const Mat<dim, dim, T>& gradient)
///   const; };
template <class Law>
class LawStress final : public StressLaw {
 public:
  explicit LawStress(Law law) : law_(std::move(law)) {}
  void evaluate(int dimension, const double* gradient, double* stress, double* first,
                double* second) const override {
    if (dimension == 2)
      evaluate_in<2>(gradient, stress, first, second);
    else
      evaluate_in<3>(gradient, stress, first, second);
  }

 private:
  template <int dim>
  void evaluate_in(const double* gradient, double* stress, double* first, double* second) const {
    constexpr int n = dim * dim;
    using Once = Fad<n>;
    using Twice = Fad<n, Once>;
    if (!first) {
      Mat<dim, dim, double> input;
      std::copy_n(gradient, n, input.c.begin());
      const Mat<dim, dim, double> result = law_.template stress<dim, double>(input);
      std::copy_n(result.c.begin(), n, stress);
    } else if (!second) {
      Mat<dim, dim, Once> input;
      for (int i = 0; i < n; ++i) input.c[i] = Once(gradient[i], i);
      const Mat<dim, dim, Once> result = law_.template stress<dim, Once>(input);
      for (int i = 0; i < n; ++i) {
        stress[i] = result.c[i].v;
        std::copy_n(result.c[i].d, n, first + i * n);
      }
    } else {
      Mat<dim, dim, Twice> input;
      for (int i = 0; i < n; ++i) input.c[i] = Twice(Once(gradient[i], i), i);
      const Mat<dim, dim, Twice> result = law_.template stress<dim, Twice>(input);
      for (int i = 0; i < n; ++i) {
        stress[i] = result.c[i].v.v;
        for (int j = 0; j < n; ++j) {
          first[i * n + j] = result.c[i].v.d[j];
          std::copy_n(result.c[i].d[j].d, n, second + (i * n + j) * n);
        }
      }
    }
  }
  Law law_;
};

}  // namespace seam
