// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scales.hpp"

/// Penalties on jumps of derivatives across the faces between cells: continuous interior penalty, thesis
/// (2.114)-(2.118), and ghost penalty, (3.4)-(3.6). Velocity and pressure are continuous, so their gradients
/// jump in the direction of the normal only: [[grad v]] = [[dv/dn]] n^T and [[div v]] = n . [[dv/dn]].
namespace seam::fluid {

/// Velocity and pressure of both cells at a face.
using v0 = Vector<0>;
using v1 = Vector<1>;
using p0 = Scalar<2>;
using p1 = Scalar<3>;
inline const std::vector<Operand> both_sides{
    {0, "velocity"}, {1, "velocity"}, {0, "pressure"}, {1, "pressure"}};

/// What h of (2.118) is at a face: the larger diameter of both cells, or how far the larger one reaches to
/// either side of the face, its volume over the face's area: a tenth of that where the cell is ten times as
/// long along the face.
enum class JumpLength { diameter, across };

/// gamma_u, gamma_p and gamma_div of (2.118).
struct JumpConstants {
  double convective, pressure, divergence;
  JumpLength length = JumpLength::diameter;
};

/// tau_u, tau_p and tau_div of (2.118) at a point of a face. The thesis takes the largest velocity component
/// of both cells; here it is the speed at the point, so that it can be differentiated.
template <class T>
struct JumpFactors {
  T velocity, pressure, divergence;

  template <int dim>
  JumpFactors(const Flow& flow, const JumpConstants& constants, const Point<dim>& x, const Vec<dim, T>& v) {
    const double h = constants.length == JumpLength::across ? x.trace_size : x.cell_size;
    const T phi = resistance<dim, T>(flow, h, x, v);
    velocity = T(0.0);
    if (flow.convection)
      velocity = (constants.convective * flow.density * flow.density * h * h * h) * dot(v, v) / phi;
    pressure = (constants.pressure * h * h * h) / phi;
    divergence = (constants.divergence * h) * phi;
  }
};

/// Continuous interior penalty (2.114).
struct InteriorPenalty {
  using Reads = Slots<Value<v0>, NormalDerivative<v0>, NormalDerivative<v1>, NormalDerivative<p0>,
                      NormalDerivative<p1>>;
  using Tests = Slots<NormalDerivative<v0>, NormalDerivative<v1>, NormalDerivative<p0>, NormalDerivative<p1>>;
  Flow flow;
  JumpConstants constants;

  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const JumpFactors<T> tau(flow, constants, x, s.value(v0{}));
    const Vec<dim, T> jump = s.normal_derivative(v0{}) - s.normal_derivative(v1{});
    const T divergence = tau.divergence * dot(jump, x.normal);
    const Vec<dim, T> on_v = tau.velocity * jump + divergence * x.normal;
    const T on_p = tau.pressure * (s.normal_derivative(p0{}) - s.normal_derivative(p1{}));
    r.normal_derivative(v0{}) += on_v;
    r.normal_derivative(v1{}) -= on_v;
    r.normal_derivative(p0{}) += on_p;
    r.normal_derivative(p1{}) -= on_p;
  }
};

/// Ghost penalty (3.4) with the parameters (3.6), on faces of cut cells. It comes on top of the interior
/// penalty there.
struct GhostPenalty {
  using Reads = Slots<Value<v0>, NormalDerivative<v0>, NormalDerivative<v1>, NormalDerivative<p0>,
                      NormalDerivative<p1>, SecondNormalDerivative<v0>, SecondNormalDerivative<v1>,
                      SecondNormalDerivative<p0>, SecondNormalDerivative<p1>>;
  using Tests = Slots<NormalDerivative<v0>, NormalDerivative<v1>, NormalDerivative<p0>, NormalDerivative<p1>,
                      SecondNormalDerivative<v0>, SecondNormalDerivative<v1>, SecondNormalDerivative<p0>,
                      SecondNormalDerivative<p1>>;
  Flow flow;
  JumpConstants constants;
  double viscous;       ///< gamma_nu
  double transient;     ///< gamma_t
  double second_order;  ///< of the second derivatives' factors, times h^2

  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const double h = x.cell_size;
    JumpFactors<T> tau(flow, constants, x, s.value(v0{}));
    tau.velocity += viscous * h * flow.viscosity + transient * h * h * h * fluid::transient(flow, x);
    const Vec<dim, T> slope = s.normal_derivative(v0{}) - s.normal_derivative(v1{});
    const T divergence = tau.divergence * dot(slope, x.normal);
    const Vec<dim, T> on_v = tau.velocity * slope + divergence * x.normal;
    const T on_p = tau.pressure * (s.normal_derivative(p0{}) - s.normal_derivative(p1{}));
    r.normal_derivative(v0{}) += on_v;
    r.normal_derivative(v1{}) -= on_v;
    r.normal_derivative(p0{}) += on_p;
    r.normal_derivative(p1{}) -= on_p;

    const double second = second_order * h * h;
    const Vec<dim, T> bend_v = (second * (tau.velocity + tau.divergence)) *
                               (s.second_normal_derivative(v0{}) - s.second_normal_derivative(v1{}));
    const T bend_p =
        (second * tau.pressure) * (s.second_normal_derivative(p0{}) - s.second_normal_derivative(p1{}));
    r.second_normal_derivative(v0{}) += bend_v;
    r.second_normal_derivative(v1{}) -= bend_v;
    r.second_normal_derivative(p0{}) += bend_p;
    r.second_normal_derivative(p1{}) -= bend_p;
  }
};

}  // namespace seam::fluid
