// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <type_traits>

#include "body_pull.hpp"

/// Contact without friction by Nitsche's method, from one body's side: the traction on its surface is
/// t n with the outward normal n and
///
///   t = min(0, S),  S = omega sigma + (1 - omega) sigma' + gamma g,
///
/// where sigma, sigma' are the normal Cauchy stresses of the body and, opposite to it, of the other one, and
/// g is the gap: thesis (6.15) without fluid, (6.22). On the current surface of the body the weak form is
/// -<du, t n>: the other body gets its own when its surface looks back, thesis (6.13). Or it is
/// -s <du - du', t n>, du' at the points opposite: then what one body gets the other one loses, to the last
/// digit. s = 1/2 makes one half of two looks (Chouly, Mlika and Renard), s = 1 the only one. A rigid body is
/// like a second one that gives no stress.
namespace seam::fsci {

using OwnDisplacement = Vector<0>;
using OtherDisplacement = Vector<1>;

/// min(0, S): bodies only press.
template <class T>
T pressing(const T& trial) {
  return plain(trial) < 0 ? trial : T(0.0);
}

/// Two bodies, or one and an obstacle (then Whose::own).
template <int sides>
struct Bodies {
  using Reads = std::conditional_t<sides == 2, Slots<Gradient<OwnDisplacement>, Gradient<OtherDisplacement>>,
                                   Slots<Gradient<OwnDisplacement>>>;
  BodyPull pull;

  /// Of each side's displacement.
  template <int dim, class T>
  using Gradients = std::array<Mat<dim, dim, T>, sides>;

  template <int dim, class T, class G>
  [[nodiscard]] T trial(const Point<dim, G>& x, const Gradients<dim, T>& gradients) const {
    return pull.operator()<dim, T, G>(x, x.normal, gradients[0], gradients[sides - 1]);
  }
};

template <class... A, class... B>
Slots<A..., B...> join(Slots<A...>, Slots<B...>);

/// How one surface is held off the other: -s <du - du', t n>, and with an adjoint term
///
///   -xi s <D(omega sigma + (1 - omega) sigma')[du, du'], (t - omega sigma - (1 - omega) sigma') / gamma>,
///
/// where D leaves normals as they are. With xi = -1 and s = 1 over both looks these are the variation of an
/// energy, which is why the scheme with theta = 1/2 keeps energy then. It acts wherever there is an opposite
/// point, touching or not.
///
/// With `hybrid`, something else stands for t at the end of a step of the scheme with theta < 1, which takes
/// theta of it and 1 - theta of t_0 = min(0, S_0) at the start. Where bodies part during the step, theta S +
/// (1 - theta) t_0 is cut off at 0, not S by itself: what the penalty has stored until then is not given back
/// twice. This is the hybrid scheme of Chouly, Hild and Renard, A Nitsche finite element method for dynamic
/// contact, part 2, ESAIM: M2AN 49 (2015), there for theta = 1/2; t_0 is that of this step's normals.
template <int sides, bool hybrid, bool with_adjoint>
struct Contact {
  using Gradients = typename Bodies<sides>::Reads;
  using Values = std::conditional_t<sides == 2, Slots<Value<OwnDisplacement>, Value<OtherDisplacement>>,
                                    Slots<Value<OwnDisplacement>>>;
  using Starts = std::conditional_t<sides == 2,
                                    Slots<OldValue<OwnDisplacement>, OldGradient<OwnDisplacement>,
                                          OldValue<OtherDisplacement>, OldGradient<OtherDisplacement>>,
                                    Slots<OldValue<OwnDisplacement>, OldGradient<OwnDisplacement>>>;
  using Reads = std::conditional_t<hybrid, decltype(join(join(Gradients{}, Values{}), Starts{})), Gradients>;
  using Tests = std::conditional_t<with_adjoint, decltype(join(Values{}, Gradients{})), Values>;
  static constexpr int movers = sides;
  static constexpr bool fresh_rates = hybrid;
  Bodies<sides> bodies;
  double on_own;       ///< s: part of t that the body gets
  double on_other;     ///< part of -t that the other one gets
  double adjoint = 0;  ///< xi: +1 skew-symmetric, -1 symmetric

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const OwnDisplacement own;
    const OtherDisplacement other;
    std::array<Mat<dim, dim, T>, sides> gradients;
    gradients[0] = s.gradient(own);
    if constexpr (sides == 2) gradients[1] = s.gradient(other);
    const T trial = bodies.template trial<dim, T, G>(x, gradients);
    T t = pressing(trial);
    if constexpr (hybrid) {
      // At an instant there is no step to take means over.
      if (x.step > 0) t = lesser(trial, limit(x, s));
    }
    r.value(own) -= (on_own * t) * x.normal;
    if constexpr (sides == 2) r.value(other) += (on_other * t) * x.normal;
    if constexpr (with_adjoint) {
      const BodyPull& pull = bodies.pull;
      const double omega = pull.weight(x), stiffness = pull.stiffness(x);
      const T missing = (-adjoint / stiffness) * (t - trial + T(stiffness * x.gap));
      if (on_own * omega > 0)
        r.gradient(own) +=
            (on_own * omega) * (missing * variation<dim, T, G>(*pull.own, gradients[0], x.normal));
      if constexpr (sides == 2)
        if (on_other * (1 - omega) > 0)
          r.gradient(other) += (on_other * (1 - omega)) *
                               (missing * variation<dim, T, G>(*pull.other, gradients[1], x.normal));
    }
  }

 private:
  template <class T>
  static T lesser(const T& a, const T& b) {
    return plain(a) < plain(b) ? a : b;
  }
  /// What S may rise to without the mean traction's pulling.
  template <int dim, class T, class G>
  [[nodiscard]] T limit(const Point<dim, G>& x, const Trial<dim, T, Reads>& s) const {
    const OwnDisplacement own;
    const OtherDisplacement other;
    std::array<Mat<dim, dim, T>, sides> gradients;
    gradients[0] = s.old_gradient(own);
    Vec<dim, T> motion = s.value(own) - s.old_value(own);
    if constexpr (sides == 2) {
      gradients[1] = s.old_gradient(other);
      motion -= s.value(other) - s.old_value(other);
    }
    Point<dim, T> start;
    for (int i = 0; i < dim; ++i) start.normal[i] = x.normal[i];
    start.gap = x.gap + dot(motion, start.normal);
    start.constant = x.constant;
    return (-(1 - x.theta) / x.theta) * pressing(bodies.template trial<dim, T, T>(start, gradients));
  }
  /// The derivative of n . sigma n with respect to the gradient: one more level of differentiation.
  template <int dim, class T, class G>
  static Mat<dim, dim, T> variation(const Law& law, const Mat<dim, dim, T>& gradient,
                                    const Vec<dim, G>& normal) {
    using S = Fad<dim * dim, T>;
    Mat<dim, dim, S> varied;
    for (int k = 0; k < dim * dim; ++k) varied.c[k] = S(gradient.c[k], k);
    const Vec<dim, S> traction = body_traction<dim, S>(law, varied, normal);
    Mat<dim, dim, T> result;
    for (int i = 0; i < dim; ++i)
      for (int k = 0; k < dim * dim; ++k) result.c[k] += normal[i] * traction[i].d[k];
    return result;
  }
};

/// A number at a point of contact.
template <int sides>
struct ContactState {
  using Reads = typename Bodies<sides>::Reads;
  enum class Number {
    gap,      ///< m
    overlap,  ///< m, negative
    touches,  ///< 1 or 0
    pressure  ///< -t, Pa
  };
  static constexpr int values(int) { return 1; }
  Bodies<sides> bodies;
  Number number;

  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    std::array<Mat<dim, dim, double>, sides> gradients;
    gradients[0] = s.gradient(OwnDisplacement{});
    if constexpr (sides == 2) gradients[1] = s.gradient(OtherDisplacement{});
    const double trial = bodies.template trial<dim, double, double>(x, gradients);
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
