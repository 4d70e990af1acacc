// SPDX-License-Identifier: BSD-3-Clause
#include "seam/plugin/plugin.hpp"

#include "joint.hpp"
#include "materials.hpp"
#include "rigid_body.hpp"
#include "rigid_surface.hpp"
#include "solid.hpp"
#include "spring.hpp"

SEAM_PLUGIN(registry) {
  using namespace seam;
  solid::declare_materials(registry);
  registry.add<Physics>("field", "solid", solid::Solid::schema(), [](const Parameters& p, const Registry& r) {
    return std::make_unique<solid::Solid>(p, r);
  });
  registry.publishes(
      "field", "solid",
      {{Published::As::quantity, "displacement", "m", "of the material points"},
       {Published::As::quantity, "velocity", "m/s", "its rate; of a solid with mass"},
       {Published::As::quantity, "pressure", "Pa", "of a mixed formulation"},
       {Published::As::quantity, "dilation", "", "of a mixed formulation: volume over reference volume"},
       {Published::As::quantity, "body_force", "m/s^2", "where it is interpolated from the nodes"},
       {Published::As::quantity, "cauchy_stress", "Pa", "true stress, by components xx, xy, ..."},
       {Published::As::quantity, "von_mises", "Pa", "equivalent stress"},
       {Published::As::series, "strain_energy", "J", "energy of the deformation"},
       {Published::As::series, "kinetic_energy", "J", "of a solid with mass"},
       {Published::As::series, "volume", "m^d", "of the deformed body"},
       {Published::As::series, "volume_rate", "m^d/s", "its rate; of a solid with mass"}});
  registry.add<Physics>(
      "field", "rigid_body", solid::RigidBody::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<solid::RigidBody>(p); });
  registry.publishes(
      "field", "rigid_body",
      {{Published::As::quantity, "translation", "m", "of the centre"},
       {Published::As::quantity, "rotation", "rad",
        "an angle in the plane; in space angles about the body's own axes"},
       {Published::As::quantity, "orientation", "", "in space: quaternion, scalar last"},
       {Published::As::quantity, "angular_momentum", "kg m^2/s",
        "of a body with mass in space, about its centre"},
       {Published::As::quantity, "velocity", "m/s", "of the centre; of a body with mass or a dashpot"},
       {Published::As::quantity, "spin", "rad/s", "angular velocity, in axes of space; likewise"},
       {Published::As::quantity, "joint_force", "N", "what its `joint` exerts on it; of probes"},
       {Published::As::quantity, "joint_moment", "N m",
        "likewise, about where the joint is; in axes of space"},
       {Published::As::series, "kinetic_energy", "J", "of a body with mass"}});
  registry.add<Physics>(
      "field", "rigid_surface", solid::RigidSurface::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<solid::RigidSurface>(p); });
  registry.publishes("field", "rigid_surface",
                     {{Published::As::quantity, "displacement", "m", "of the body's points"},
                      {Published::As::quantity, "velocity", "m/s", "its rate"}});
  solid::declare_rigid(registry);
  solid::declare_joint(registry);
  solid::declare_springs(registry);
}
