// SPDX-License-Identifier: BSD-3-Clause
#include "porous_solid.hpp"
#include "seam/physics/conditions.hpp"
#include "seam/physics/regions.hpp"

namespace seam::poro {
namespace {

Schema boundary_schema() {
  Schema s("A condition on part of the boundary.");
  s.vector_expression("displacement", "Prescribed displacement of the skeleton; null leaves a component free")
      .unit("m")
      .optional();
  s.vector_expression("traction", "Dead load on the mixture per reference area").unit("Pa").optional();
  s.expression("pressure", "Load on the mixture along the current inward normal, per current area")
      .unit("Pa")
      .optional();
  s.vector_expression(
       "velocity",
       "Prescribed velocity in the pores, as 0 across a wall at rest along the axes; null leaves a component "
       "free")
      .unit("m/s")
      .optional();
  s.expression(
       "pore_pressure",
       "Pressure of the fluid outside that pores are open to; default 0, where the velocity across is free")
      .unit("Pa")
      .optional();
  s.expression("seepage",
               "Volume of fluid that leaves the body relative to the skeleton, per current area and second; "
               "imposed weakly, on walls that tilt, too; 0 is tight")
      .unit("m/s")
      .optional();
  s.number("seepage_penalty", "gamma of `seepage`").otherwise("1").at_least(0);
  return s;
}

Schema porosity_schema() {
  Schema s("Part of the volume that is fluid.");
  s.number("initial", "phi_0, at the start and without load").above(0).below(1);
  s.number("bulk",
           "kappa^P: of the skeleton's own material, thesis (2.48); without it the porosity stays as it is")
      .unit("Pa")
      .above(0)
      .optional();
  s.number("opening", "eta^P: keeps pores open, thesis (2.49)").unit("Pa").otherwise("0").at_least(0);
  return s;
}

}  // namespace

const std::vector<InitialKey>& PorousSolid::initial_keys() {
  static const std::vector<InitialKey> keys{
      {"displacement", "Displacement", "m", "displacement"},
      {"velocity_of_skeleton", "Its rate", "m/s", "displacement", InitialKey::Of::rate_of_vector},
      {"velocity", "Velocity in the pores", "m/s", "velocity"},
      {"pressure", "Pressure in the pores", "Pa", "pressure", InitialKey::Of::scalar}};
  return keys;
}

Schema PorousSolid::schema() {
  Schema s(
      "Porous body of hyperelastic skeleton, filled with an incompressible fluid, at finite strain; plane "
      "strain in 2D.");
  s.reference("mesh", "Its reference shape", "mesh");
  const auto of_region = [](Schema& r) {
    r.typed("material", "Strain energy of the skeleton", "hyperelastic").optional();
    r.number("density", "Mass of the skeleton per reference volume of the mixture; 0 leaves out its inertia")
        .unit("kg/m^3")
        .otherwise("0")
        .at_least(0);
    r.object("porosity", "Part of the volume that is fluid", porosity_schema()).optional();
    r.vector("permeability",
             "Material permeability K: one number, the diagonal, or all of the tensor row by row")
        .unit("m^2")
        .entries(-1)
        .optional();
    r.boolean("kozeny_carman",
              "K changes with the fluid's volume, thesis (4.26); as given it belongs to the initial porosity")
        .otherwise("false");
  };
  declare_regions(s, of_region);
  s.number("fluid_density", "Mass per volume of the fluid; 0 leaves out its inertia")
      .unit("kg/m^3")
      .otherwise("0")
      .at_least(0);
  s.number("viscosity", "Dynamic viscosity of the fluid").unit("Pa s").above(0);
  s.integer("order", "1: all unknowns, stabilised; 2: of displacement and velocity, with pressure of order 1")
      .otherwise("1")
      .at_least(1)
      .at_most(2);
  s.choice("storage",
           "`conservative`: a step stores the change of the fluid's volume, to rounding; `chain_rule`: the "
           "derivative of that volume, "
           "for a scheme of second order over two steps",
           {"conservative", "chain_rule"})
      .otherwise("conservative");
  s.choice("momentum",
           "Balance of the mixture's momentum: `total`, in which forces balance to rounding; `printed`: with "
           "pressure gradient and drag of the pores, thesis (2.46), short of force near boundaries whose "
           "pressure changes fast",
           {"total", "printed"})
      .otherwise("total");
  Schema stabilisation("Of order 1.");
  stabilisation
      .choice(
          "method",
          "`residual`: with the momentum balance in each cell; `interior`: a penalty on jumps of gradients "
          "across faces, thesis (2.123), (2.124), twice the error of the pressure and twice the time",
          {"residual", "interior"})
      .otherwise("residual");
  stabilisation.number("pressure", "gamma_p of `interior`").otherwise("0.05").above(0);
  stabilisation.number("divergence", "gamma_div of `interior`").otherwise("5e-5").at_least(0);
  stabilisation.number("momentum", "Factor of `residual`").otherwise("0.5").above(0);
  s.object("stabilisation", "What keeps velocity and pressure of order 1 stable", stabilisation)
      .otherwise("{}");
  declare_body_forces(s, {{"body_force", "On the skeleton, per its mass"},
                          {"fluid_body_force", "On the fluid in the pores, per mass"}});
  s.expression(
       "mass_source",
       "Volume of fluid that comes into the pores per reference volume and second; it brings no momentum")
      .unit("1/s")
      .optional();
  declare_boundary(s, "Conditions on the boundary; where there is none, it is free of traction and drained",
                   boundary_schema());
  declare_initial(s, "State at the start; default at rest, undeformed", initial_keys());
  return s;
}

}  // namespace seam::poro
