// SPDX-License-Identifier: BSD-3-Clause
#include "seam/plugin/plugin.hpp"

#include "couplings.hpp"
#include "fluid.hpp"

SEAM_PLUGIN(registry) {
  using namespace seam;
  fluid::declare_stabilisations(registry);
  fluid::declare_couplings(registry);
  registry.add<Physics>(
      "field", "cutfem_fluid", fluid::Fluid::schema(),
      [](const Parameters& p, const Registry& r) { return std::make_unique<fluid::Fluid>(p, r); });
  registry.publishes(
      "field", "cutfem_fluid",
      {{Published::As::quantity, "velocity", "m/s", "of the fluid"},
       {Published::As::quantity, "pressure", "Pa", "of the fluid"},
       {Published::As::quantity, "displacement", "m", "of the mesh, where it moves"},
       {Published::As::quantity, "body_force", "m/s^2", "where it is interpolated from the nodes"},
       {Published::As::quantity, "stress", "Pa", "Cauchy stress, pressure included"},
       {Published::As::quantity, "velocity_gradient", "1/s", "du_i/dx_j, row by row"},
       {Published::As::quantity, "vorticity", "1/s", "curl of the velocity"},
       {Published::As::quantity, "mesh_volume", "",
        "volume of a cell over its volume at the start, where the mesh moves"},
       {Published::As::series, "kinetic_energy", "J", "of the fluid"},
       {Published::As::series, "dissipation", "W", "power that viscosity takes"},
       {Published::As::series, "volume", "m^d", "of the fluid"},
       {Published::As::series, "divergence", "m^d/s",
        "integral of the divergence: what the walls let in or out"},
       {Published::As::series, "dropped_volume", "m^d",
        "of parts too small to be kept, where bodies are cut out"}});
}
