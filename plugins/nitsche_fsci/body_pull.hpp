// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <memory>

#include "solid_sided.hpp"

namespace seam::fsci {

/// n . sigma n.
template <int dim, class T, class G>
T normal_stress(const Law& law, const Mat<dim, dim, T>& gradient, const Vec<dim, G>& normal) {
  return dot(normal, body_traction<dim, T>(law, gradient, normal));
}

/// The same of the mixture in a porous body. @param law "mixture"
template <int dim, class T, class G>
T mixture_stress(const Law& law, const Mat<dim, dim, T>& gradient, const T& pressure,
                 const Vec<dim, G>& normal) {
  constexpr int n = dim * dim;
  std::array<T, n + 1> at;
  std::copy(gradient.c.begin(), gradient.c.end(), at.begin());
  at[n] = pressure;
  Mat<dim, dim, T> stress, f = gradient;
  stress.c = evaluate<n, n + 1, T>(law, dim, at);
  for (int i = 0; i < dim; ++i) f(i, i) += 1.0;
  return dot(normal, stress * (transpose(f) * normal)) / determinant(f);
}

/// Whose stress stands for that between two bodies.
enum class Whose { both, own, other };

/// S of two bodies. Point::constant: lambda_e of the cells on both sides, see TraceEigenvalue. With the
/// stress of both omega = lambda' / (lambda + lambda') and gamma = gamma_0 (omega lambda + (1 - omega)
/// lambda'), thesis (6.16), (6.17); else omega is 1 or 0. A rigid body has no stress; of two gamma is what
/// the scene gives.
struct BodyPull {
  std::shared_ptr<const Law> own, other;  ///< null of a rigid body
  double penalty;                         ///< gamma_0
  Whose stress = Whose::both;

  /// omega
  template <int dim, class G>
  [[nodiscard]] double weight(const Point<dim, G>& x) const {
    if (stress == Whose::both) return x.constant[1] / (x.constant[0] + x.constant[1]);
    return stress == Whose::own ? 1 : 0;
  }
  /// gamma, Pa/m
  template <int dim, class G>
  [[nodiscard]] double stiffness(const Point<dim, G>& x) const {
    const double omega = weight(x);
    return penalty * (omega * x.constant[0] + (1 - omega) * x.constant[1]);
  }
  /// @param own_pressure in the pores of the body, where it has some; then `own` is the law "mixture"
  /// @param other_pressure the same of the other body
  template <int dim, class T, class G>
  [[nodiscard]] T operator()(const Point<dim, G>& x, const Vec<dim, G>& normal,
                             const Mat<dim, dim, T>& own_gradient, const Mat<dim, dim, T>& other_gradient,
                             const T* own_pressure = nullptr, const T* other_pressure = nullptr) const {
    const auto stress_of = [&](const Law& law, const Mat<dim, dim, T>& gradient, const T* pressure) {
      return pressure ? mixture_stress<dim, T>(law, gradient, *pressure, normal)
                      : normal_stress<dim, T>(law, gradient, normal);
    };
    const double omega = weight(x);
    T pull = T(stiffness(x) * x.gap);
    if (omega > 0 && own) pull += omega * stress_of(*own, own_gradient, own_pressure);
    if (omega < 1 && other) pull += (1 - omega) * stress_of(*other, other_gradient, other_pressure);
    return pull;
  }
};

}  // namespace seam::fsci
