// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernels.hpp"

/// What a fluid shows besides its unknowns.
namespace seam::fluid {

/// Cauchy stress, Pa: xx, yy, zz, xy, yz, xz. In the plane zz is -p.
struct CauchyStress {
  using Reads = Slots<Gradient<Velocity>, Value<Pressure>>;
  static constexpr int values(int) { return 6; }
  double viscosity;  ///< Pa s
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    const auto sigma = stress<dim, double>(viscosity, s.gradient(Velocity{}), s.value(Pressure{}));
    value[0] = sigma(0, 0), value[1] = sigma(1, 1), value[3] = sigma(0, 1);
    value[2] = -s.value(Pressure{}), value[4] = value[5] = 0;
    if constexpr (dim == 3) value[2] = sigma(2, 2), value[4] = sigma(1, 2), value[5] = sigma(0, 2);
  }
};

/// grad v, 1/s, row by row: the derivative's direction runs fastest.
struct VelocityGradient {
  using Reads = Slots<Gradient<Velocity>>;
  static constexpr int values(int dim) { return dim * dim; }
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    const auto gradient = s.gradient(Velocity{});
    std::copy(gradient.c.begin(), gradient.c.end(), value);
  }
};

/// curl v, 1/s: a number in the plane, a vector in space.
struct Vorticity {
  using Reads = Slots<Gradient<Velocity>>;
  static constexpr int values(int dim) { return dim == 2 ? 1 : 3; }
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    const auto g = s.gradient(Velocity{});
    if constexpr (dim == 2) {
      value[0] = g(1, 0) - g(0, 1);
    } else {
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        value[i] = g(k, j) - g(j, k);
      }
    }
  }
};

/// rho/2 |v|^2, J per volume.
struct KineticEnergy {
  using Reads = Slots<Value<Velocity>>;
  static constexpr int values(int) { return 1; }
  double density;  ///< kg/m^3
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    *value = 0.5 * density * dot(s.value(Velocity{}), s.value(Velocity{}));
  }
};

/// 2 mu eps : eps, W per volume: what viscosity turns into heat.
struct Dissipation {
  using Reads = Slots<Gradient<Velocity>>;
  static constexpr int values(int) { return 1; }
  double viscosity;  ///< Pa s
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    const auto rate = sym(s.gradient(Velocity{}));
    *value = 2 * viscosity * inner(rate, rate);
  }
};

/// div v, 1/s: integrated, the volume that a fluid of constant volume makes or loses.
struct Divergence {
  using Reads = Slots<Gradient<Velocity>>;
  static constexpr int values(int) { return 1; }
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    *value = trace(s.gradient(Velocity{}));
  }
};

struct Volume {
  using Reads = Slots<Value<Velocity>>;
  static constexpr int values(int) { return 1; }
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>&, double* value) const {
    *value = 1;
  }
};

}  // namespace seam::fluid
