// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "seam/interface/interface.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/scene/schema.hpp"

namespace seam {

/// The boundary of one field's mesh, moved by that field's displacement, cut out of another field's mesh.
/// Side 0 is the field that is cut, side 1 the body; points carry the trace of the body's cell behind the
/// facet, in its reference configuration.
class EmbeddedInterface final : public Interface {
 public:
  explicit EmbeddedInterface(const Parameters& parameters) : parameters_(parameters) {}
  static Schema schema();
  [[nodiscard]] std::vector<std::string> fields() const override {
    return {parameters_.text("field"), parameters_.text("body")};
  }
  [[nodiscard]] std::vector<std::string> boundaries(int side) const override {
    return side == 1 ? parameters_.names("boundaries") : std::vector<std::string>{};
  }
  [[nodiscard]] std::vector<InterfacePart> build(InterfaceSetup& setup) const override;

 private:
  Parameters parameters_;
};

}  // namespace seam
