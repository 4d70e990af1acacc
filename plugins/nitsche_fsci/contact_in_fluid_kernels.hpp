// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "contact_kernels.hpp"
#include "fluid_sided.hpp"

/// Fluid, body and contact by one formula, thesis chapter 6. With the body's outward normal n = -n_F the
/// normal traction on its surface is
///
///   min(F, S),  F = n . sigma_F n + gamma_F (v - du/dt) . n,  S = n . sigma_S n + gamma_S g      (6.15)
///
/// whether fluid is there or not: in the closed part of the surface F is that of the nearest wet point
/// (6.3.3). Wet points: the fluid gets all of FluidSided, with F, and with a slip length that grows as the
/// gap closes (Remark 6.7, (6.30)); the body gets min(F, S) n and the fluid's friction. Adjoint terms stay in
/// both states: dropped in contact, as (6.23) has it, they make the residual jump where a point changes its
/// state. Closed points: the body gets min(F, S) n.
namespace seam::fsci {

using OppositeDisplacement = Vector<3>;
using EdgeDisplacement = Vector<4>;
using OppositePressure = Scalar<5>;

/// F.
struct FluidPull {
  Flow flow;
  double penalty;  ///< gamma_n of thesis (3.26)

  /// @param body the body's velocity @param n out of the fluid
  template <int dim, class T, class G>
  [[nodiscard]] T operator()(const Point<dim, G>& x, const Vec<dim, T>& velocity,
                             const Mat<dim, dim, T>& gradient, const T& pressure,
                             const Vec<dim, T>& body) const {
    const Vec<dim, G>& n = x.normal;
    const Vec<dim, T> shear = ((2 * flow.viscosity) * sym(gradient)) * n;
    return dot(shear, n) - pressure -
           ((penalty / x.trace_size) * resistance<dim, T, G>(flow, x, velocity)) * dot(velocity - body, n);
  }
};

/// FluidSided where there is a gap to another surface.
struct FluidSidedNear : FluidSided {
  static constexpr int movers = 2;
};

/// S where the other body has an opposite point. @tparam porous whether it has pores
template <bool porous, class... More>
struct BodyPulls {
  using Reads = std::conditional_t<
      porous, Slots<More..., Gradient<Displacement>, Gradient<OppositeDisplacement>, Value<OppositePressure>>,
      Slots<More..., Gradient<Displacement>, Gradient<OppositeDisplacement>>>;
  BodyPull bodies;

  template <int dim, class T, class G>
  [[nodiscard]] T of_bodies(const Point<dim, G>& x, const Trial<dim, T, Reads>& s) const {
    const Mat<dim, dim, T> own = s.gradient(Displacement{}), other = s.gradient(OppositeDisplacement{});
    if constexpr (porous) {
      const T pressure = s.value(OppositePressure{});
      return bodies.operator()<dim, T, G>(x, -x.normal, own, other, nullptr, &pressure);
    } else {
      return bodies.operator()<dim, T, G>(x, -x.normal, own, other);
    }
  }
};

/// F and S at a point that has an opposite one. @tparam Body the displacement whose rate v is compared with
/// @tparam More what else is read
template <bool porous, class Body, class... More>
struct Pulls : BodyPulls<porous, Value<Velocity>, Gradient<Velocity>, Value<Pressure>, Rate<Body>, More...> {
  using Reads = typename BodyPulls<porous, Value<Velocity>, Gradient<Velocity>, Value<Pressure>, Rate<Body>,
                                   More...>::Reads;
  using Tests = Slots<Value<Displacement>>;
  FluidPull fluid;

  template <int dim, class T, class G>
  [[nodiscard]] T of_fluid(const Point<dim, G>& x, const Trial<dim, T, Reads>& s) const {
    return fluid.operator()<dim, T, G>(x, s.value(Velocity{}), s.gradient(Velocity{}), s.value(Pressure{}),
                                       s.rate(Body{}));
  }
};

/// min(F, S) - F for the body at wet points, where FluidSided has given it F.
template <bool porous>
struct NearContact : Pulls<porous, Displacement> {
  using Reads = typename Pulls<porous, Displacement>::Reads;
  using Tests = typename Pulls<porous, Displacement>::Tests;
  static constexpr int movers = 2;

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const T f = this->template of_fluid<dim, T, G>(x, s), contact = this->template of_bodies<dim, T, G>(x, s);
    if (plain(contact) < plain(f)) r.value(Displacement{}) += (contact - f) * x.normal;
  }
};

/// min(F, S) for the body at closed points. F fades to nothing, as in dry contact, within `reach` of the wet
/// point that it is taken from: thesis, Remark 6.12.
template <bool porous>
struct ClosedContact : Pulls<porous, EdgeDisplacement, Value<Displacement>> {
  using Base = Pulls<porous, EdgeDisplacement, Value<Displacement>>;
  using Reads = typename Base::Reads;
  using Tests = typename Base::Tests;
  static constexpr int movers = 4;
  double reach;  ///< m, may be infinite

  template <int dim, class T, class G>
  [[nodiscard]] T of_fluid(const Point<dim, G>& x, const Trial<dim, T, Reads>& s) const {
    using std::sqrt;
    const T edge = Base::template of_fluid<dim, T, G>(x, s);
    if (std::isinf(reach)) return edge;
    Vec<dim, T> way = s.value(Displacement{});
    way += x.partner_position - x.position;
    const T square = dot(way, way);
    if (plain(square) >= reach * reach) return T(0.0);
    return plain(square) > 0 ? (1 - (1 / reach) * sqrt(square)) * edge : edge;
  }

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const T f = of_fluid<dim, T, G>(x, s), contact = this->template of_bodies<dim, T, G>(x, s);
    r.value(Displacement{}) += (plain(contact) < plain(f) ? contact : f) * x.normal;
  }
};

/// min(0, S) for the body where nothing of its surface is in the fluid: dry contact.
template <bool porous>
struct ShutContact : BodyPulls<porous> {
  using Reads = typename BodyPulls<porous>::Reads;
  using Tests = Slots<Value<Displacement>>;
  static constexpr int movers = 2;

  template <int dim, class T, class G>
  [[nodiscard]] T of_fluid(const Point<dim, G>&, const Trial<dim, T, Reads>&) const {
    return T(0.0);
  }
  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(Displacement{}) += pressing(this->template of_bodies<dim, T, G>(x, s)) * x.normal;
  }
};

/// Whether the bodies touch, at a near, a closed or a shut point, and how hard.
template <class Kernel>
struct TouchState {
  using Reads = typename Kernel::Reads;
  enum class Number {
    gap,       ///< m
    touches,   ///< 1 or 0
    pressure,  ///< -S where they touch, Pa
    traction   ///< of this, on the body, a component, Pa
  };
  static constexpr int values(int) { return 1; }
  Kernel kernel;
  Number number;
  int component = 0;

  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    *value = x.gap;
    if (number == Number::gap) return;
    const double contact = kernel.template of_bodies<dim, double, double>(x, s);
    *value = 0;
    if (contact >= kernel.template of_fluid<dim, double, double>(x, s)) return;
    *value = number == Number::touches ? 1 : -contact;
    if (number == Number::traction) *value *= x.normal[component];
  }
};

/// A component of the traction on the body that a kernel means: minus its coefficient of the test
/// displacement.
template <class Kernel>
struct TractionOf {
  using Reads = typename Kernel::Reads;
  static constexpr int values(int) { return 1; }
  Kernel kernel;
  int component;

  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    using Tests = typename Kernel::Tests;
    double coefficients[Tests::size(dim)] = {};
    Test<dim, double, Tests> r{coefficients};
    kernel.template operator()<dim, double, double>(x, s, r);
    *value = -r.value(Displacement{}).data[component];
  }
};

}  // namespace seam::fsci
