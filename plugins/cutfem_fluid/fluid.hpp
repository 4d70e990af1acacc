// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/physics/conditions.hpp"
#include "seam/physics/physics.hpp"
#include "stabilisation.hpp"

namespace seam::fluid {

/// An incompressible Newtonian fluid on a fixed mesh from which bodies may be cut out, thesis 2.1.5, 2.2.4,
/// 3.1, or on a mesh that moves with what it is fitted to.
class Fluid final : public Physics {
 public:
  Fluid(const Parameters& parameters, const Registry& registry);
  static Schema schema();

  [[nodiscard]] bool separates_parts() const override { return parameters_.text("parts") == "separate"; }
  [[nodiscard]] std::vector<Unknown> unknowns(int dimension) const override;
  void build(FieldSetup& setup) const override;
  [[nodiscard]] std::string displacement() const override { return on_mesh_.moves ? "displacement" : ""; }
  [[nodiscard]] bool moves_through_space() const override { return on_mesh_.moves; }

 private:
  void add_mesh_motion(FieldSetup& setup) const;
  void add_volume_terms(FieldSetup& setup) const;
  void add_ghost_penalty(FieldSetup& setup) const;
  void add_boundary(FieldSetup& setup, const Parameters& condition, const std::string& boundary) const;
  void add_velocity(FieldSetup& setup, const Parameters& condition, const std::string& boundary) const;
  void add_slip(FieldSetup& setup, const Parameters& condition, const std::string& boundary) const;
  void add_outflow(FieldSetup& setup, const Parameters& condition, const std::string& boundary) const;
  void fix_pressure_level(FieldSetup& setup) const;
  static const std::vector<InitialKey>& initial_keys();
  void add_outputs(FieldSetup& setup) const;

  Parameters parameters_;
  std::unique_ptr<Stabilisation> stabilisation_;
  Flow flow_;
  OnMesh on_mesh_;
  int order_;
  BodyForce body_force_;
};

}  // namespace seam::fluid
