// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "rotation.hpp"
#include "seam/assembly/ties.hpp"
#include "seam/constraint/holds_field.hpp"
#include "seam/field/field.hpp"

namespace seam::solid {

/// Where a rigid body is: what all ranks know of its unknowns. In the plane it turns about the third axis.
struct RigidPosition {
  UnknownPlace centre;  ///< its node; component 0
  bool in_space = false;
  std::array<double, 3> translation{}, rotation{};
  /// At the start of the step.
  std::array<double, 3> old_translation{}, old_rotation{};
  Quaternion<double> old_orientation = no_rotation;  ///< in space; in the plane `turn` needs none

  [[nodiscard]] RigidPosition at_start() const {
    RigidPosition start = *this;
    start.translation = old_translation;
    start.rotation = old_rotation;
    return start;
  }
  /// How the unknowns of its rotation change with turns about its axes.
  [[nodiscard]] Mat<3, 3, double> by_turns() const {
    if (!in_space) return identity<3>();
    Vec<3, double> since;
    for (int k = 0; k < 3; ++k) since[k] = rotation[k] - old_rotation[k];
    return rate_of_rotation_vector(since);
  }
  /// What the unknowns of its rotation do to vectors that are fixed in it.
  template <class T>
  [[nodiscard]] Mat<3, 3, T> turn(const Vec<3, T>& unknowns) const {
    Vec<3, T> since = unknowns;
    for (int k = 0; k < 3 && in_space; ++k) since[k] -= T(old_rotation[k]);
    return rotation_tensor(turned(old_orientation, since));
  }
};

/// The unknowns of a `rigid_body` as constraints see them.
class RigidUnknowns {
 public:
  RigidUnknowns() = default;
  /// @throws Error listing the field's unknowns when it is no rigid body
  explicit RigidUnknowns(const Field& field);
  [[nodiscard]] const Field& field() const { return *field_; }
  /// Collective. Says which axes it turns about.
  [[nodiscard]] RigidPosition present(Ties& ties) const;
  /// First axis that it turns about, of 3.
  [[nodiscard]] int first_axis() const { return rotation_.components == 1 ? 2 : 0; }
  /// Number of an unknown, of 6: translations, then rotations about the axes. @pre there is one
  [[nodiscard]] UnknownPlace place(const RigidPosition& at, int number) const;
  /// Whether there is an unknown of this number, and its equation is to be solved. @pre this rank owns the
  /// body
  [[nodiscard]] bool free(int number) const;
  [[nodiscard]] bool exists(int number) const {
    return number < 3 ? number < translation_.components : number - 3 >= first_axis();
  }
  /// What forces leave of the equation of an unknown. @pre this rank owns the body
  [[nodiscard]] double left(const HoldsField::Left& left, int number) const {
    return left(*field_, translation_.block, 0, component(number));
  }
  [[nodiscard]] bool owned() const { return block().space->owned_nodes() > 0; }

 private:
  [[nodiscard]] const Block& block() const { return field_->blocks()[translation_.block]; }
  [[nodiscard]] int component(int number) const {
    return number < 3 ? translation_.offset + number : rotation_.offset + number - 3 - first_axis();
  }
  const Field* field_ = nullptr;
  Field::ComponentRange translation_{}, rotation_{};
  int orientation_ = -1;  ///< first component, in space
};

}  // namespace seam::solid
