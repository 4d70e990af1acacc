// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/interface/interface.hpp"
#include "seam/plugin/registry.hpp"

namespace seam {

/// Two boundaries whose faces coincide: each face of side 0 has a partner face of side 1 with the same
/// corners.
class MatchingInterface final : public Interface {
 public:
  explicit MatchingInterface(const Parameters& parameters);
  static Schema schema();
  [[nodiscard]] std::vector<std::string> fields() const override { return fields_; }
  [[nodiscard]] std::vector<InterfacePart> build(InterfaceSetup& setup) const override;

 private:
  std::vector<std::string> fields_;
  std::vector<std::string> boundaries_;
  Location where_;
};

/// Registers the interface "matching".
void register_matching(Registry& registry);

}  // namespace seam
