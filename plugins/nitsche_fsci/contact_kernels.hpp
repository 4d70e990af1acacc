// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "solid_sided.hpp"

/// Contact without friction by Nitsche's method, from one body's side: the traction on its surface is
/// t n with the outward normal n and
///
///   t = min(0, S),  S = omega sigma + (1 - omega) sigma' + gamma g,
///
/// where sigma, sigma' are the normal Cauchy stresses of the body and, opposite to it, of the other one, and
/// g is the gap: thesis (6.15) without fluid, (6.22). On the current surface of the body the weak form is
/// -<du, t n>: the other body gets its own when its surface looks back, thesis (6.13). Or it is
/// -s <du - du', t n>, du' at the points opposite: then what one body gets the other one loses, to the last
/// digit. s = 1/2 makes one half of two looks (Chouly, Mlika and Renard), s = 1 the only one.
namespace seam::fsci {

using OwnDisplacement = Vector<0>;
using OtherDisplacement = Vector<1>;

/// n . sigma n.
template <int dim, class T, class G>
T normal_stress(const Law& law, const Mat<dim, dim, T>& gradient, const Vec<dim, G>& normal) {
  return dot(normal, body_traction<dim, T>(law, gradient, normal));
}

/// Whose stress stands for that between two bodies.
enum class Whose { both, own, other };

/// S of two bodies. Point::constant: lambda_e of the cells on both sides, see TraceEigenvalue. With the
/// stress of both omega = lambda' / (lambda + lambda') and gamma = gamma_0 (omega lambda + (1 - omega)
/// lambda'), thesis (6.16), (6.17); else omega is 1 or 0.
struct BodyPull {
  std::shared_ptr<const Law> own, other;
  double penalty;  ///< gamma_0
  Whose stress = Whose::both;

  template <int dim, class T, class G>
  [[nodiscard]] T operator()(const Point<dim, G>& x, const Vec<dim, G>& normal,
                             const Mat<dim, dim, T>& own_gradient,
                             const Mat<dim, dim, T>& other_gradient) const {
    const double weight = stress == Whose::both ? x.constant[1] / (x.constant[0] + x.constant[1])
                                                : (stress == Whose::own ? 1.0 : 0.0);
    const double gamma = penalty * (weight * x.constant[0] + (1 - weight) * x.constant[1]);
    T pull = T(gamma * x.gap);
    if (weight > 0) pull += weight * normal_stress<dim, T>(*own, own_gradient, normal);
    if (weight < 1) pull += (1 - weight) * normal_stress<dim, T>(*other, other_gradient, normal);
    return pull;
  }
};

/// t, or more than 0 where nothing touches.
struct TwoBodies {
  using Reads = Slots<Gradient<OwnDisplacement>, Gradient<OtherDisplacement>>;
  BodyPull pull;

  template <int dim, class T, class G>
  [[nodiscard]] T trial(const Point<dim, G>& x, const Trial<dim, T, Reads>& s) const {
    return pull.operator()<dim, T, G>(x, x.normal, s.gradient(OwnDisplacement{}),
                                      s.gradient(OtherDisplacement{}));
  }
};

/// The same against a rigid body: the stress is the deforming one's.
struct OneBody {
  using Reads = Slots<Gradient<OwnDisplacement>>;
  std::shared_ptr<const Law> own;
  double penalty;  ///< gamma_0

  template <int dim, class T, class G>
  [[nodiscard]] T trial(const Point<dim, G>& x, const Trial<dim, T, Reads>& s) const {
    return normal_stress<dim, T>(*own, s.gradient(OwnDisplacement{}), x.normal) +
           penalty * x.constant[0] * x.gap;
  }
};

struct ContactOfTwo {
  using Reads = TwoBodies::Reads;
  using Tests = Slots<Value<OwnDisplacement>, Value<OtherDisplacement>>;
  static constexpr int movers = 2;
  TwoBodies bodies;
  double on_own;    ///< part of t that the body gets
  double on_other;  ///< part of -t that the other one gets

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const T trial = bodies.trial<dim, T, G>(x, s);
    if (plain(trial) >= 0) return;
    r.value(OwnDisplacement{}) -= (on_own * trial) * x.normal;
    r.value(OtherDisplacement{}) += (on_other * trial) * x.normal;
  }
};

struct ContactOfOne {
  using Reads = OneBody::Reads;
  using Tests = Slots<Value<OwnDisplacement>>;
  OneBody bodies;

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const T trial = bodies.trial<dim, T, G>(x, s);
    if (plain(trial) < 0) r.value(OwnDisplacement{}) -= trial * x.normal;
  }
};

/// A number at a point of contact.
template <class Bodies>
struct ContactState {
  using Reads = typename Bodies::Reads;
  enum class Number {
    gap,      ///< m
    overlap,  ///< m, negative
    touches,  ///< 1 or 0
    pressure  ///< -t, Pa
  };
  static constexpr int values(int) { return 1; }
  Bodies bodies;
  Number number;

  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    const double trial = bodies.template trial<dim, double, double>(x, s);
    switch (number) {
      case Number::gap:
        *value = x.gap;
        break;
      case Number::overlap:
        *value = std::min(x.gap, 0.0);
        break;
      case Number::touches:
        *value = trial < 0 ? 1 : 0;
        break;
      case Number::pressure:
        *value = std::max(-trial, 0.0);
    }
  }
};

}  // namespace seam::fsci
