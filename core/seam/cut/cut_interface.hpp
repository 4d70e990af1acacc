// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "seam/cut/field_cut.hpp"
#include "seam/interface/interface.hpp"
#include "seam/surface/moving_body.hpp"

namespace seam {

/// The boundary of a body of given shape and motion that is cut out of a field's mesh. Side 0 is the field.
class CutInterface final : public Interface {
 public:
  CutInterface(const Parameters& parameters, const Registry& types)
      : parameters_(parameters), body_(parameters, types) {}
  static Schema schema();
  [[nodiscard]] std::vector<std::string> fields() const override { return {parameters_.text("field")}; }
  [[nodiscard]] std::optional<Surface> body(const BodySetting& setting, double time) const override;
  [[nodiscard]] std::vector<InterfacePart> build(InterfaceSetup& setup) const override;

 private:
  Parameters parameters_;
  MovingBody body_;
};

/// Registers the interfaces "cut" and "embedded" and the body "level_set".
void register_cut(Registry& registry);

}  // namespace seam
