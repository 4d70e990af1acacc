// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scales.hpp"
#include "seam/term/moving_mesh.hpp"

namespace seam::fluid {

/// One fluid on two meshes that meet: side 0 on a fixed mesh out of which the patch is cut, side 1 on a patch
/// that moves. Thesis (3.37) with n out of side 0, [a] = a_0 - a_1, {a} = (1 - kappa) a_0 + kappa a_1:
///
///   -<[dv], {sigma} n> - <{dp}, n.[v]> + xi <{2 mu eps(dv)} n, [v]> + gamma Phi/h_Gamma <[dv], [v]>
///   + rho/2 <|m| [dv] - m (dv_0 + dv_1), [v]>,   m = ((v_0 + v_1)/2 - w) . n,
///
/// where the patch moves with w; in the source m has no w, with which alone no energy comes in through the
/// interface. At xi = +1 stable for every gamma and kappa.
struct FluidFluid {
  using PatchVelocity = Vector<2>;
  using PatchPressure = Scalar<3>;
  using PatchMesh = Vector<4>;
  using Reads = Slots<Value<Velocity>, Gradient<Velocity>, Value<Pressure>, Value<PatchVelocity>,
                      Gradient<PatchVelocity>, Value<PatchPressure>, Gradient<PatchMesh>, Rate<PatchMesh>>;
  using Tests = Slots<Value<Velocity>, Gradient<Velocity>, Value<Pressure>, Value<PatchVelocity>,
                      Gradient<PatchVelocity>, Value<PatchPressure>>;
  Flow flow;
  double patch_share;  ///< kappa: weight of the patch's stress
  double adjoint;      ///< xi: +1 skew-symmetric, -1 symmetric, 0 none
  double penalty;      ///< gamma
  bool upwind;         ///< the terms with m

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    using std::abs;
    const Vec<dim, G>& n = x.normal;
    Mat<dim, dim, T> f = s.gradient(PatchMesh{});
    for (int i = 0; i < dim; ++i) f(i, i) += 1.0;
    const Mat<dim, dim, T> inverse = seam::inverse(f);
    const double own = 1 - patch_share;
    const Vec<dim, T> here = s.value(Velocity{}), there = s.value(PatchVelocity{});
    const Vec<dim, T> jump = here - there;

    Vec<dim, T> traction =
        own * (stress<dim, T>(flow.viscosity, s.gradient(Velocity{}), s.value(Pressure{})) * n);
    const Mat<dim, dim, T> gradient = s.gradient(PatchVelocity{}) * inverse;
    traction += patch_share * (stress<dim, T>(flow.viscosity, gradient, s.value(PatchPressure{})) * n);
    const Vec<dim, T> middle = 0.5 * (here + there);
    const T phi = resistance<dim, T>(flow, x.trace_size, x, middle);
    const Vec<dim, T> force = (penalty / x.trace_size) * phi * jump - traction;
    r.value(Velocity{}) += force;
    r.value(PatchVelocity{}) -= force;
    if (upwind) {
      const T through = (0.5 * flow.density) * dot(middle - s.rate(PatchMesh{}), n);
      r.value(Velocity{}) += (abs(through) - through) * jump;
      r.value(PatchVelocity{}) -= (abs(through) + through) * jump;
    }
    const T gap = dot(jump, n);
    r.value(Pressure{}) -= own * gap;
    r.value(PatchPressure{}) -= patch_share * gap;
    if (adjoint == 0) return;
    const Mat<dim, dim, T> tested = (2 * adjoint * flow.viscosity) * sym(outer(jump, n));
    r.gradient(Velocity{}) += own * tested;
    r.gradient(PatchVelocity{}) += patch_share * (tested * transpose(inverse));
  }
};

/// [v], m/s: what the two velocities differ by.
struct FluidJump {
  using PatchVelocity = Vector<1>;
  using Reads = Slots<Value<Velocity>, Value<PatchVelocity>>;
  static constexpr int values(int dim) { return dim; }
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    const Vec<dim, double> jump = s.value(Velocity{}) - s.value(PatchVelocity{});
    std::copy(jump.c.begin(), jump.c.end(), value);
  }
};

/// v.n out of side 0 less the speed at which the interface moves that way, m/s: fluid that passes over to the
/// patch.
struct FluidTransfer {
  using PatchMesh = Vector<1>;
  using Reads = Slots<Value<Velocity>, Rate<PatchMesh>>;
  static constexpr int values(int) { return 1; }
  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    *value = dot(s.value(Velocity{}) - s.rate(PatchMesh{}), x.normal);
  }
};

}  // namespace seam::fluid
