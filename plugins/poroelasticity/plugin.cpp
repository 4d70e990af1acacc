// SPDX-License-Identifier: BSD-3-Clause
#include "seam/plugin/plugin.hpp"

#include "porous_solid.hpp"

SEAM_PLUGIN(registry) {
  using namespace seam;
  registry.add<Physics>(
      "field", "porous_solid", poro::PorousSolid::schema(),
      [](const Parameters& p, const Registry& r) { return std::make_unique<poro::PorousSolid>(p, r); });
}
