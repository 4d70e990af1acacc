// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/physics/conditions.hpp"
#include "seam/scene/expression.hpp"
#include "seam/term/kernel_term.hpp"

/// Terms that bodies share, whatever they are made of: operand 0 is the displacement, integrals are over the
/// reference configuration.
namespace seam {

/// (du, rho0 d2u/dt2)
struct BodyInertia {
  using Reads = Slots<SecondRate<Vector<0>>>;
  using Tests = Slots<Value<Vector<0>>>;
  double density;  ///< kg/m^3 of reference volume
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(Vector<0>{}) += density * s.second_rate(Vector<0>{});
  }
};

/// -factor (du, b(X, t)): a body force (factor rho0) or a dead traction (factor 1).
struct BodyLoad {
  using Reads = Slots<>;
  using Tests = Slots<Value<Vector<0>>>;
  std::vector<Expression> load;
  double factor;
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>&, Test<dim, T, Tests>& r) const {
    Vec<dim, double> value;
    for (int i = 0; i < dim; ++i) value[i] = factor * load[i](x.position.c.data(), dim, x.time);
    r.value(Vector<0>{}) -= value;
  }
};

/// -(du, rho0 b) with the body force, operand 1, interpolated from the nodes.
struct NodalBodyLoad {
  using Reads = Slots<Value<Vector<1>>>;
  using Tests = Slots<Value<Vector<0>>>;
  double density;  ///< kg/m^3 of reference volume
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(Vector<0>{}) -= density * s.value(Vector<1>{});
  }
};

/// Adds the load of a body force per mass. @param densities of the body's regions, kg/m^3 of reference volume
inline void add_body_loads(FieldSetup& setup, const BodyForce& force, const std::string& displacement,
                           const std::vector<double>& densities) {
  if (!force.is_given()) return;
  force.give(setup);
  for (std::size_t k = 0; k < densities.size(); ++k)
    setup.within(static_cast<int>(k), [&] {
      if (force.is_nodal())
        setup.add_cell_term(make_term(NodalBodyLoad{densities[k]}, 1), {displacement, force.key()});
      else
        setup.add_cell_term(make_term(BodyLoad{force.per_mass(), densities[k]}, 1), {displacement});
    });
}

}  // namespace seam
