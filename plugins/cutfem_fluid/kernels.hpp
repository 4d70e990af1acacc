// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/term/given_functions.hpp"

/// The weak form of an incompressible Newtonian fluid on a fixed mesh, thesis (2.112), term by term, with
/// sigma = -p I + 2 mu sym(grad v).
namespace seam::fluid {

using Velocity = Vector<0>;
using Pressure = Scalar<1>;

/// What the stabilising and weak terms need to know of a fluid.
struct Flow {
  double density = 1;      ///< kg/m^3
  double viscosity = 1;    ///< dynamic, Pa s
  bool convection = true;  ///< false: Stokes flow
};

/// Cauchy stress, Pa.
template <int dim, class T>
Mat<dim, dim, T> stress(double viscosity, const Mat<dim, dim, T>& velocity_gradient, const T& pressure) {
  Mat<dim, dim, T> sigma = (2 * viscosity) * sym(velocity_gradient);
  for (int i = 0; i < dim; ++i) sigma(i, i) -= pressure;
  return sigma;
}

/// (grad dv, sigma) + (dp, div v)
struct Stokes {
  using Reads = Slots<Gradient<Velocity>, Value<Pressure>>;
  using Tests = Slots<Gradient<Velocity>, Value<Pressure>>;
  double viscosity;  ///< Pa s
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Mat<dim, dim, T> grad = s.gradient(Velocity{});
    r.gradient(Velocity{}) += stress<dim, T>(viscosity, grad, s.value(Pressure{}));
    r.value(Pressure{}) += trace(grad);
  }
};

/// (dv, rho dv/dt)
struct Inertia {
  using Reads = Slots<Rate<Velocity>>;
  using Tests = Slots<Value<Velocity>>;
  double density;  ///< kg/m^3
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(Velocity{}) += density * s.rate(Velocity{});
  }
};

/// (dv, rho grad(v) v)
struct Convection {
  using Reads = Slots<Value<Velocity>, Gradient<Velocity>>;
  using Tests = Slots<Value<Velocity>>;
  double density;  ///< kg/m^3
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(Velocity{}) += density * (s.gradient(Velocity{}) * s.value(Velocity{}));
  }
};

/// -factor (dv, b(x, t)): a body force (factor rho) or a traction (factor 1).
struct Load {
  using Reads = Slots<>;
  using Tests = Slots<Value<Velocity>>;
  std::vector<Expression> load;
  double factor;
  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>&, Test<dim, T, Tests>& r) const {
    r.value(Velocity{}) -= factor * evaluate_at<dim>(load, x.position, x);
  }
};

/// -(dv, rho b) with the body force interpolated from the nodes.
struct NodalLoad {
  using Force = Vector<1>;
  using Reads = Slots<Value<Force>>;
  using Tests = Slots<Value<Velocity>>;
  double density;  ///< kg/m^3
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(Velocity{}) -= density * s.value(Force{});
  }
};

/// -<dv, mu grad(v)^T n>: what is left of the traction where mu dv/dn - p n = 0, the condition that a
/// developed pipe flow meets at its outlet.
struct DoNothing {
  using Reads = Slots<Gradient<Velocity>>;
  using Tests = Slots<Value<Velocity>>;
  double viscosity;  ///< Pa s
  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(Velocity{}) -= viscosity * (transpose(s.gradient(Velocity{})) * x.normal);
  }
};

/// -strength <dv, rho min(v.n, 0) v>: takes out the energy that flow back through an outlet would bring in.
/// At strength 1/2 the outlet brings in none.
struct Backflow {
  using Reads = Slots<Value<Velocity>>;
  using Tests = Slots<Value<Velocity>>;
  double density;  ///< kg/m^3
  double strength;
  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Vec<dim, T> velocity = s.value(Velocity{});
    const T through = dot(velocity, x.normal);
    if (plain(through) < 0) r.value(Velocity{}) -= (strength * density) * (through * velocity);
  }
};

}  // namespace seam::fluid
