// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "laws.hpp"
#include "seam/physics/body_terms.hpp"
#include "seam/scene/expression.hpp"
#include "seam/term/kernel_term.hpp"

/// The weak form of a porous body whose skeleton deforms and whose pores are filled with an incompressible
/// fluid: the balances (2.43), (2.44) and (2.46) of the thesis, term by term, pulled back to the reference
/// configuration. With w = v - du/dt, m = J phi, C = cof F = J F^-T:
///   mass:    (dp, dm/dt) - (grad0 dp, phi C^T w) + <dp, phi C N.w> - (dp, q)
///   fluid:   (dv, rho_F J a) - (grad0 dv, p C) + (dv, mu phi C K^-1 C^T w) - (dv, rho_F J b_F),
///            J a = J dv/dt - grad0 v C^T du/dt
///   mixture: (du, rho_S d2u/dt2) + (grad0 du, P_skeleton - p' C) + (du, rho_F m a) - (du, rho_S b + rho_F m
///   b_F)
/// where p' = Porosity::back_pressure. The mixture's balance is that of its total momentum. (2.46) has
/// -phi C grad0 p - mu phi^2 C K^-1 C^T w in place of the last of its fluid's terms: by the fluid's balance
/// the same, but once pressures are imposed weakly <du, phi (p - p_imposed) C N> is missing from the sum of
/// all forces. The printed weak forms (2.57) and (2.121) are damaged; these follow from the balances.
namespace seam::poro {

using u = Vector<0>;
using v = Vector<1>;
using p = Scalar<2>;

/// Balance of mass without its boundary term.
struct Storage {
  using Reads = Slots<Gradient<u>, RateGradient<u>, Rate<u>, Value<v>, Value<p>, Rate<p>, OldGradient<u>,
                      OldValue<p>, OldRateGradient<u>, OldRate<p>>;
  using Tests = Slots<Value<p>, Gradient<p>>;
  Porosity porosity;
  bool conservative;  ///< what is stored in a step is the change of J phi, not its derivative times the step

  /// dm/dt by the chain rule.
  template <int dim, class T>
  [[nodiscard]] T chain_rule(const Deformation<dim, T>& d, const Mat<dim, dim, T>& velocity_gradient,
                             const T& pressure, const T& pressure_rate) const {
    using Two = Fad<2, T>;
    const Two m = porosity.fluid_volume(Two(d.invariant[2], 0), Two(pressure, 1));
    return m.d[0] * inner(d.cofactor, velocity_gradient) + m.d[1] * pressure_rate;
  }

  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Deformation<dim, T> d(s.gradient(u{}));
    const T m = porosity.fluid_volume(d.invariant[2], s.value(p{}));
    const T phi = m / d.invariant[2];
    if (conservative && x.step > 0) {
      const Deformation<dim, T> old(s.old_gradient(u{}));
      const T before = porosity.fluid_volume(old.invariant[2], s.old_value(p{}));
      T rate = (m - before) / (x.theta * x.step);
      if (x.theta < 1)
        rate -= (1 - x.theta) / x.theta *
                chain_rule<dim, T>(old, s.old_rate_gradient(u{}), s.old_value(p{}), s.old_rate(p{}));
      r.value(p{}) += rate;
    } else {
      r.value(p{}) += chain_rule<dim, T>(d, s.rate_gradient(u{}), s.value(p{}), s.rate(p{}));
    }
    const Vec<dim, T> w = s.value(v{}) - s.rate(u{});
    r.gradient(p{}) -= phi * (transpose(d.cofactor) * w);
  }
};

/// <dp, phi C N.w> of the balance of mass, on all of the boundary.
struct Seepage {
  using Reads = Slots<Gradient<u>, Rate<u>, Value<v>, Value<p>>;
  using Tests = Slots<Value<p>>;
  Porosity porosity;
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Deformation<dim, T> d(s.gradient(u{}));
    const T phi = porosity.fluid_volume(d.invariant[2], s.value(p{})) / d.invariant[2];
    const Vec<dim, T> w = s.value(v{}) - s.rate(u{});
    r.value(p{}) += phi * dot(d.cofactor * x.normal, w);
  }
};

/// -(dp, q): fluid that comes into the pores from elsewhere; it brings no momentum.
struct MassSource {
  using Reads = Slots<>;
  using Tests = Slots<Value<Scalar<0>>>;
  Expression source;  ///< q, m^3 of fluid per reference volume and second, of the place in the reference
                      ///< configuration
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>&, Test<dim, T, Tests>& r) const {
    r.value(Scalar<0>{}) -= source(x.position.c.data(), dim, x.time);
  }
};

/// Momentum of the fluid in the pores without inertia.
struct PoreMomentum {
  using Reads = Slots<Gradient<u>, Rate<u>, Value<v>, Value<p>>;
  using Tests = Slots<Value<v>, Gradient<v>>;
  PoreFlow flow;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Deformation<dim, T> d(s.gradient(u{}));
    const Vec<dim, T> w = s.value(v{}) - s.rate(u{});
    const T m = flow.porosity.fluid_volume(d.invariant[2], s.value(p{}));
    r.value(v{}) += flow.template drag<dim, T>(d, m, w);
    r.gradient(v{}) -= s.value(p{}) * d.cofactor;
  }
};

/// Momentum of the mixture without inertia: (grad0 du, P_skeleton - p' C).
struct MixtureStress {
  using pressure = Scalar<1>;
  using Reads = Slots<Gradient<u>, Value<pressure>>;
  using Tests = Slots<Gradient<u>>;
  MixtureFormula formula;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.gradient(u{}) += formula.stress<dim, T>(Deformation<dim, T>(s.gradient(u{})), s.value(pressure{}));
  }
};

/// -(du, phi C grad0 p) - (du, mu phi^2 C K^-1 C^T w): what (2.46) says of the fluid instead of its inertia.
struct PrintedExchange {
  using Reads = Slots<Gradient<u>, Rate<u>, Value<v>, Value<p>, Gradient<p>>;
  using Tests = Slots<Value<u>>;
  PoreFlow flow;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Deformation<dim, T> d(s.gradient(u{}));
    const T m = flow.porosity.fluid_volume(d.invariant[2], s.value(p{})), phi = m / d.invariant[2];
    const Vec<dim, T> w = s.value(v{}) - s.rate(u{});
    r.value(u{}) -= phi * (d.cofactor * s.gradient(p{}) + flow.template drag<dim, T>(d, m, w));
  }
};

/// What the mixture gets of a force on the fluid in its pores: phi of it, or what PrintedExchange has of it.
struct MixtureShare {
  Porosity porosity;
  bool printed;
  template <class T>
  [[nodiscard]] T operator()(const T& jacobian, const T& pressure) const {
    return printed ? T(0.0) : T(porosity.fluid_volume(jacobian, pressure) / jacobian);
  }
};

/// rho_F J a on the fluid in the pores, and phi times that on the mixture.
struct PoreInertia {
  using Reads = Slots<Gradient<u>, Rate<u>, Rate<v>, Gradient<v>, Value<p>>;
  using Tests = Slots<Value<u>, Value<v>>;
  double density;
  MixtureShare share;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Deformation<dim, T> d(s.gradient(u{}));
    // The observer moves with the skeleton: J grad v du/dt = grad0 v C^T du/dt.
    const Vec<dim, T> force =
        density * (d.invariant[2] * s.rate(v{}) - s.gradient(v{}) * (transpose(d.cofactor) * s.rate(u{})));
    r.value(v{}) += force;
    r.value(u{}) += share(d.invariant[2], s.value(p{})) * force;
  }
};

/// -(dv, rho_F J b_F) on the fluid in the pores, and phi times that on the mixture.
struct FluidLoad {
  using Reads = Slots<Gradient<u>, Value<p>>;
  using Tests = Slots<Value<u>, Value<v>>;
  std::vector<Expression> force;  ///< b_F, m/s^2, of the place in the reference configuration
  double density;
  MixtureShare share;
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const T j = Deformation<dim, T>(s.gradient(u{})).invariant[2];
    Vec<dim, double> value;
    for (int i = 0; i < dim; ++i) value[i] = density * force[i](x.position.c.data(), dim, x.time);
    r.value(v{}) -= j * value;
    r.value(u{}) -= (share(j, s.value(p{})) * j) * value;
  }
};

/// The same with the force interpolated from the nodes.
struct NodalFluidLoad {
  using force = Vector<3>;
  using Reads = Slots<Gradient<u>, Value<p>, Value<force>>;
  using Tests = Slots<Value<u>, Value<v>>;
  double density;
  MixtureShare share;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const T j = Deformation<dim, T>(s.gradient(u{})).invariant[2];
    const Vec<dim, T> load = (density * j) * s.value(force{});
    r.value(v{}) -= load;
    r.value(u{}) -= share(j, s.value(p{})) * load;
  }
};

/// <dv, p N> on the current boundary: the pressure of a fluid outside, in the pores.
struct PorePressure {
  using Reads = Slots<Gradient<u>>;
  using Tests = Slots<Value<v>>;
  Expression pressure;  ///< Pa
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Deformation<dim, T> d(s.gradient(u{}));
    r.value(v{}) += pressure(x.position.c.data(), dim, x.time) * (d.cofactor * x.normal);
  }
};

/// Given flow through the current boundary, phi w.n = j, imposed weakly. With a = C N, the current area
/// vector:
///   <dv, p a> - <dp, phi a.w - j |a|> + gamma h Phi <dv, (phi a.w - j |a|) n>.
/// The first makes the fluid's momentum consistent where nothing is said of the pressure, the second turns
/// the outflow in the balance of mass (Seepage) into the given one, so that mass balances to rounding. Tested
/// with phi w and p the two cancel: stable for every gamma >= 0.
struct WeakSeepage {
  using Reads = Slots<Gradient<u>, Rate<u>, Value<v>, Value<p>>;
  using Tests = Slots<Value<v>, Value<p>>;
  Porosity porosity;
  PoreScale scale;
  Expression flow;  ///< j, m/s, out of the body
  double penalty;   ///< gamma
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    using std::sqrt;
    const Deformation<dim, T> d(s.gradient(u{}));
    const T phi = porosity.fluid_volume(d.invariant[2], s.value(p{})) / d.invariant[2];
    const Vec<dim, T> area = d.cofactor * x.normal, w = s.value(v{}) - s.rate(u{});
    const T size = sqrt(dot(area, area));
    const T miss = phi * dot(area, w) - flow(x.position.c.data(), dim, x.time) * size;
    r.value(v{}) += (s.value(p{}) + (penalty * x.trace_size * scale(x)) * miss / size) * area;
    r.value(p{}) -= miss;
  }
};

/// <du, p N> on the current boundary: the same pressure on the mixture.
struct MixturePressure {
  using Reads = Slots<Gradient<u>>;
  using Tests = Slots<Value<u>>;
  Expression pressure;  ///< Pa, positive in compression
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Deformation<dim, T> d(s.gradient(u{}));
    r.value(u{}) += pressure(x.position.c.data(), dim, x.time) * (d.cofactor * x.normal);
  }
};

/// Continuous interior penalty (2.123), (2.124) of velocity and pressure in the pores, in the reference
/// configuration and with the initial resistance (Remark 2.10).
struct InteriorPenalty {
  using v0 = Vector<0>;
  using v1 = Vector<1>;
  using p0 = Scalar<2>;
  using p1 = Scalar<3>;
  using Reads = Slots<NormalDerivative<v0>, NormalDerivative<v1>, NormalDerivative<p0>, NormalDerivative<p1>>;
  using Tests = Reads;
  PoreScale scale;
  double pressure, divergence;  ///< gamma_p, gamma_div
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const double h = x.cell_size;
    const double phi = h * h * scale(x);
    const Vec<dim, T> jump = s.normal_derivative(v0{}) - s.normal_derivative(v1{});
    const Vec<dim, T> on_v = (divergence * h * phi * dot(jump, x.normal)) * x.normal;
    const T on_p = (pressure * h * h * h / phi) * (s.normal_derivative(p0{}) - s.normal_derivative(p1{}));
    r.normal_derivative(v0{}) += on_v;
    r.normal_derivative(v1{}) -= on_v;
    r.normal_derivative(p0{}) += on_p;
    r.normal_derivative(p1{}) -= on_p;
  }
};

/// (C grad0 dp / J, tau R) with the residual of the momentum of the fluid in the pores, R = C grad0 p + drag
/// + rho_F (J dv/dt - grad v du/dt - J b), and tau = factor phi_0/(mu phi_0/K + rho_F/(theta dt)): for equal
/// orders, without a share of neighbours' neighbours in the matrix. With factor 1/2 and without inertia this
/// is the stabilisation of Darcy's flow by Masud and Hughes (2002): it needs no size of cells.
struct ResidualStabilisation {
  using Reads = Slots<Gradient<u>, Rate<u>, Value<v>, Rate<v>, Gradient<v>, Value<p>, Gradient<p>>;
  using Tests = Slots<Gradient<p>>;
  PoreFlow flow;
  std::vector<Expression> body_force;  ///< on the fluid, m/s^2; empty for none
  double factor;
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Deformation<dim, T> d(s.gradient(u{}));
    const T& j = d.invariant[2];
    const T m = flow.porosity.fluid_volume(j, s.value(p{}));
    Vec<dim, T> residual = d.cofactor * s.gradient(p{}) +
                           flow.template drag<dim, T>(d, m, Vec<dim, T>(s.value(v{}) - s.rate(u{})));
    if (flow.density > 0) {
      Vec<dim, T> rate = s.rate(v{});
      for (int i = 0; i < dim && !body_force.empty(); ++i)
        rate[i] -= body_force[i](x.position.c.data(), dim, x.time);
      residual += flow.density * (j * rate - s.gradient(v{}) * (transpose(d.cofactor) * s.rate(u{})));
    }
    const T resistance = flow.scale(dim).resistance / flow.template resistance<dim>().opened(m);
    const double inertia = x.step > 0 ? flow.density / (x.theta * x.step) : 0.0;
    const T tau = factor * flow.porosity.initial / (resistance + inertia);
    r.gradient(p{}) += (tau / j) * (transpose(d.cofactor) * residual);
  }
};

}  // namespace seam::poro
