// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernels.hpp"

/// What a porous body shows besides its unknowns.
namespace seam::poro {

/// phi, part of the current volume.
struct PorosityValue {
  using pressure = Scalar<1>;
  using Reads = Slots<Gradient<u>, Value<pressure>>;
  static constexpr int values(int) { return 1; }
  Porosity porosity;
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    const double j = Deformation<dim, double>(s.gradient(u{})).invariant[2];
    *value = porosity.fluid_volume(j, s.value(pressure{})) / j;
  }
};

/// phi (v - du/dt), m/s: the fluid that passes through an area that moves with the skeleton.
struct SeepageVelocity {
  using Reads = Slots<Gradient<u>, Rate<u>, Value<v>, Value<p>>;
  static constexpr int values(int dim) { return dim; }
  Porosity porosity;
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    const double j = Deformation<dim, double>(s.gradient(u{})).invariant[2];
    const double phi = porosity.fluid_volume(j, s.value(p{})) / j;
    const Vec<dim, double> v_of_skeleton = s.rate(u{}), v_of_fluid = s.value(v{});
    for (int i = 0; i < dim; ++i) value[i] = phi * (v_of_fluid[i] - v_of_skeleton[i]);
  }
};

/// phi C N.w, m/s of area at rest, as in the balance of mass: the fluid that leaves the body.
struct Outflow {
  using Reads = SeepageVelocity::Reads;
  static constexpr int values(int) { return 1; }
  Porosity porosity;
  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    const Deformation<dim, double> d(s.gradient(u{}));
    const Vec<dim, double> w = s.value(v{}) - s.rate(u{});
    *value =
        porosity.fluid_volume(d.invariant[2], s.value(p{})) / d.invariant[2] * dot(d.cofactor * x.normal, w);
  }
};

/// J phi, m^3 of fluid per reference volume.
struct FluidVolume {
  using pressure = Scalar<1>;
  using Reads = Slots<Gradient<u>, Value<pressure>>;
  static constexpr int values(int) { return 1; }
  Porosity porosity;
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    *value =
        porosity.fluid_volume(Deformation<dim, double>(s.gradient(u{})).invariant[2], s.value(pressure{}));
  }
};

/// J
struct CurrentVolume {
  using Reads = Slots<Gradient<u>>;
  static constexpr int values(int) { return 1; }
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    *value = Deformation<dim, double>(s.gradient(u{})).invariant[2];
  }
};

}  // namespace seam::poro
