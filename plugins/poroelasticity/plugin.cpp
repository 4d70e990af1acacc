// SPDX-License-Identifier: BSD-3-Clause
#include "seam/plugin/plugin.hpp"

#include "porous_solid.hpp"

SEAM_PLUGIN(registry) {
  using namespace seam;
  registry.add<Physics>(
      "field", "porous_solid", poro::PorousSolid::schema(),
      [](const Parameters& p, const Registry& r) { return std::make_unique<poro::PorousSolid>(p, r); });
  registry.publishes(
      "field", "porous_solid",
      {{Published::As::quantity, "displacement", "m", "of the skeleton"},
       {Published::As::quantity, "velocity", "m/s", "of the fluid in the pores"},
       {Published::As::quantity, "pressure", "Pa", "of the fluid in the pores"},
       {Published::As::quantity, "body_force", "m/s^2", "where it is interpolated from the nodes"},
       {Published::As::quantity, "fluid_body_force", "m/s^2", "where it is interpolated from the nodes"},
       {Published::As::quantity, "porosity", "", "share of the pores in the current volume"},
       {Published::As::quantity, "seepage", "m/s", "porosity times the velocity relative to the skeleton"},
       {Published::As::quantity, "outflow", "m/s",
        "on boundaries, per area at rest: fluid that leaves the body, m^d/s in probes"},
       {Published::As::series, "volume", "m^d", "of the deformed body"},
       {Published::As::series, "fluid_volume", "m^d", "of the fluid in its pores"}});
}
