// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernels.hpp"

/// What a hyperelastic body shows besides its unknowns.
namespace seam::solid {

/// Velocity, m/s.
struct Velocity {
  using Reads = Slots<Rate<u>>;
  static constexpr int values(int dim) { return dim; }
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    const auto v = s.rate(u{});
    std::copy(v.c.begin(), v.c.end(), value);
  }
};

/// Cauchy stress P F^T / J in three dimensions, Pa: xx, yy, zz, xy, yz, xz.
template <int dim>
std::array<double, 6> cauchy_stress(const Potential& material,
                                    const Mat<dim, dim, double>& displacement_gradient) {
  const Deformation<dim, double> d(displacement_gradient);
  const auto slope = gradient<3, double>(material, d.invariant);
  const double j = d.invariant[2];
  const auto sigma = (1 / j) * (d.stress(slope) * transpose(d.f));
  if constexpr (dim == 2) {
    // F33 = 1: dI1/dF33 = 2, dI2/dF33 = 2 (I1 - 1), dJ/dF33 = J.
    const double out_of_plane = (2 * slope[0] + 2 * slope[1] * (d.invariant[0] - 1) + slope[2] * j) / j;
    return {sigma(0, 0), sigma(1, 1), out_of_plane, sigma(0, 1), 0.0, 0.0};
  } else {
    return {sigma(0, 0), sigma(1, 1), sigma(2, 2), sigma(0, 1), sigma(1, 2), sigma(0, 2)};
  }
}

inline double von_mises(const std::array<double, 6>& s) {
  return std::sqrt(0.5 * (std::pow(s[0] - s[1], 2) + std::pow(s[1] - s[2], 2) + std::pow(s[2] - s[0], 2)) +
                   3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

struct CauchyStress {
  using Reads = Slots<Gradient<u>>;
  static constexpr int values(int) { return 6; }
  PotentialPointer material;
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    const auto sigma = cauchy_stress<dim>(*material, s.gradient(u{}));
    std::copy(sigma.begin(), sigma.end(), value);
  }
};

struct VonMises {
  using Reads = Slots<Gradient<u>>;
  static constexpr int values(int) { return 1; }
  PotentialPointer material;
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    *value = von_mises(cauchy_stress<dim>(*material, s.gradient(u{})));
  }
};

/// The same two with the pressure and dilation of the mixed form, where the displacement's own volume change
/// oscillates: the deviator of the stress at Fbar plus the pressure p as mean stress.
struct MixedCauchyStress {
  using p = Scalar<1>;
  using dilation = Scalar<2>;
  using Reads = Slots<Gradient<u>, Value<p>, Value<dilation>>;
  static constexpr int values(int) { return 6; }
  PotentialPointer material;
  template <int dim>
  [[nodiscard]] std::array<double, 6> stress(const Trial<dim, double, Reads>& s) const {
    // Fbar = (Theta/J)^(1/3) F has an F33 of its own in the plane, so the computation is three-dimensional.
    Mat<3, 3, double> g;
    for (int i = 0; i < dim; ++i)
      for (int k = 0; k < dim; ++k) g(i, k) = s.gradient(u{})(i, k);
    const Deformation<3, double> d(g);
    const double scale = std::cbrt((1 + s.value(dilation{})) / d.invariant[2]);
    const Mat<3, 3, double> bar = scale * d.f;
    auto sigma = cauchy_stress<3>(*material, bar - identity<3>());
    const double shift = s.value(p{}) - (sigma[0] + sigma[1] + sigma[2]) / 3;
    for (int i = 0; i < 3; ++i) sigma[i] += shift;
    return sigma;
  }
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    const auto sigma = stress<dim>(s);
    std::copy(sigma.begin(), sigma.end(), value);
  }
};

struct MixedVonMises {
  using Reads = MixedCauchyStress::Reads;
  static constexpr int values(int) { return 1; }
  MixedCauchyStress stress;
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    *value = von_mises(stress.stress<dim>(s));
  }
};

/// rho0/2 |du/dt|^2, J per reference volume.
struct KineticEnergy {
  using Reads = Slots<Rate<u>>;
  static constexpr int values(int) { return 1; }
  double density;
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    *value = 0.5 * density * dot(s.rate(u{}), s.rate(u{}));
  }
};

/// psi, J per reference volume.
struct StrainEnergy {
  using Reads = Slots<Gradient<u>>;
  static constexpr int values(int) { return 1; }
  PotentialPointer material;
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    const Deformation<dim, double> d(s.gradient(u{}));
    double first[3], second[9];
    material->evaluate(d.invariant.data(), *value, first, second);
  }
};

/// Current per reference volume.
struct CurrentVolume {
  using Reads = Slots<Gradient<u>>;
  static constexpr int values(int) { return 1; }
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    *value = Deformation<dim, double>(s.gradient(u{})).invariant[2];
  }
};

/// Rate of the current volume per reference volume, cof F : grad_0 v, 1/s.
struct VolumeRate {
  using Reads = Slots<Gradient<u>, RateGradient<u>>;
  static constexpr int values(int) { return 1; }
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    *value = inner(Deformation<dim, double>(s.gradient(u{})).cofactor, s.rate_gradient(u{}));
  }
};

}  // namespace seam::solid
