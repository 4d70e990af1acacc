// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/physics/physics.hpp"
#include "seam/plugin/registry.hpp"

namespace seam::solid {

/// The points of a rigid body, as a mesh that cuts others and touches: a displacement without equations of
/// its own, which the constraint `rigid` ties to the body's motion.
class RigidSurface final : public Physics {
 public:
  explicit RigidSurface(const Parameters& parameters)
      : order_(static_cast<int>(parameters.integer("order"))) {}
  static Schema schema();
  [[nodiscard]] std::vector<Unknown> unknowns(int dimension) const override {
    return {{"displacement", dimension, order_, 1, "m", UnknownRole::motion}};
  }
  void build(FieldSetup& setup) const override;
  [[nodiscard]] std::string displacement() const override { return "displacement"; }

 private:
  int order_;
};

/// Registers the constraint `rigid`.
void declare_rigid(Registry& registry);

}  // namespace seam::solid
