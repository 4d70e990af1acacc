// SPDX-License-Identifier: BSD-3-Clause
// Registers a field called TYPE, and where it is defined one called MORE.
#include "seam/plugin/plugin.hpp"

namespace {
struct Nothing {};
}  // namespace

SEAM_PLUGIN(registry) {
  const auto add = [&](const char* type) {
    registry.add<Nothing>(
        "field", type, seam::Schema("A field for the tests."),
        [](const seam::Parameters&, const seam::Registry&) { return std::make_unique<Nothing>(); });
  };
  add(TYPE);
#ifdef MORE
  add(MORE);
#endif
}
