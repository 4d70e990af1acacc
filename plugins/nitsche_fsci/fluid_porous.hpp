// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "fluid_sided.hpp"
#include "seam/physics/law.hpp"

/// Coupling of a fluid (side 0) with a porous body (side 1) by Nitsche's method.
namespace seam::fsci {

using PoreVelocity = Vector<3>;
using PorePressure = Scalar<4>;

/// The jumps of a manufactured solution, thesis (4.20)-(4.23).
struct PorousJumps {
  Jump flow;         ///< g^n, m/s
  Jump slip;         ///< g^t without its part by friction, m/s
  Jump friction;     ///< the stress whose traction the law of slip does not see, Pa, row by row
  Jump stress;       ///< g_sigma = (sigma_F - sigma_P) n of the mixture: the tensor, Pa
  Jump pore_stress;  ///< g_sigma^n = n.sigma_F n + p_P: the tensor, Pa

  template <int dim, class G>
  [[nodiscard]] static Vec<dim, G> traction(const Jump& tensor, const Point<dim, G>& x) {
    Mat<dim, dim, G> difference;
    difference.c = tensor.at<dim * dim>(x).c;
    return difference * x.normal;
  }
};

/// What fluid in front of a porous surface and fluid in its pores miss of moving together, with w = v_P -
/// du/dt, out of the fluid:
///   across: [v - du/dt - phi w - g^n] . n, thesis (2.63);
///   along:  P [v - du/dt - beta phi w - g^t], (2.64) without friction.
struct PorousMismatch {
  using Reads = Slots<Value<Velocity>, Rate<Displacement>, Gradient<Displacement>, Value<PoreVelocity>,
                      Value<PorePressure>>;
  std::shared_ptr<const Law> pores;
  PorousJumps jumps;
  bool saffmann;  ///< beta = 0 (Saffmann), else 1 (Beavers and Joseph)

  /// Of the pores: porosity, and a third of the trace of the permeability, m^2.
  template <int dim, class T, class S>
  [[nodiscard]] std::array<T, 2> of_pores(const S& s) const {
    constexpr int n = dim * dim + 1;
    std::array<T, n> state;
    const Mat<dim, dim, T> gradient = s.gradient(Displacement{});
    std::copy(gradient.c.begin(), gradient.c.end(), state.begin());
    state[n - 1] = s.value(PorePressure{});
    return evaluate<2, n, T>(*pores, dim, state);
  }
  /// Both together as a vector.
  template <int dim, class T, class G, class S>
  [[nodiscard]] Vec<dim, T> operator()(const Point<dim, G>& x, const S& s, const T& porosity) const {
    const Vec<dim, T> skeleton = s.rate(Displacement{});
    const Vec<dim, T> relative = s.value(Velocity{}) - skeleton;
    const Vec<dim, T> seepage = porosity * (s.value(PoreVelocity{}) - skeleton);
    Vec<dim, T> along = relative;
    if (!saffmann) along -= seepage;
    along -= jumps.slip.at<dim>(x);
    Vec<dim, T> across = relative - seepage;
    across -= jumps.flow.at<dim>(x);
    return along + dot(across - along, x.normal) * x.normal;
  }
};

/// Thesis (4.1) with (4.5), or (4.4) where the tangential penalty is infinite; (4.1) is printed damaged. The
/// fluid is tied to the mean of skeleton and fluid in the pores (`tie`, with the slip length
/// sqrt(tr k/3)/alpha): with its r, of which only what is normal reaches the pores,
///
///   -<du, r + g_sigma> - <dv_P, (r.n + g_sigma^n) n>.
///
/// That fluid enters the pores is a term of the porous body's own balance of mass.
struct FluidPorous {
  using Reads = Slots<Value<Velocity>, Gradient<Velocity>, Value<Pressure>, Rate<Displacement>,
                      Gradient<Displacement>, Value<PoreVelocity>, Value<PorePressure>>;
  using Tests =
      Slots<Value<Velocity>, Gradient<Velocity>, Value<Pressure>, Value<Displacement>, Value<PoreVelocity>>;
  Flow flow;
  PorousMismatch mismatch;
  double alpha;  ///< of Beavers and Joseph; infinite: no slip
  Ties ties;

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    using std::sqrt;
    const auto [porosity, permeability] = mismatch.of_pores<dim, T>(s);
    const Vec<dim, T> jump = mismatch.operator()<dim, T, G>(x, s, porosity);
    const Slip::Ratio<T> slip{T((1 / alpha) * sqrt(permeability)), T(1.0)};
    const PorousJumps& jumps = mismatch.jumps;
    const Vec<dim, G> known = PorousJumps::traction<dim, G>(jumps.friction, x);
    const Vec<dim, T> traction = tie<dim, T, G>(flow, ties, x, s, jump, slip, &known, r);
    const Vec<dim, G>& n = x.normal;
    r.value(Displacement{}) -= traction;
    r.value(Displacement{}) -= PorousJumps::traction<dim, G>(jumps.stress, x);
    r.value(PoreVelocity{}) -=
        (dot(traction, n) + dot(PorousJumps::traction<dim, G>(jumps.pore_stress, x), n)) * n;
  }
};

/// A part of the mismatch, or the speed at which fluid seeps into the body, or at which the body moves into
/// it (out of the fluid), m/s.
struct PorousMeasure {
  using Reads = PorousMismatch::Reads;
  enum class Of { across, along, seepage, body };
  static constexpr int values(int) { return 1; }
  PorousMismatch mismatch;
  Of of;
  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    const double porosity = mismatch.of_pores<dim, double>(s)[0];
    const Vec<dim, double> skeleton = s.rate(Displacement{});
    *value = dot(skeleton, x.normal);
    if (of == Of::body) return;
    if (of == Of::seepage) {
      *value = porosity * (dot(s.value(PoreVelocity{}), x.normal) - *value);
      return;
    }
    const Vec<dim, double> both = mismatch.operator()<dim, double, double>(x, s, porosity);
    *value = dot(both, x.normal);
    if (of == Of::along) *value = std::sqrt(std::max(0.0, dot(both, both) - *value * *value));
  }
};

}  // namespace seam::fsci
