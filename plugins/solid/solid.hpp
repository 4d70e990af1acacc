// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernels.hpp"
#include "seam/physics/conditions.hpp"
#include "seam/physics/physics.hpp"
#include "seam/plugin/registry.hpp"

namespace seam::solid {

/// A deformable body of hyperelastic material, statics and dynamics, thesis 2.1.4 and 2.2.3.
class Solid final : public Physics {
 public:
  Solid(const Parameters& parameters, const Registry& registry);
  static Schema schema();

  [[nodiscard]] std::vector<Unknown> unknowns(int dimension) const override;
  void build(FieldSetup& setup) const override;
  [[nodiscard]] std::string displacement() const override { return "displacement"; }

 private:
  /// What differs by region.
  struct Region {
    PotentialPointer material;
    double density;
  };
  void add_body_terms(FieldSetup& setup, const Region& region) const;
  void add_body_force(FieldSetup& setup) const;
  static void add_boundary(FieldSetup& setup, const Parameters& condition, const std::string& name);
  void add_outputs(FieldSetup& setup, const Region& region) const;

  Parameters parameters_;
  std::vector<Region> regions_;  ///< one at least
  BodyForce body_force_;
  bool has_mass_;
  bool mixed_;
  int order_;
};

}  // namespace seam::solid
