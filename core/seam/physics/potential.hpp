// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <utility>

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

 private:
  Law law_;
};

/// The potential's gradient at x, carrying derivatives if T does.
template <int n, class T>
std::array<T, n> gradient(const Potential& potential, const std::array<T, n>& x) {
  double at[n], value = 0, first[n], second[n * n];
  for (int i = 0; i < n; ++i) at[i] = plain(x[i]);
  potential.evaluate(at, value, first, second);
  std::array<T, n> result;
  for (int i = 0; i < n; ++i) {
    result[i] = T(first[i]);
    if constexpr (!std::is_same_v<T, double>)
      for (int j = 0; j < n; ++j)
        if (second[i * n + j] != 0) result[i] += second[i * n + j] * (x[j] - at[j]);
  }
  return result;
}

}  // namespace seam
