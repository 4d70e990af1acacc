// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernels.hpp"
#include "seam/physics/conditions.hpp"
#include "seam/physics/physics.hpp"
#include "seam/plugin/registry.hpp"

namespace seam::poro {

/// A porous body filled with an incompressible fluid, at finite strain: displacement of the skeleton,
/// velocity and pressure in its pores, thesis 2.1.6 and 2.2.5.
class PorousSolid final : public Physics {
 public:
  PorousSolid(const Parameters& parameters, const Registry& registry);
  static Schema schema();

  [[nodiscard]] std::vector<Unknown> unknowns(int dimension) const override;
  void build(FieldSetup& setup) const override;
  [[nodiscard]] std::string displacement() const override { return "displacement"; }

 private:
  /// What differs by region.
  struct Region {
    PotentialPointer skeleton;
    Mat<3, 3, double> permeability;  ///< K, m^2
    PoreFlow flow;
    double density;  ///< averaged, of the skeleton
  };
  void add_balances(FieldSetup& setup, const Region& region) const;
  void add_stabilisation(FieldSetup& setup, const Region& region) const;
  static void add_outputs(FieldSetup& setup, const Region& region);
  void add_loads(FieldSetup& setup) const;
  void add_fluid_load(FieldSetup& setup, const Region& region) const;
  void add_boundary(FieldSetup& setup, const Parameters& condition, const std::string& name) const;
  static const std::vector<InitialKey>& initial_keys();
  [[nodiscard]] bool is_printed() const { return parameters_.text("momentum") == "printed"; }
  static MixtureFormula mixture(const Region& region) { return {region.skeleton, region.flow.porosity}; }
  [[nodiscard]] MixtureShare share(const Region& region) const {
    return {region.flow.porosity, is_printed()};
  }

  Parameters parameters_;
  std::vector<Region> regions_;  ///< one at least
  double fluid_density_, viscosity_;
  BodyForce body_force_, fluid_force_;
  bool has_mass_;  ///< the skeleton
  bool porosity_changes_;
  int order_;
};

}  // namespace seam::poro
