// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/term/given_functions.hpp"

/// Coupling of a fluid (side 0) with a deforming body (side 1) by Nitsche's method: what both
/// representations of the traction share.
namespace seam::fsci {

using Velocity = Vector<0>;
using Pressure = Scalar<1>;
using Displacement = Vector<2>;

/// What the coupling needs to know of the fluid.
struct Flow {
  double density;    ///< kg/m^3
  double viscosity;  ///< dynamic, Pa s
  bool convection;   ///< false: Stokes flow
};

/// How Nitsche's method ties the fluid.
struct Ties {
  double adjoint;                             ///< xi: +1 skew-symmetric, -1 symmetric, 0 none
  double normal_penalty, tangential_penalty;  ///< gamma_n, gamma_t; gamma_t may be infinite
};

/// A given difference between the two sides: a function at the place where the point is now minus one at the
/// material point of the body. Empty lists stand for zero.
struct Jump {
  std::vector<Expression> fluid, body;

  /// Its `count` components at a point.
  template <int count, int dim, class G>
  [[nodiscard]] Vec<count, G> at(const Point<dim, G>& x) const {
    Vec<count, G> value;
    if (!fluid.empty()) value += evaluate_at<count>(fluid, x.position, x);
    if (!body.empty()) value -= evaluate_at<count>(body, x.partner_position, x);
    return value;
  }
};

/// The jumps of a manufactured solution, thesis (3.47), (3.48): v = du/dt + g_v and
/// (sigma_F - sigma_S) n = g_sigma.
struct Jumps {
  Jump velocity;  ///< m/s
  Jump stress;    ///< Pa, row by row

  /// J = v - du/dt - g_v.
  template <int dim, class T, class G>
  [[nodiscard]] Vec<dim, T> mismatch(const Point<dim, G>& x, const Vec<dim, T>& velocity_of_fluid,
                                     const Vec<dim, T>& velocity_of_body) const {
    Vec<dim, T> jump = velocity_of_fluid - velocity_of_body;
    jump -= velocity.at<dim>(x);
    return jump;
  }
  /// g_sigma, with the normal as it is.
  template <int dim, class G>
  [[nodiscard]] Vec<dim, G> traction(const Point<dim, G>& x) const {
    Mat<dim, dim, G> difference;
    difference.c = stress.at<dim * dim>(x).c;
    return difference * x.normal;
  }
};

/// J: what the kinematic condition misses.
struct VelocityMismatch {
  using Reads = Slots<Value<Velocity>, Rate<Displacement>>;
  static constexpr int values(int dim) { return dim; }
  Jumps jumps;
  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    const auto j = jumps.mismatch<dim, double>(x, s.value(Velocity{}), s.rate(Displacement{}));
    std::copy(j.c.begin(), j.c.end(), value);
  }
};

/// The rate at which fluid, or body, passes out of the fluid: v . n or du/dt . n, m/s.
template <class Speed>
struct Outflow {
  using Reads = Slots<Speed>;
  static constexpr int values(int) { return 1; }

  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    if constexpr (Speed::level == Level::rate)
      *value = dot(s.rate(typename Speed::operand{}), x.normal);
    else
      *value = dot(s.value(typename Speed::operand{}), x.normal);
  }
};

}  // namespace seam::fsci
