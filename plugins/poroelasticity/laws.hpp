// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "seam/term/fad.hpp"
#include "seam/term/tensor.hpp"

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

}  // namespace seam::poro
