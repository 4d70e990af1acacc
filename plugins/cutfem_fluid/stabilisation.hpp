// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "face_jumps.hpp"
#include "moving.hpp"
#include "seam/physics/physics.hpp"
#include "seam/plugin/registry.hpp"

namespace seam::fluid {

/// What keeps velocity and pressure of equal order free of oscillations: the kind "fluid_stabilisation".
class Stabilisation {
 public:
  virtual ~Stabilisation() = default;
  /// Highest order of the unknowns for which it is consistent.
  [[nodiscard]] virtual int highest_order() const = 0;
  /// Constants of the jump penalties on faces of cut cells.
  [[nodiscard]] virtual const JumpConstants& jumps() const = 0;
  /// Whether it can be used on a mesh that moves.
  [[nodiscard]] virtual bool follows_mesh() const = 0;
  /// @param body_force per mass, empty for none
  virtual void add(FieldSetup& setup, const OnMesh& on_mesh, const Flow& flow,
                   const std::vector<Expression>& body_force) const = 0;
};

/// Registers `cip`, `residual`, `thesis` and `residual_thesis`.
void declare_stabilisations(Registry& registry);

}  // namespace seam::fluid
