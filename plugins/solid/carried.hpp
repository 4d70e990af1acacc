// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "rigid_motion.hpp"
#include "seam/constraint/constraint.hpp"
#include "seam/constraint/holds_field.hpp"

namespace seam::solid {

/// Forces on translations and rotations of a rigid body, as RigidUnknowns numbers them.
using Forces = std::array<double, 6>;

/// A constraint that lets something follow a rigid body, and so hands forces on to it.
class Carried {
 public:
  virtual ~Carried() = default;
  /// Null where no rigid body carries it.
  [[nodiscard]] virtual const Field* carrier() const = 0;
  /// What is handed on to the body: what holds that which follows it. Collective.
  [[nodiscard]] virtual Forces handed_on(const HoldsField::Left& left,
                                         const std::vector<const Constraint*>& all) const = 0;
};

/// The sum of what is handed on to a body. Collective.
inline Forces handed_on_to(const Field& body, const HoldsField::Left& left,
                           const std::vector<const Constraint*>& all) {
  Forces sum{};
  for (const Constraint* constraint : all) {
    const auto* carried = dynamic_cast<const Carried*>(constraint);
    if (carried == nullptr || carried->carrier() != &body) continue;
    const Forces forces = carried->handed_on(left, all);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += forces[k];
  }
  return sum;
}

}  // namespace seam::solid
