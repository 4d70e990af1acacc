// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "seam/term/fad.hpp"
#include "seam/term/tensor.hpp"

/// What analytic fields must be loaded with to solve the equations of a fluid and of a body. Fields are
/// templates on the scalar type of place and time; derivatives come from differentiation types, so that
/// nothing but the fields themselves is typed by hand.
namespace seam::manufactured {

/// Place and time in the plane: x, y, t.
template <class T>
using Event = std::array<T, 3>;
using Once = Fad<3>;
using Twice = Fad<3, Once>;

inline Event<Once> once(const double* x, double t) { return {Once(x[0], 0), Once(x[1], 1), Once(t, 2)}; }
inline Event<Twice> twice(const double* x, double t) {
  return {Twice(Once(x[0], 0), 0), Twice(Once(x[1], 1), 1), Twice(Once(t, 2), 2)};
}

/// First and second derivative by time of fields that are differentiated twice.
template <int dim>
void put_rates(const Fad<dim + 1, Fad<dim + 1>>& field, double* rate, double* second_rate) {
  *rate = field.d[dim].v;
  *second_rate = field.d[dim].d[dim];
}
template <int dim>
void put_rates(const Vec<dim, Fad<dim + 1, Fad<dim + 1>>>& field, double* rate, double* second_rate) {
  for (int i = 0; i < dim; ++i) put_rates<dim>(field[i], rate + i, second_rate + i);
}

/// Of a vector whose entries are differentiated by place and time.
template <int dim, class T>
Mat<dim, dim, T> space_gradient(const Vec<dim, Fad<dim + 1, T>>& field) {
  Mat<dim, dim, T> gradient;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) gradient(i, j) = field[i].d[j];
  return gradient;
}

/// Row by row: d T_ij / dx_j.
template <int dim>
Vec<dim, double> divergence(const Mat<dim, dim, Fad<dim + 1>>& tensor) {
  Vec<dim, double> result;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) result[i] += tensor(i, j).d[j];
  return result;
}

/// An incompressible Newtonian fluid: sigma = -p I + 2 mu eps(v).
struct Newtonian {
  double density, viscosity;
  template <class T>
  [[nodiscard]] Mat<2, 2, T> stress(const Mat<2, 2, T>& velocity_gradient, const T& pressure) const {
    Mat<2, 2, T> sigma = (2 * viscosity) * sym(velocity_gradient);
    for (int i = 0; i < 2; ++i) sigma(i, i) -= pressure;
    return sigma;
  }
  /// Body force per mass, thesis (3.45): dv/dt + grad(v) v - div(sigma)/rho.
  [[nodiscard]] Vec<2, double> force(const Vec<2, Twice>& velocity, const Once& pressure) const {
    const Mat<2, 2, Once> gradient = space_gradient(velocity);
    Vec<2, double> force = (-1 / density) * divergence(stress(gradient, pressure));
    for (int i = 0; i < 2; ++i) {
      force[i] += velocity[i].d[2].v;
      for (int j = 0; j < 2; ++j) force[i] += gradient(i, j).v * velocity[j].v.v;
    }
    return force;
  }
};

/// The neo-Hookean solid of thesis (2.17), plane strain: S = 2c (I - J^(-2 beta) C^-1).
struct NeoHookean {
  double density, c, beta;
  NeoHookean(double rho, double young, double poisson)
      : density(rho), c(young / (4 * (1 + poisson))), beta(poisson / (1 - 2 * poisson)) {}
  /// First Piola-Kirchhoff stress F S = 2c (F - J^(-2 beta) F^-T).
  template <int dim, class T>
  [[nodiscard]] Mat<dim, dim, T> piola(const Mat<dim, dim, T>& displacement_gradient) const {
    using std::pow;
    const Mat<dim, dim, T> f = displacement_gradient + identity<dim>();
    const T volume = determinant(f);
    const T shrink = pow(volume, -2 * beta);
    return (2 * c) * (f - shrink * transpose(inverse(f)));
  }
  [[nodiscard]] Mat<2, 2, double> cauchy(const Mat<2, 2, double>& displacement_gradient) const {
    const Mat<2, 2, double> f = displacement_gradient + identity<2>();
    return (1 / determinant(f)) * (piola(displacement_gradient) * transpose(f));
  }
  /// Body force per mass, thesis (3.46): d2u/dt2 - Div(P)/rho_0.
  [[nodiscard]] Vec<2, double> force(const Vec<2, Twice>& displacement) const {
    Vec<2, double> force = (-1 / density) * divergence(piola(space_gradient(displacement)));
    for (int i = 0; i < 2; ++i) force[i] += displacement[i].d[2].d[2];
    return force;
  }
};

}  // namespace seam::manufactured
