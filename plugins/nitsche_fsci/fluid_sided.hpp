// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "conditions.hpp"

namespace seam::fsci {

/// Phi of thesis (3.27) times h_Gamma: mu + h c_v rho |v| + h^2 c_t rho/(theta dt), Pa s. |v| falls to zero
/// smoothly below a tenth of the speed at which convection matters: with its kink Newton's method would limp
/// wherever the fluid rests.
template <int dim, class T, class G>
T resistance(const Flow& flow, const Point<dim, G>& x, const Vec<dim, T>& velocity) {
  using std::sqrt;
  constexpr double c_v = 1.0 / 6, c_t = 1.0 / 12;
  const double h = x.trace_size;
  T phi = T(flow.viscosity + (x.step > 0 ? h * h * c_t * flow.density / (x.theta * x.step) : 0.0));
  if (!flow.convection) return phi;
  const double slow = 0.1 * flow.viscosity / (flow.density * h);
  const T square = dot(velocity, velocity);
  return phi + (h * c_v * flow.density) * (square / sqrt(square + slow * slow));
}

/// Navier's slip length: a constant one, and near another surface more of it, thesis (6.30): `near` r (r/g -
/// 1) in gaps g narrower than r. Where surfaces touch nothing is left of friction.
struct Slip {
  double length;     ///< m, may be infinite
  double near = 0;   ///< kappa_0
  double reach = 0;  ///< r, m; 0: the width of the fluid's cell

  /// The length is `resisting` to `gliding`, so that none of them need be infinite.
  template <class T>
  struct Ratio {
    T gliding, resisting;
  };
  template <int dim, class T, class G>
  [[nodiscard]] Ratio<T> ratio(const Point<dim, G>& x) const {
    if (std::isinf(length)) return {T(1.0), T(0.0)};
    const double r = reach > 0 ? reach : x.cell_size / std::sqrt(static_cast<double>(dim));
    if (near == 0 || plain(x.gap) >= r) return {T(length), T(1.0)};
    if (plain(x.gap) <= 0) return {T(1.0), T(0.0)};
    return {T(near * r * (r - x.gap) + length * x.gap), T(x.gap)};
  }
};

/// Ties the fluid to a surface that moves with another velocity. With n out of the fluid, J the difference of
/// velocities, P = I - n n^T, Phi = h_Gamma phi of (3.27), lambda = slip length/mu and beta =
/// h_Gamma/(gamma_t Phi), the fluid gets
///
///   <dv, r> - <dp, J.n> + xi <2 mu eps(dv) n, (J.n) n + beta t>,
///   r = t - sigma n + gamma_n Phi/h_Gamma (J.n) n,   t = [P J + lambda P (sigma - sigma_0) n] / (lambda +
///   beta)
///
/// and what it is tied to has to get -r. Thesis (3.26), (3.27), with Navier slip in the manner of (4.5); beta
/// = 0 puts P J/lambda in the place of the tangential traction, as (4.4) does.
/// @param known sigma_0 n: a traction that the law of slip does not see; zero but for manufactured solutions
/// @return r, Pa
template <int dim, class T, class G, class Reads, class Tests>
Vec<dim, T> tie(const Flow& flow, const Ties& ties, const Point<dim, G>& x, const Trial<dim, T, Reads>& s,
                const Vec<dim, T>& jump, const Slip::Ratio<T>& slip, const Vec<dim, G>* known,
                Test<dim, T, Tests>& r) {
  const Vec<dim, G>& n = x.normal;
  const T gap = dot(jump, n);
  Vec<dim, T> force = ((2 * flow.viscosity) * sym(s.gradient(Velocity{}))) * n;
  force -= s.value(Pressure{}) * n;

  const T phi = resistance<dim, T, G>(flow, x, s.value(Velocity{}));
  const T beta = (x.trace_size / ties.tangential_penalty) / phi;
  const T lambda = (1 / flow.viscosity) * slip.gliding;
  const T sum = lambda + beta * slip.resisting;
  const Vec<dim, T> along = (slip.resisting / sum) * (jump - gap * n);
  const Vec<dim, T> rubbing = known ? force - *known : force;
  const Vec<dim, T> friction = (lambda / sum) * (rubbing - dot(rubbing, n) * n);
  const Vec<dim, T> t = along + friction;
  const Vec<dim, T> traction = t - force + ((ties.normal_penalty / x.trace_size) * phi * gap) * n;

  r.value(Velocity{}) += traction;
  r.value(Pressure{}) -= gap;
  if (ties.adjoint != 0)
    r.gradient(Velocity{}) += (2 * ties.adjoint * flow.viscosity) * sym(outer(beta * t + gap * n, n));
  return traction;
}

/// The traction between fluid and body is the fluid's, thesis (3.26): the fluid is tied to the body, J = v -
/// du/dt - g_v, and the body gets -<du, r + g_sigma>.
struct FluidSided {
  using Reads = Slots<Value<Velocity>, Gradient<Velocity>, Value<Pressure>, Rate<Displacement>>;
  using Tests = Slots<Value<Velocity>, Gradient<Velocity>, Value<Pressure>, Value<Displacement>>;
  Flow flow;
  Jumps jumps;
  Slip slip;
  Ties ties;

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Vec<dim, T> jump = jumps.mismatch<dim, T>(x, s.value(Velocity{}), s.rate(Displacement{}));
    r.value(Displacement{}) -= tie<dim, T, G>(flow, ties, x, s, jump, slip.ratio<dim, T, G>(x), nullptr, r);
    r.value(Displacement{}) -= jumps.traction(x);
  }
};

}  // namespace seam::fsci
