// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/interface/interface.hpp"
#include "seam/plugin/registry.hpp"

namespace seam::solid {

/// Two rigid bodies, or one and the ground: a single point without extent in which terms read the unknowns of
/// both. Its weight is 1, so that coefficients of test functions are forces, N, and moments, N m.
class Link final : public Interface {
 public:
  /// @throws Error unless there are one or two different fields
  explicit Link(const Parameters& parameters);
  static Schema schema();
  [[nodiscard]] std::vector<std::string> fields() const override { return fields_; }
  /// @throws Error when a field is no rigid body
  [[nodiscard]] std::vector<InterfacePart> build(InterfaceSetup& setup) const override;

 private:
  Location where_;
  std::vector<std::string> fields_;
};

}  // namespace seam::solid
