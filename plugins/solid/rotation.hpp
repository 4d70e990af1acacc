// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "seam/base/diagnostics.hpp"
#include "seam/term/fad.hpp"
#include "seam/term/tensor.hpp"

namespace seam::solid {

template <class T>
Mat<3, 3, T> skew(const Vec<3, T>& a) {
  Mat<3, 3, T> r;
  r(0, 1) = -a[2], r(0, 2) = a[1], r(1, 2) = -a[0];
  r(1, 0) = a[2], r(2, 0) = -a[1], r(2, 1) = a[0];
  return r;
}

/// A rotation: vector, then scalar. Its length does not count.
template <class T>
using Quaternion = Vec<4, T>;
inline constexpr Quaternion<double> no_rotation{{0, 0, 0, 1}};

/// sin(x)/x and (1 - cos x)/x^2 as functions of x^2; series where the quotients lose digits.
template <class T>
std::array<T, 2> rotation_coefficients(const T& square) {
  using std::cos, std::sin, std::sqrt;
  if (plain(square) < 1e-2) {
    const T& s = square;
    return {1.0 - s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0))),
            0.5 * (1.0 - s / 12.0 * (1.0 - s / 30.0 * (1.0 - s / 56.0 * (1.0 - s / 90.0))))};
  }
  const T x = sqrt(square);
  return {sin(x) / x, (1.0 - cos(x)) / square};
}

/// One turn in the axes that another one has turned.
template <class S, class T>
Quaternion<promote<S, T>> product(const Quaternion<S>& first, const Quaternion<T>& then) {
  Quaternion<promote<S, T>> r;
  r[3] = first[3] * then[3];
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    r[3] -= first[i] * then[i];
    r[i] = first[3] * then[i] + first[i] * then[3] + first[j] * then[k] - first[k] * then[j];
  }
  return r;
}

template <class T>
Quaternion<T> inverse(const Quaternion<T>& q) {
  return {{-q[0], -q[1], -q[2], q[3]}};
}

/// What is turned by `start` turns on, by a rotation vector in the turned body's own axes.
template <class S, class T>
Quaternion<T> turned(const Quaternion<S>& start, const Vec<3, T>& turn) {
  // (cos, sin) of half the angle.
  const T square = 0.25 * dot(turn, turn);
  const auto c = rotation_coefficients<T>(square);
  Quaternion<T> on;
  for (int i = 0; i < 3; ++i) on[i] = 0.5 * c[0] * turn[i];
  on[3] = 1.0 - square * c[1];
  return product(start, on);
}

/// What angular velocities about the turned body's own axes make of the rate of a rotation vector that has
/// turned it: the inverse of what exponentials have as their derivative (Iserles et al., Acta Numerica 9,
/// 2000, (2.46)).
inline Mat<3, 3, double> rate_of_rotation_vector(const Vec<3, double>& turn) {
  const double square = dot(turn, turn), half = 0.5 * std::sqrt(square);
  const double factor =
      square < 1e-4 ? (1 + square / 60 * (1 + square / 42)) / 12 : (1 - half / std::tan(half)) / square;
  const Mat<3, 3, double> w = skew(turn);
  return identity<3>() + 0.5 * w + factor * (w * w);
}

template <class T>
Mat<3, 3, T> rotation_tensor(const Quaternion<T>& q) {
  Vec<3, T> v;
  for (int i = 0; i < 3; ++i) v[i] = q[i];
  const Mat<3, 3, T> w = skew(v);
  const T twice = 2.0 / dot(q, q);
  return identity<3>() + (twice * q[3]) * w + twice * (w * w);
}

/// Of less than a whole turn, the one that has led to this orientation in steps by turned(): q and -q are one
/// orientation, half a turn more or less away.
template <class T>
Vec<3, T> counted_rotation_vector(const Quaternion<T>& q) {
  using std::atan2, std::sqrt;
  Vec<3, T> v;
  for (int i = 0; i < 3; ++i) v[i] = q[i];
  const T square = dot(v, v);
  if (plain(q[3]) > 0 && plain(square) < 1e-2 * plain(q[3]) * plain(q[3])) {
    // atan(x)/x by powers of x^2.
    const T s = square / (q[3] * q[3]);
    T sum = T(1.0 / 17);
    for (int odd = 15; odd > 0; odd -= 2) sum = 1.0 / odd - s * sum;
    return (2.0 * sum / q[3]) * v;
  }
  const T size = sqrt(square);
  return (2.0 * atan2(size, q[3]) / size) * v;
}

/// By the shorter way: of at most half a turn, where its direction jumps.
template <class T>
Vec<3, T> rotation_vector(const Quaternion<T>& q) {
  return counted_rotation_vector<T>(plain(q[3]) < 0 ? -q : q);
}

/// Behind a whole turn a rotation vector points the other way.
/// @param before, now at both ends of a step @param what turns, with its place in the scene
/// @throws StepRefused where it has come to that in the step
template <class T>
void require_within_a_turn(const Vec<3, T>& before, const Vec<3, T>& now, const std::string& what) {
  double square = 0;
  for (int i = 0; i < 3; ++i) square += std::pow(plain(now[i]) - plain(before[i]), 2);
  constexpr double turn = 2 * std::numbers::pi;
  if (!(square > turn * turn)) return;
  throw StepRefused(what +
                    " would be turned by more than a whole turn, beyond which in space its moment has no "
                    "direction: let it be stiffer, or damp what turns");
}

/// The unknown `orientation` of a body in space as a kernel's operand: what the orientation was at the start
/// of the step, turned on by how much the `rotation` has changed since, angles about the body's own axes.
/// There is no rotation that it cannot pass.
template <int k>
struct OrientationOf {
  static constexpr int index = k;
  static constexpr int components(int) { return 4; }
};

template <class Trial, class Rotation, class Orientation>
auto orientation_of(const Trial& s, Rotation rotation, Orientation orientation) {
  return turned(s.old_value(orientation), s.value(rotation) - s.old_value(rotation));
}

}  // namespace seam::solid
