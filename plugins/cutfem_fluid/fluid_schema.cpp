// SPDX-License-Identifier: BSD-3-Clause
#include "fluid.hpp"
#include "seam/physics/conditions.hpp"
#include "weak_condition.hpp"

namespace seam::fluid {
namespace {

Schema boundary_schema() {
  Schema s("A condition on part of the boundary: one of velocity, slip, traction and outflow.");
  s.vector_expression("velocity", "Given velocity; null leaves a component free").unit("m/s").optional();
  s.boolean("weak", "Impose the velocity weakly, by Nitsche's method").otherwise("false");
  declare_weak_condition(s);
  s.boolean("slip", "No flow through the boundary, no tangential traction").otherwise("false");
  s.vector_expression("traction", "Given force per area").unit("Pa").optional();
  s.choice("outflow", "`do_nothing`: viscosity dv/dn - p n = 0; `symmetric`: no traction",
           {"do_nothing", "symmetric"})
      .optional();
  s.number("backflow", "With an outflow: 0.5 and more keep what flows back from bringing in energy")
      .otherwise("0")
      .at_least(0);
  return s;
}

Schema ghost_penalty_schema() {
  Schema s(
      "Penalty on jumps between cut cells and their neighbours, thesis (3.4)-(3.6), on top of the "
      "stabilisation's.");
  s.choice("faces", "`wet` leaves out faces that lie inside a body altogether", {"wet", "all"})
      .otherwise("wet");
  s.number("viscous", "gamma_nu").otherwise("0.1").at_least(0);
  s.number("transient", "gamma_t").otherwise("0.001").at_least(0);
  s.number("second_order", "Weight of second derivatives, times the cell size squared")
      .otherwise("0.05")
      .at_least(0);
  return s;
}

Schema moving_mesh_schema() {
  Schema s(
      "The mesh moves: with a body it is fitted to (coupling `fsi` or `fpi` on a matching interface) and as "
      "given here; between these it is an elastic body without mass.");
  s.number("poisson", "Poisson's ratio of that body").otherwise("0").above(-1).below(0.5);
  Schema boundary("Where the motion of the mesh is given.");
  boundary.vector_expression("displacement", "Of the mesh; null leaves a component free").unit("m");
  declare_boundary(s, "Given motion; where there is none, the boundary goes along freely", boundary);
  return s;
}

}  // namespace

const std::vector<InitialKey>& Fluid::initial_keys() {
  static const std::vector<InitialKey> keys{
      {"velocity", "Velocity", "m/s", "velocity"},
      {"pressure", "Pressure", "Pa", "pressure", InitialKey::Of::scalar}};
  return keys;
}

Schema Fluid::schema() {
  Schema s(
      "Incompressible Newtonian fluid: on a fixed mesh, out of which bodies may be cut, or on a mesh that "
      "moves.");
  s.reference("mesh", "Where the fluid may be", "mesh");
  s.number("density", "Mass per volume").unit("kg/m^3").above(0);
  s.number("viscosity", "Dynamic viscosity").unit("Pa s").above(0);
  s.boolean("convection", "false leaves out the convective acceleration: Stokes flow").otherwise("true");
  s.integer("order", "Polynomial order of velocity and pressure").otherwise("1").at_least(1).at_most(2);
  declare_body_forces(s, {{"body_force", "Force per mass, as gravity"}});
  declare_boundary(s, "Conditions on the boundary; where there is none, it is free of traction",
                   boundary_schema());
  declare_initial(s, "State at the start; default at rest", initial_keys());
  s.typed("stabilisation", "Against oscillations of equal orders and of convection", "fluid_stabilisation")
      .otherwise("`residual` of order 1, `cip` of order 2", [](const Parameters& fluid) {
        return fluid.has("order") && fluid.integer("order") == 2 ? "cip" : "residual";
      });
  s.object("moving_mesh", "The mesh moves (ALE formulation); needs `residual` or `residual_thesis`",
           moving_mesh_schema())
      .optional();
  s.object("ghost_penalty", "Penalty on jumps around cut cells", ghost_penalty_schema()).otherwise("{}");
  s.choice("parts",
           "Where a body thinner than a cell lies between them, `separate` gives the fluid on either side "
           "unknowns "
           "of its own; `joined` does not",
           {"joined", "separate"})
      .otherwise("joined");
  s.choice("fix_pressure",
           "`auto` fixes the level of the pressure at one node of each part of the fluid where the "
           "conditions here leave it open; `never` "
           "where what the fluid touches determines it, as a compressible body does",
           {"auto", "always", "never"})
      .otherwise("auto");
  s.number("pressure_level", "Pressure at that node").unit("Pa").otherwise("0");
  return s;
}

}  // namespace seam::fluid
