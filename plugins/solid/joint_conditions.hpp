// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "rigid_motion.hpp"
#include "seam/term/fad.hpp"

/// What a joint says of two bodies, as dot products of points and directions that are fixed in them.
namespace seam::solid {

/// Unknowns of two bodies: 0 to 5 translations and rotations of the one that is held, 6 to 11 of the other.
constexpr int both = 12;
/// With which a given motion goes on.
constexpr int the_clock = both;
constexpr int motions = both + 1;
using Number = Fad<motions, double>;
using Direction = Vec<3, double>;
constexpr int other = 6;

/// A point or a direction, and how it changes with each unknown's virtual motion: with translations, and with
/// turns about the axes of the body, and with time.
struct Moving {
  Vec<3, Number> value;
  std::array<Vec<3, Number>, motions> motion{};
};

/// What a joint wants to be zero, m or 1, and how it changes with virtual motions.
struct Condition {
  Number value;
  std::array<Number, motions> motion{};
};

inline Moving operator-(const Moving& a, const Moving& b) {
  Moving r{a.value - b.value};
  for (int k = 0; k < motions; ++k) r.motion[k] = a.motion[k] - b.motion[k];
  return r;
}

inline Condition dot(const Moving& a, const Moving& b) {
  Condition r{seam::dot(a.value, b.value)};
  for (int k = 0; k < motions; ++k)
    r.motion[k] = seam::dot(a.motion[k], b.value) + seam::dot(a.value, b.motion[k]);
  return r;
}

/// That of two directions, from its sine and cosine.
inline Condition angle(const Condition& sine, const Condition& cosine) {
  Condition r{atan2(sine.value, cosine.value)};
  const Number square = sine.value * sine.value + cosine.value * cosine.value;
  for (int k = 0; k < motions; ++k)
    r.motion[k] = (cosine.value * sine.motion[k] - sine.value * cosine.motion[k]) / square;
  return r;
}

inline Moving fixed(const Direction& direction) {
  Moving r;
  for (int i = 0; i < 3; ++i) r.value[i] = direction[i];
  return r;
}

/// A body as conditions see it.
class Partner {
 public:
  /// What is at rest.
  Partner() = default;
  /// @param first number of its unknowns among those of both
  Partner(const RigidUnknowns& unknowns, const RigidPosition& at, int first)
      : first_(first), axis_(unknowns.first_axis()), dimension_(unknowns.exists(2) ? 3 : 2) {
    Vec<3, Number> rotation;
    for (int k = 0; k < 3; ++k) rotation[k] = Number(at.rotation[k]);
    for (int k = axis_; k < 3; ++k) rotation[k] = Number(at.rotation[k], first + 3 + k);
    turn_ = at.turn(rotation);
    angle_ = rotation[2];
    for (int i = 0; i < dimension_; ++i) {
      centre_[i] = at.centre.position[i];
      translation_[i] = Number(at.translation[i], first + i);
    }
  }
  [[nodiscard]] Moving point(const Direction& reference) const {
    const Direction arm = reference - centre_;
    Moving r = direction(arm);
    for (int i = 0; i < 3; ++i) r.value[i] += centre_[i] + translation_[i];
    for (int i = 0; i < dimension_; ++i) r.motion[first_ + i][i] = Number(1);
    return r;
  }
  [[nodiscard]] Moving direction(const Direction& reference) const {
    Vec<3, Number> constant;
    for (int i = 0; i < 3; ++i) constant[i] = Number(reference[i]);
    return direction(constant, Vec<3, Number>{});
  }
  /// @param rate with which the direction goes on in the body
  [[nodiscard]] Moving direction(const Vec<3, Number>& reference, const Vec<3, Number>& rate) const {
    Moving r{turn_ * reference};
    r.motion[the_clock] = turn_ * rate;
    if (dimension_ == 0) return r;
    const Mat<3, 3, Number> lever = -1.0 * (turn_ * skew(reference));
    for (int k = axis_; k < 3; ++k)
      for (int i = 0; i < 3; ++i) r.motion[first_ + 3 + k][i] = lever(i, k);
    return r;
  }
  /// In the plane, rad.
  [[nodiscard]] Condition angle() const {
    Condition r{angle_};
    if (dimension_ != 0) r.motion[first_ + 5] = Number(1);
    return r;
  }

 private:
  int first_ = 0, axis_ = 0, dimension_ = 0;
  Mat<3, 3, Number> turn_ = rotation_tensor(turned(no_rotation, Vec<3, Number>{}));
  Direction centre_{};
  Vec<3, Number> translation_{};
  Number angle_{0.0};
};

/// Two directions normal to one, and to each other.
inline std::array<Direction, 2> normals_of(const Direction& axis) {
  int least = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(axis[i]) < std::abs(axis[least])) least = i;
  Direction start{};
  start[least] = 1;
  Direction first = skew(axis) * start;
  first = (1 / std::sqrt(seam::dot(first, first))) * first;
  return {first, skew(axis) * first};
}

}  // namespace seam::solid
