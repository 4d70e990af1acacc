// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "balance.hpp"

namespace seam::manufactured {

/// Vortices that decay, thesis (3.42)-(3.44) and (4.12)-(4.16), with the sign of the displacement that makes
/// its rate what the text says. Amplitudes are largest velocities, m/s, at the start.
struct Vortices {
  double wave_number;  ///< B, 1/m
  double decay;        ///< 1/s

  template <class T>
  [[nodiscard]] Vec<2, T> swirl(const Event<T>& e) const {
    using std::cos, std::sin;
    const T x = wave_number * e[0], y = wave_number * e[1];
    return {-(cos(x) * sin(y)), sin(x) * cos(y)};
  }
  template <class T>
  [[nodiscard]] Vec<2, T> velocity(double amplitude, const Event<T>& e) const {
    using std::exp;
    return T(amplitude * exp(-decay * e[2])) * swirl(e);
  }
  template <class T>
  [[nodiscard]] T pressure(double density, const Event<T>& e) const {
    using std::cos, std::exp;
    return (-0.25 * density) * exp(-2 * decay * e[2]) *
           (cos(2 * wave_number * e[0]) + cos(2 * wave_number * e[1]));
  }
  template <class T>
  [[nodiscard]] Vec<2, T> displacement(double amplitude, const Event<T>& e) const {
    using std::expm1;
    // expm1: 1 - exp would lose five digits.
    return T((-amplitude / decay) * expm1(-decay * e[2])) * swirl(e);
  }
};

}  // namespace seam::manufactured
