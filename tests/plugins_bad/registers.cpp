// SPDX-License-Identifier: BSD-3-Clause
// Registers one field, called TYPE.
#include "seam/plugin/plugin.hpp"

namespace {
struct Nothing {};
}  // namespace

SEAM_PLUGIN(registry) {
  registry.add<Nothing>(
      "field", TYPE, seam::Schema("A field for the tests."),
      [](const seam::Parameters&, const seam::Registry&) { return std::make_unique<Nothing>(); });
}
