// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "kernels.hpp"

/// The fluid's viscous, convective and transient resistance as one number, by which stabilising and weak
/// terms are scaled.
namespace seam::fluid {

/// |v|, m/s, made smooth at rest: below a tenth of the speed at which convection matters (mu/(rho h)) it
/// falls to zero quadratically. With its kink Newton's method would limp wherever the fluid rests.
template <int dim, class T>
T speed(const Flow& flow, double h, const Vec<dim, T>& velocity) {
  using std::sqrt;
  const double slow = 0.1 * flow.viscosity / (flow.density * h);
  const T square = dot(velocity, velocity);
  return square / sqrt(square + slow * slow);
}

/// rho/(theta dt), kg/(m^3 s); 0 in a static problem.
template <int dim, class G>
double transient(const Flow& flow, const Point<dim, G>& x) {
  return x.step > 0 ? flow.density / (x.theta * x.step) : 0.0;
}

/// mu + h c_v rho |v| + h^2 c_t rho/(theta dt), Pa s: Phi of thesis (2.118), and h times phi of (3.27).
/// @param h cell size (2.118) or trace size (3.27), m
template <int dim, class T, class G>
T resistance(const Flow& flow, double h, const Point<dim, G>& x, const Vec<dim, T>& velocity) {
  constexpr double c_v = 1.0 / 6, c_t = 1.0 / 12;
  T phi = flow.viscosity + h * h * c_t * transient(flow, x);
  if (flow.convection) phi += (h * c_v * flow.density) * speed<dim, T>(flow, h, velocity);
  return phi;
}

}  // namespace seam::fluid
