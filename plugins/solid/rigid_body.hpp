// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/physics/completes_start.hpp"
#include "seam/physics/physics.hpp"
#include "seam/plugin/registry.hpp"
#include "seam/term/tensor.hpp"

namespace seam::solid {

/// A body that moves without deforming. Its unknowns are the translation of its centre and its rotation: an
/// angle in the plane; in space angles about its own axes, counted from step to step, beside the orientation
/// that they have led to (a quaternion, scalar last) and, with mass, the angular momentum. Each component of
/// translation and rotation is either given as a function of time or follows from mass, inertia, springs,
/// dashpots and loads; the rotation's equations are moments about the body's axes.
class RigidBody final : public Physics, public CompletesStart {
 public:
  explicit RigidBody(const Parameters& parameters) : parameters_(parameters) {}
  static Schema schema();

  [[nodiscard]] Support support() const override { return Support::point; }
  [[nodiscard]] std::vector<Unknown> unknowns(int dimension) const override;
  void build(FieldSetup& setup) const override;
  [[nodiscard]] std::string displacement() const override { return "displacement"; }
  void displace(int dimension, const double* motion, const double* arm, double* displacement) const override;
  /// In space: the orientation that the rotation has led to, and the angular momentum.
  void complete_start(Field& field) const override;

 private:
  /// Highest rate in the equations of motion: 2 with mass, 1 with dashpots alone, else 0.
  [[nodiscard]] int time_order() const;
  void prescribe(FieldSetup& setup, const std::string& unknown) const;
  /// @param momentum angular, in the body's axes, kg m^2/s
  void start_in_space(FieldSetup& setup) const;
  Parameters parameters_;
  mutable Mat<3, 3, double> inertia_;  ///< about the centre, kg m^2; known once it is built
};

}  // namespace seam::solid
