// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scales.hpp"

namespace seam::fluid {

/// Given velocity with Navier slip, imposed weakly by Nitsche's method (thesis (3.26), (3.27), (4.5) for a
/// given boundary velocity g):
///
///   (v - g).n = 0,   P [ v - g + slip_length/mu (sigma n - h) ] = 0,   P = I - n n^T,
///
/// n out of the fluid. slip_length 0 is no slip; infinite, the tangential traction is P h. With the
/// resistance Phi = h_Gamma phi of (3.27), lambda = slip_length/mu and beta = h_Gamma/(gamma_t Phi), the
/// terms are
///
///   -<dv, sigma n> - <dp, c_n> + gamma_n Phi/h_Gamma <dv.n, c_n> + xi <n . 2 mu eps(dv) n, c_n>
///   + <P dv, t> + xi beta <P 2 mu eps(dv) n, t>,
///   c_n = (v - g).n,   t = [P (v - g) + lambda P (sigma n - h)] / (lambda + beta).
///
/// At xi = +1 the sum with dv = v, g = h = 0 is gamma_n Phi/h_Gamma |v.n|^2 + (|P v|^2 + beta lambda |P sigma
/// n|^2)/(lambda + beta): stable for every penalty and slip length. No term of its own for inflow: the
/// convective part of Phi outweighs it (gamma c_v > 1/2), and a wall with slip has no flow relative to it.
struct WeakVelocity {
  using Reads = Slots<Value<Velocity>, Gradient<Velocity>, Value<Pressure>>;
  using Tests = Slots<Value<Velocity>, Gradient<Velocity>, Value<Pressure>>;
  Flow flow;
  std::vector<Expression> velocity;  ///< g, m/s
  std::vector<Expression> traction;  ///< h, Pa; empty for none
  double slip_length;                ///< m, may be infinite
  double adjoint;                    ///< xi: +1 skew-symmetric, -1 symmetric, 0 none
  double normal_penalty, tangential_penalty;

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Vec<dim, G>& n = x.normal;
    const double h = x.trace_size;
    const Vec<dim, T> fluid_velocity = s.value(Velocity{});
    const T phi = resistance<dim, T>(flow, h, x, fluid_velocity);
    const Vec<dim, T> slip = fluid_velocity - evaluate_at<dim>(velocity, x.position, x);
    const Vec<dim, T> force = stress<dim, T>(flow.viscosity, s.gradient(Velocity{}), s.value(Pressure{})) * n;
    Vec<dim, T> friction = force;
    if (!traction.empty()) friction -= evaluate_at<dim>(traction, x.position, x);

    // 1 - beta/(lambda + beta) instead of lambda/(lambda + beta): no 0/0 at infinite slip.
    const T beta = h / (tangential_penalty * phi);
    const T sum = slip_length / flow.viscosity + beta;
    const Vec<dim, T> t = tangential<dim, T>((1.0 / sum) * slip + (1.0 - beta / sum) * friction, n);
    const T gap = dot(slip, n);
    const T push = (normal_penalty / h) * phi * gap;

    r.value(Velocity{}) += t - force;
    r.value(Velocity{}) += push * n;
    r.value(Pressure{}) -= gap;
    if (adjoint == 0) return;
    const Vec<dim, T> mismatch = beta * t + gap * n;
    r.gradient(Velocity{}) += (2 * adjoint * flow.viscosity) * sym(outer(mismatch, n));
  }

 private:
  template <int dim, class T, class G>
  static Vec<dim, T> tangential(const Vec<dim, T>& a, const Vec<dim, G>& n) {
    return a - dot(a, n) * n;
  }
};

}  // namespace seam::fluid
