// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "seam/physics/taylor.hpp"
#include "seam/term/tensor.hpp"

namespace seam {

/// Numbers that follow from the state of a body at a point: what a physics makes known of itself under a name
/// (FieldSetup::publish), so that a coupling can use it without knowing the physics. Names in use:
///   "stress": the first Piola-Kirchhoff stress, Pa, [dimension][dimension], of the displacement gradient,
///             [dimension][dimension], the derivative's direction runs fastest;
///   "mixture":  the same of skeleton and fluid in its pores, of the gradient and, last, the pore pressure,
///   Pa; "skeleton": the same of the skeleton alone, as "stress" is; "pores":  porosity and a third of the
///   trace of the spatial permeability, m^2, of the displacement
///             gradient and, last, the pore pressure, Pa.
class Law {
 public:
  virtual ~Law() = default;
  /// @param x [n] @param value [m]
  /// @param first derivatives, [m][n]; null when not wanted
  /// @param second derivatives, [m][n][n]; null when not wanted
  virtual void evaluate(int dimension, const double* x, double* value, double* first,
                        double* second) const = 0;
};

/// The m numbers of a law, of arguments of any scalar type, nested twice at most, with exact derivatives.
template <int m, int n, class T>
std::array<T, m> evaluate(const Law& law, int dimension, const std::array<T, n>& x) {
  constexpr int depth = derivative_depth<T>;
  static_assert(depth <= 2, "a law has first and second derivatives");
  double at[n], value[m], first[depth > 0 ? m * n : 1], second[depth > 1 ? m * n * n : 1];
  for (int i = 0; i < n; ++i) at[i] = plain(x[i]);
  law.evaluate(dimension, at, value, depth > 0 ? first : nullptr, depth > 1 ? second : nullptr);
  std::array<T, m> result;
  for (int i = 0; i < m; ++i)
    result[i] =
        taylor<n, T>(x, at, value[i], first + i * n * (depth > 0), second + i * n * n * (depth > 1), nullptr);
  return result;
}

/// Makes a Law of one that is written once, as a template on dimension and scalar type:
///
///   struct Formula {
///     static constexpr int arguments(int dim); static constexpr int values(int dim);
///     template <int dim, class T>
///     std::array<T, values(dim)> at(const std::array<T, arguments(dim)>& x) const;
///   };
template <class Formula>
class LawOf : public Law {
 public:
  explicit LawOf(Formula formula) : formula_(std::move(formula)) {}
  void evaluate(int dimension, const double* x, double* value, double* first, double* second) const override {
    if (dimension == 2)
      evaluate_in<2>(x, value, first, second);
    else
      evaluate_in<3>(x, value, first, second);
  }

 private:
  template <int dim>
  void evaluate_in(const double* x, double* value, double* first, double* second) const {
    constexpr int n = Formula::arguments(dim), m = Formula::values(dim);
    using Once = Fad<n>;
    using Twice = Fad<n, Once>;
    if (!first) {
      std::array<double, n> input;
      std::copy_n(x, n, input.begin());
      const std::array<double, m> result = formula_.template at<dim, double>(input);
      std::copy_n(result.begin(), m, value);
    } else if (!second) {
      std::array<Once, n> input;
      for (int i = 0; i < n; ++i) input[i] = Once(x[i], i);
      const std::array<Once, m> result = formula_.template at<dim, Once>(input);
      for (int i = 0; i < m; ++i) {
        value[i] = result[i].v;
        std::copy_n(result[i].d, n, first + i * n);
      }
    } else {
      std::array<Twice, n> input;
      for (int i = 0; i < n; ++i) input[i] = Twice(Once(x[i], i), i);
      const std::array<Twice, m> result = formula_.template at<dim, Twice>(input);
      for (int i = 0; i < m; ++i) {
        value[i] = result[i].v.v;
        for (int j = 0; j < n; ++j) {
          first[i * n + j] = result[i].v.d[j];
          std::copy_n(result[i].d[j].d, n, second + (i * n + j) * n);
        }
      }
    }
  }
  Formula formula_;
};

}  // namespace seam
