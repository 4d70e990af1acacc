// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "materials.hpp"
#include "quantities.hpp"
#include "seam/linear/mumps_solver.hpp"
#include "seam/mesh/input/grid.hpp"
#include "seam/record/error_norms.hpp"
#include "seam/solve/newton.hpp"

/// A hyperelastic body whose exact solution is known: the body force follows from it by differentiation.
namespace seam::test {

/// u_i(X, t), as a template on the scalar type and as text for boundary values and error norms.
struct Wave {
  double amplitude = 0.1;
  double frequency = 0;  ///< of cos(frequency t); 0: constant in time
  bool linear = false;   ///< linear in space, so that only the error in time remains

  template <int dim, class T>
  Vec<dim, T> operator()(const Vec<dim, T>& x, const T& t) const {
    using std::cos, std::sin;
    constexpr double pi = 3.14159265358979323846;
    const T g = amplitude * cos(frequency * t);
    Vec<dim, T> u;
    for (int i = 0; i < dim; ++i)
      u[i] = linear ? g * x[i] + 0.5 * (g * x[(i + 1) % dim])
                    : g * (sin(pi * x[i] + 0.3) * cos(pi * x[(i + 1) % dim]));
    return u;
  }
  [[nodiscard]] std::vector<Expression> text(int dim) const;
  [[nodiscard]] std::vector<Expression> gradient_text(int dim) const;
  [[nodiscard]] std::vector<Expression> rate_text(int dim) const;
};

/// -(du, rho d2u/dt2 - Div P(F)) at the exact solution.
struct ManufacturedLoad {
  using Reads = Slots<>;
  using Tests = Slots<Value<solid::u>>;
  Wave exact;
  PotentialPointer material;
  double density;
  bool dynamic;

  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>&, Test<dim, T, Tests>& r) const {
    using Inner = Fad<dim>;
    using Outer = Fad<dim, Inner>;
    Vec<dim, Outer> position;
    for (int i = 0; i < dim; ++i) position[i] = Outer(Inner(x.position[i], i), i);
    const auto displacement = exact.operator()<dim, Outer>(position, Outer(Inner(x.time)));
    Mat<dim, dim, Inner> gradient;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) gradient(i, j) = displacement[i].d[j];
    const Deformation<dim, Inner> d(gradient);
    const auto stress = d.stress(seam::gradient<3>(*material, d.invariant));
    Vec<dim, double> load;
    for (int i = 0; i < dim; ++i) {
      for (int j = 0; j < dim; ++j) load[i] -= stress(i, j).d[j];
      if (dynamic) load[i] += density * acceleration<dim>(x)[i];
    }
    r.value(solid::u{}) -= load;
  }

 private:
  template <int dim>
  [[nodiscard]] Vec<dim, double> acceleration(const Point<dim>& x) const {
    using Second = Fad<1, Fad<1>>;
    Vec<dim, Second> position;
    for (int i = 0; i < dim; ++i) position[i] = Second(Fad<1>(x.position[i]));
    const auto u = exact.operator()<dim, Second>(position, Second(Fad<1>(x.time, 0), 0));
    Vec<dim, double> a;
    for (int i = 0; i < dim; ++i) a[i] = u[i].d[0].d[0];
    return a;
  }
};

struct Body {
  CellType cell = CellType::quadrilateral;
  int order = 1;
  int cells = 4;  ///< per direction
  bool mixed = false;
  bool dynamic = false;
  Wave exact;
  double poisson = 0.3;
  int geometry_order = 1;
};

/// A problem on the unit square or cube with the exact solution on its whole boundary.
std::unique_ptr<Problem> make_problem(const Body& body);

/// Marches to `end` in `steps` steps (one static step without dynamics) and returns the error norms there.
ErrorNorms solve(const Body& body, double theta, double end, int steps);

}  // namespace seam::test
