// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scales.hpp"

namespace seam::fluid {

/// (rho grad(dv) v + grad dp, tau_M R) + (div dv, tau_C div v) with the residual of the momentum balance
/// R = rho (dv/dt + grad(v) v - b) + grad p: stabilisation of convection (SUPG), of equal orders (PSPG) and
/// of the volume (grad-div), for unknowns of order 1. The viscous part of R, div(2 mu sym(grad v)), vanishes
/// on affine simplices and is of the order of the error elsewhere; order 2 would need it.
struct ResidualStabilisation {
  using Reads = Slots<Value<Velocity>, Rate<Velocity>, Gradient<Velocity>, Gradient<Pressure>>;
  using Tests = Slots<Gradient<Velocity>, Gradient<Pressure>>;
  Flow flow;
  std::vector<Expression> body_force;  ///< m/s^2; empty for none
  double momentum, divergence;         ///< factors of tau_M and tau_C

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    using std::sqrt;
    const double h = x.cell_size / std::sqrt(static_cast<double>(dim));  // edge of a cube
    const Vec<dim, T> velocity = s.value(Velocity{});
    const Mat<dim, dim, T> grad = s.gradient(Velocity{});
    Vec<dim, T> acceleration = s.rate(Velocity{});
    T square(0.0);  // of the speed that convects
    if (flow.convection) {
      acceleration += grad * velocity;
      square = dot(velocity, velocity);
    }
    if (!body_force.empty()) acceleration -= evaluate_at<dim>(body_force, x.position, x);
    const double viscous = 12 * flow.viscosity / (h * h), convective = 2 * flow.density / h;
    const double inertia = transient(flow, x);
    const T tau_m =
        momentum / sqrt((convective * convective) * square + (viscous * viscous + inertia * inertia));
    const double half = 0.5 * flow.density * h;
    const T tau_c = divergence * sqrt((half * half) * square + flow.viscosity * flow.viscosity);

    const Vec<dim, T> residual = tau_m * (flow.density * acceleration + s.gradient(Pressure{}));
    r.gradient(Pressure{}) += residual;
    if (flow.convection) r.gradient(Velocity{}) += flow.density * outer(residual, velocity);
    Mat<dim, dim, T> spherical;
    const T divergence_stress = tau_c * trace(grad);
    for (int i = 0; i < dim; ++i) spherical(i, i) = divergence_stress;
    r.gradient(Velocity{}) += spherical;
  }
};

}  // namespace seam::fluid
