// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "conditions.hpp"
#include "seam/physics/stress_law.hpp"

namespace seam::fsci {

/// The body's traction sigma n = P F^T n / J on a surface with normal n, per current area.
/// @param gradient of the displacement
template <int dim, class T, class G>
Vec<dim, T> body_traction(const Law& law, const Mat<dim, dim, T>& gradient, const Vec<dim, G>& normal) {
  Mat<dim, dim, T> f = gradient;
  for (int i = 0; i < dim; ++i) f(i, i) += 1.0;
  const T volume = determinant(f);
  const Vec<dim, T> pulled = transpose(f) * normal;
  return (1.0 / volume) * (stress<dim, T>(law, gradient) * pulled);
}

/// The traction between fluid and body is the body's, thesis (3.29), (3.30). With n out of the fluid,
/// n_S = -n and J = v - du/dt - g_v:
///
///   <dv - du, sigma_S n_S> - <dv, g_sigma> - xi theta dt <D_du[sigma_S n_S], J>
///   + gamma_0 theta dt lambda_e <dv - du, J>.
///
/// D_du leaves the normal as it is (Remark 3.9). lambda_e, of the body's cell, is Point::constant: see
/// TraceEigenvalue.
struct SolidSided {
  using Reads = Slots<Value<Velocity>, Rate<Displacement>, Gradient<Displacement>>;
  using Tests = Slots<Value<Velocity>, Value<Displacement>, Gradient<Displacement>>;
  std::shared_ptr<const Law> law;
  Jumps jumps;
  double adjoint;  ///< xi: +1 skew-symmetric, -1 symmetric, 0 none
  double penalty;  ///< gamma_0

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const double scale = x.theta * x.step;
    const Vec<dim, G> normal = -x.normal;
    const Mat<dim, dim, T> gradient = s.gradient(Displacement{});
    const Vec<dim, T> jump = jumps.mismatch<dim, T>(x, s.value(Velocity{}), s.rate(Displacement{}));
    const Vec<dim, T> resistance = (penalty * scale * x.constant[0]) * jump;
    if (adjoint == 0) {
      add_traction<dim, T>(x, body_traction<dim, T>(*law, gradient, normal) + resistance, r);
      return;
    }
    // The derivative that tests: one more level of differentiation, with respect to the gradient alone.
    constexpr int n = dim * dim;
    using S = Fad<n, T>;
    Mat<dim, dim, S> varied;
    for (int k = 0; k < n; ++k) varied.c[k] = S(gradient.c[k], k);
    const Vec<dim, S> force = body_traction<dim, S>(*law, varied, normal);
    Vec<dim, T> traction;
    Mat<dim, dim, T> tested;
    for (int i = 0; i < dim; ++i) {
      traction[i] = force[i].v;
      for (int k = 0; k < n; ++k) tested.c[k] += jump[i] * force[i].d[k];
    }
    add_traction<dim, T>(x, traction + resistance, r);
    r.gradient(Displacement{}) -= (adjoint * scale) * tested;
  }

 private:
  template <int dim, class T, class G>
  void add_traction(const Point<dim, G>& x, const Vec<dim, T>& traction, Test<dim, T, Tests>& r) const {
    r.value(Velocity{}) += traction;
    r.value(Velocity{}) -= jumps.traction(x);
    r.value(Displacement{}) -= traction;
  }
};

}  // namespace seam::fsci
