// SPDX-License-Identifier: BSD-3-Clause
#include "seam/plugin/plugin.hpp"

#include "materials.hpp"
#include "rigid_body.hpp"
#include "solid.hpp"

SEAM_PLUGIN(registry) {
  using namespace seam;
  solid::declare_materials(registry);
  registry.add<Physics>("field", "solid", solid::Solid::schema(), [](const Parameters& p, const Registry& r) {
    return std::make_unique<solid::Solid>(p, r);
  });
  registry.add<Physics>(
      "field", "rigid_body", solid::RigidBody::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<solid::RigidBody>(p); });
}
