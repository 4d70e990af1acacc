// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "seam/physics/body_terms.hpp"
#include "seam/physics/hyperelastic.hpp"
#include "seam/scene/expression.hpp"
#include "seam/term/kernel_term.hpp"

/// The weak form of a hyperelastic body at finite strain, thesis (2.22) and (2.108), term by term.
namespace seam::solid {

using u = Vector<0>;

/// P = d psi / dF.
struct Piola {
  PotentialPointer material;
  template <int dim, class T>
  [[nodiscard]] Mat<dim, dim, T> stress(const Mat<dim, dim, T>& displacement_gradient) const {
    return Deformation<dim, T>(displacement_gradient).stress(*material);
  }
};

/// (grad0 du, P) of thesis (2.22) .
struct InternalForce {
  using Reads = Slots<Gradient<u>>;
  using Tests = Slots<Gradient<u>>;
  Piola law;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.gradient(u{}) += law.stress<dim, T>(s.gradient(u{}));
  }
};

/// The same for nearly incompressible bodies: stationary point of psi(Fbar) + p (J - Theta) with
/// Fbar = (Theta/J)^(1/3) F, in displacement, pressure and dilation Theta - 1 (Simo, Taylor and Pister 1985).
struct MixedInternalForce {
  using p = Scalar<1>;
  using dilation = Scalar<2>;
  using Reads = Slots<Gradient<u>, Value<p>, Value<dilation>>;
  using Tests = Slots<Gradient<u>, Value<p>, Value<dilation>>;
  PotentialPointer material;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    using std::pow;
    const Deformation<dim, T> d(s.gradient(u{}));
    const T theta = 1.0 + s.value(dilation{});
    const T& j = d.invariant[2];
    const T a = pow(theta / j, 2.0 / 3);
    const std::array<T, 3> bar{a * d.invariant[0], a * a * d.invariant[1], theta};
    const std::array<T, 3> slope = gradient<3>(*material, bar);
    // The isochoric part of the energy is homogeneous of degree 0 in J and of degree 2/3, 4/3 in Theta.
    const T isochoric = (2.0 / 3) * slope[0] * bar[0] + (4.0 / 3) * slope[1] * bar[1];
    Mat<dim, dim, T> stress = (2.0 * a * slope[0]) * d.f + (s.value(p{}) - isochoric / j) * d.cofactor;
    d.add_second_invariant(a * a * slope[1], stress);
    r.gradient(u{}) += stress;
    r.value(p{}) += j - theta;
    r.value(dilation{}) += isochoric / theta + slope[2] - s.value(p{});
  }
};

/// <du, k u> with a stiffness for each direction: an elastic support without mass.
struct Support {
  using Reads = Slots<Value<u>>;
  using Tests = Slots<Value<u>>;
  std::vector<double> stiffness;  ///< Pa/m of reference area
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Vec<dim, T> displacement = s.value(u{});
    Vec<dim, T> push;
    for (int i = 0; i < dim; ++i) push[i] = stiffness[i] * displacement[i];
    r.value(u{}) += push;
  }
};

/// <du, p n> on the current boundary: n da = cof(F) N dA.
struct FollowerPressure {
  using Reads = Slots<Gradient<u>>;
  using Tests = Slots<Value<u>>;
  Expression pressure;  ///< Pa, positive in compression
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Deformation<dim, T> d(s.gradient(u{}));
    r.value(u{}) += pressure(x.position.c.data(), dim, x.time) * (d.cofactor * x.normal);
  }
};

}  // namespace seam::solid
