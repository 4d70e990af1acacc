// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "solid_sided.hpp"

namespace seam::fsci {

/// n . sigma n.
template <int dim, class T, class G>
T normal_stress(const Law& law, const Mat<dim, dim, T>& gradient, const Vec<dim, G>& normal) {
  return dot(normal, body_traction<dim, T>(law, gradient, normal));
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
  template <int dim, class T, class G>
  [[nodiscard]] T operator()(const Point<dim, G>& x, const Vec<dim, G>& normal,
                             const Mat<dim, dim, T>& own_gradient,
                             const Mat<dim, dim, T>& other_gradient) const {
    const double omega = weight(x);
    T pull = T(stiffness(x) * x.gap);
    if (omega > 0 && own) pull += omega * normal_stress<dim, T>(*own, own_gradient, normal);
    if (omega < 1 && other) pull += (1 - omega) * normal_stress<dim, T>(*other, other_gradient, normal);
    return pull;
  }
};

}  // namespace seam::fsci
