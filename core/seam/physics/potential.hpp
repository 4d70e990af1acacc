// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <utility>

#include "seam/physics/taylor.hpp"
#include "seam/term/fad.hpp"

namespace seam {

/// A scalar function of up to six arguments with its first and second derivatives: a stored energy, say. What
/// the arguments are is the convention of the kind it is registered under.
class Potential {
 public:
  virtual ~Potential() = default;
  [[nodiscard]] virtual int arguments() const = 0;
  /// @param gradient [arguments]
  /// @param hessian [arguments][arguments]
  virtual void evaluate(const double* x, double& value, double* gradient, double* hessian) const = 0;
  /// For couplings that differentiate the tangent of a stress. @param third [arguments]^3
  virtual void third_derivative(const double* x, double* third) const = 0;
};

/// Makes a Potential of a law that is written once, as a template on the scalar type:
///
///   struct Spring { double k; template <class T> T energy(const std::array<T, 1>& x) const { return
///   0.5*k*x[0]*x[0]; } };
///
/// Derivatives come from nested automatic differentiation.
template <int n, class Law>
class LawPotential final : public Potential {
 public:
  explicit LawPotential(Law law) : law_(std::move(law)) {}
  [[nodiscard]] int arguments() const override { return n; }
  void evaluate(const double* x, double& value, double* gradient, double* hessian) const override {
    using Inner = Fad<n>;
    using Outer = Fad<n, Inner>;
    std::array<Outer, n> input;
    for (int i = 0; i < n; ++i) input[i] = Outer(Inner(x[i], i), i);
    const Outer result = law_.template energy<Outer>(input);
    value = result.v.v;
    for (int i = 0; i < n; ++i) {
      gradient[i] = result.v.d[i];
      for (int j = 0; j < n; ++j) hessian[i * n + j] = result.d[i].d[j];
    }
  }

  void third_derivative(const double* x, double* third) const override {
    using One = Fad<n>;
    using Two = Fad<n, One>;
    using Three = Fad<n, Two>;
    std::array<Three, n> input;
    for (int i = 0; i < n; ++i) input[i] = Three(Two(One(x[i], i), i), i);
    const Three result = law_.template energy<Three>(input);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k) third[(i * n + j) * n + k] = result.d[i].d[j].d[k];
  }

 private:
  Law law_;
};

/// The potential's gradient at x, carrying derivatives if T does, nested twice at most.
template <int n, class T>
std::array<T, n> gradient(const Potential& potential, const std::array<T, n>& x) {
  constexpr int depth = derivative_depth<T>;
  static_assert(depth <= 2, "a potential has derivatives up to the third");
  double at[n], value = 0, first[n], second[n * n], third[depth > 1 ? n * n * n : 1];
  for (int i = 0; i < n; ++i) at[i] = plain(x[i]);
  potential.evaluate(at, value, first, second);
  if constexpr (depth > 1) potential.third_derivative(at, third);
  std::array<T, n> result;
  for (int i = 0; i < n; ++i)
    result[i] = taylor<n, T>(x, at, first[i], second + i * n, third + i * n * n * (depth > 1), nullptr);
  return result;
}

}  // namespace seam
