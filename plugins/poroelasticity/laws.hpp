// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "seam/physics/hyperelastic.hpp"
#include "seam/term/kernel_term.hpp"

/// What the skeleton of a porous body answers to pore pressure and deformation.
namespace seam::poro {

/// How much of a body's volume is fluid: the relation (2.51) of porosity, pore pressure and change of volume
/// with the energies (2.48) of the skeleton's own material and (2.49), which keeps pores open.
struct Porosity {
  double initial;      ///< phi_0
  bool given;          ///< it stays phi_0 whatever happens; bulk and opening are not used
  double bulk = 0;     ///< kappa^P, Pa
  double opening = 0;  ///< eta^P, Pa

  /// J phi: fluid volume per reference volume. With the solid's share S = J (1 - phi), (2.51) reads
  /// a = kappa/S - eta/(J - S) with a = p + kappa/(1 - phi_0) - eta/phi_0: a quadratic equation.
  template <class T>
  [[nodiscard]] T fluid_volume(const T& jacobian, const T& pressure) const {
    using std::sqrt;
    if (given) return initial * jacobian;
    const T a = pressure + (bulk / (1 - initial) - opening / initial);
    const T aj = a * jacobian, difference = aj - bulk + opening;
    const T root = sqrt(difference * difference + 4 * bulk * opening);
    return jacobian - 2 * bulk * jacobian / (aj + bulk + opening + root);
  }
  /// What pore pressure and (2.49) add to the stress, as a pressure: p - eta (1/phi_0 - 1/(J phi)), Pa.
  template <class T>
  [[nodiscard]] T back_pressure(const T& fluid_volume, const T& pressure) const {
    if (given || opening == 0) return pressure;
    return pressure - opening * (1 / initial - 1 / fluid_volume);
  }
};

/// How hardly fluid passes through the skeleton: the inverse of the material permeability K of (2.45), 1/m^2.
template <int dim>
struct Resistance {
  Mat<dim, dim, double> inverse_permeability;  ///< at the initial porosity
  bool kozeny_carman;                          ///< K changes with J phi as in (4.26)
  double initial_porosity;

  template <class T>
  [[nodiscard]] Vec<dim, T> operator()(const T& fluid_volume, const Vec<dim, T>& flow) const {
    const Vec<dim, T> result = inverse_permeability * flow;
    if (!kozeny_carman) return result;
    return T(1 / opened(fluid_volume)) * result;
  }
  /// What K has become, as a multiple of what it was.
  template <class T>
  [[nodiscard]] T opened(const T& fluid_volume) const {
    if (!kozeny_carman) return T(1.0);
    const auto shape = [](const auto& m) { return m * m * m / (1 - m * m); };
    return T(shape(fluid_volume) / shape(initial_porosity));
  }
};

/// How hardly fluid moves through the undeformed pores in a step, Pa s/m^2: resistance and inertia, thesis
/// (2.124).
struct PoreScale {
  double resistance;  ///< mu phi_0/K_0, Pa s/m^2
  double density;     ///< of the fluid, kg/m^3
  template <int dim>
  [[nodiscard]] double operator()(const Point<dim>& x) const {
    constexpr double c_t = 1.0 / 12;
    return resistance + (x.step > 0 ? c_t * density / (x.theta * x.step) : 0.0);
  }
};

/// What the fluid in the pores is, and what holds it back.
struct PoreFlow {
  double density;    ///< rho_F, kg/m^3
  double viscosity;  ///< mu, Pa s
  Porosity porosity;
  bool kozeny_carman;
  std::array<double, 9> inverse_permeability;  ///< [3][3], 1/m^2, of which dimension x dimension count

  template <int dim>
  [[nodiscard]] Resistance<dim> resistance() const {
    Resistance<dim> result{{}, kozeny_carman, porosity.initial};
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) result.inverse_permeability(i, j) = inverse_permeability[i * 3 + j];
    return result;
  }
  [[nodiscard]] PoreScale scale(int dimension) const {
    double trace = 0;
    for (int d = 0; d < dimension; ++d) trace += inverse_permeability[d * 3 + d];
    return {viscosity * porosity.initial * trace / dimension, density};
  }
  /// mu phi C K^-1 C^T w, Pa/m of reference volume: what the skeleton takes from the fluid, over phi.
  template <int dim, class T>
  [[nodiscard]] Vec<dim, T> drag(const Deformation<dim, T>& d, const T& fluid_volume,
                                 const Vec<dim, T>& w) const {
    const T phi = fluid_volume / d.invariant[2];
    const Vec<dim, T> flow = transpose(d.cofactor) * w;
    return (viscosity * phi) * (d.cofactor * resistance<dim>()(fluid_volume, flow));
  }
};

/// What couplings may know of the pores: the law "pores".
struct PoresFormula {
  PoreFlow flow;
  std::array<double, 9> permeability;  ///< [3][3], m^2; in the plane its out-of-plane entry counts, too
  static constexpr int arguments(int dim) { return dim * dim + 1; }
  static constexpr int values(int) { return 2; }

  template <int dim, class T>
  [[nodiscard]] std::array<T, 2> at(const std::array<T, dim * dim + 1>& x) const {
    Mat<dim, dim, T> gradient;
    std::copy_n(x.begin(), dim * dim, gradient.c.begin());
    const Deformation<dim, T> d(gradient);
    const T& j = d.invariant[2];
    const T m = flow.porosity.fluid_volume(j, x[dim * dim]);
    // tr(F K F^T)
    T trace = T(dim == 2 ? permeability[8] : 0.0);
    for (int i = 0; i < dim; ++i)
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b) trace += permeability[a * 3 + b] * (d.f(i, a) * d.f(i, b));
    return {T(m / j), T(flow.resistance<dim>().opened(m) * trace / (3 * j))};
  }
};

/// The stress of the mixture: the law "mixture".
struct MixtureFormula {
  PotentialPointer skeleton;
  Porosity porosity;
  static constexpr int arguments(int dim) { return dim * dim + 1; }
  static constexpr int values(int dim) { return dim * dim; }

  template <int dim, class T>
  [[nodiscard]] std::array<T, dim * dim> at(const std::array<T, dim * dim + 1>& x) const {
    Mat<dim, dim, T> gradient;
    std::copy_n(x.begin(), dim * dim, gradient.c.begin());
    return stress<dim, T>(Deformation<dim, T>(gradient), x[dim * dim]).c;
  }
  /// P_skeleton - p' C
  template <int dim, class T>
  [[nodiscard]] Mat<dim, dim, T> stress(const Deformation<dim, T>& d, const T& pressure) const {
    const T m = porosity.fluid_volume(d.invariant[2], pressure);
    return d.stress(*skeleton) - porosity.back_pressure(m, pressure) * d.cofactor;
  }
};

/// The stress of the skeleton without what fills its pores: the law "skeleton".
struct SkeletonStress {
  PotentialPointer skeleton;
  template <int dim, class T>
  [[nodiscard]] Mat<dim, dim, T> stress(const Mat<dim, dim, T>& displacement_gradient) const {
    return Deformation<dim, T>(displacement_gradient).stress(*skeleton);
  }
};

}  // namespace seam::poro
