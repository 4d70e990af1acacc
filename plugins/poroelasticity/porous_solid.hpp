// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernels.hpp"
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
  void add_balances(FieldSetup& setup) const;
  void add_stabilisation(FieldSetup& setup) const;
  void add_loads(FieldSetup& setup) const;
  void add_boundary(FieldSetup& setup, const Parameters& condition, const std::string& name) const;
  void set_initial(FieldSetup& setup) const;
  void add_outputs(FieldSetup& setup) const;

  Parameters parameters_;
  PotentialPointer skeleton_;
  Mat<3, 3, double> permeability_;  ///< K, m^2
  PoreFlow flow_;
  double density_;  ///< averaged, of the skeleton
  bool nodal_forces_;
  int order_;
};

}  // namespace seam::poro
