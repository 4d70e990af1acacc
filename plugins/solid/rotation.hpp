// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "seam/term/tensor.hpp"

namespace seam::solid {

template <class T>
Mat<3, 3, T> skew(const Vec<3, T>& a) {
  Mat<3, 3, T> r;
  r(0, 1) = -a[2], r(0, 2) = a[1], r(1, 2) = -a[0];
  r(1, 0) = a[2], r(2, 0) = -a[1], r(2, 1) = a[0];
  return r;
}

/// sin(x)/x, (1 - cos x)/x^2 and (x - sin x)/x^3 as functions of x^2; series where the quotients lose digits.
template <class T>
std::array<T, 3> rotation_coefficients(const T& square) {
  using std::cos, std::sin, std::sqrt;
  if (plain(square) < 1e-2) {
    const T& s = square;
    return {1.0 - s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0))),
            0.5 * (1.0 - s / 12.0 * (1.0 - s / 30.0 * (1.0 - s / 56.0 * (1.0 - s / 90.0)))),
            (1.0 / 6) * (1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0 * (1.0 - s / 110.0))))};
  }
  const T x = sqrt(square);
  return {sin(x) / x, (1.0 - cos(x)) / square, (x - sin(x)) / (x * square)};
}

/// Rodrigues' rotation tensor of the rotation vector.
template <class T>
Mat<3, 3, T> rotation_tensor(const Vec<3, T>& phi) {
  const auto c = rotation_coefficients<T>(dot(phi, phi));
  const Mat<3, 3, T> w = skew(phi);
  return identity<3>() + c[0] * w + c[1] * (w * w);
}

/// Spatial angular velocity = tangent (phi) * d(phi)/dt.
template <class T>
Mat<3, 3, T> rotation_tangent(const Vec<3, T>& phi) {
  const auto c = rotation_coefficients<T>(dot(phi, phi));
  const Mat<3, 3, T> w = skew(phi);
  return identity<3>() + c[1] * w + c[2] * (w * w);
}

}  // namespace seam::solid
