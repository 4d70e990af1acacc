// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>

#include "seam/physics/law.hpp"
#include "seam/term/kernel_term.hpp"

/// What porous bodies that are tied have to do with each other besides: their pores meet, or are sealed. Area
/// vectors are those of the deformed surface, a = C N, with the cofactor C of the deformation gradient. The
/// coupling brings the outflow <dp, phi a.w> that the bodies' own mass terms have on their whole surface (w
/// relative to the skeleton).
namespace seam::mortar {

/// The porosity of a body. @param law "pores"
template <int dim, class T>
T porosity(const Law& law, const Mat<dim, dim, T>& gradient, const T& pressure) {
  constexpr int n = dim * dim;
  std::array<T, n + 1> at;
  std::copy(gradient.c.begin(), gradient.c.end(), at.begin());
  at[n] = pressure;
  return evaluate<2, n + 1, T>(law, dim, at)[0];
}

template <int dim, class T>
Vec<dim, T> area_at(const Mat<dim, dim, T>& gradient, const Vec<dim, double>& normal) {
  Mat<dim, dim, T> f = gradient;
  for (int i = 0; i < dim; ++i) f(i, i) += 1.0;
  return cofactor(f) * normal;
}

/// What leaves one body enters the other, by the pressure q in the pores between them:
///
///   <dv - dv', q a> + <dp, phi a.w> - <dp', phi' a.w'> + <dq, phi a.w - phi' a.w'>.
///
/// With dq = dp = dp' = 1 the fluid in both together stays, to rounding.
struct TiedPores {
  using u = Vector<0>;
  using v = Vector<1>;
  using p = Scalar<2>;
  using q = Scalar<3>;
  using u2 = Vector<4>;
  using v2 = Vector<5>;
  using p2 = Scalar<6>;
  using Reads =
      Slots<Gradient<u>, Rate<u>, Value<v>, Value<p>, Value<q>, Gradient<u2>, Rate<u2>, Value<v2>, Value<p2>>;
  using Tests = Slots<Value<v>, Value<p>, Value<q>, Value<v2>, Value<p2>>;
  std::shared_ptr<const Law> own, other;  ///< "pores"

  /// phi a.w out of the slave.
  template <int dim, class T>
  [[nodiscard]] T outflow(const Vec<dim, T>& area, const Trial<dim, T, Reads>& s) const {
    return porosity<dim, T>(*own, s.gradient(u{}), s.value(p{})) * dot(area, s.value(v{}) - s.rate(u{}));
  }
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Vec<dim, T> area = area_at<dim, T>(s.gradient(u{}), x.normal);
    const T out = outflow<dim, T>(area, s);
    const T in =
        porosity<dim, T>(*other, s.gradient(u2{}), s.value(p2{})) * dot(area, s.value(v2{}) - s.rate(u2{}));
    r.value(v{}) += s.value(q{}) * area;
    r.value(v2{}) -= s.value(q{}) * area;
    r.value(p{}) += out;
    r.value(p2{}) -= in;
    r.value(q{}) += out - in;
  }
};

/// phi a.w out of the slave, m^3/s per m^2 at rest.
struct Seeping {
  using Reads = TiedPores::Reads;
  static constexpr int values(int) { return 1; }
  TiedPores pores;
  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    *value = pores.outflow<dim, double>(area_at<dim, double>(s.gradient(TiedPores::u{}), x.normal), s);
  }
};

/// Nothing seeps through: <dv, p a>, a out of the body, and no outflow.
struct SealedPores {
  using u = Vector<0>;
  using v = Vector<1>;
  using p = Scalar<2>;
  using Reads = Slots<Gradient<u>, Value<p>>;
  using Tests = Slots<Value<v>>;
  double outward;  ///< 1 of the body on side 0, whose normals these are, -1 of the other one

  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(v{}) += (outward * s.value(p{})) * area_at<dim, T>(s.gradient(u{}), x.normal);
  }
};

}  // namespace seam::mortar
