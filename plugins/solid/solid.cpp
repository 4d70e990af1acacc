// SPDX-License-Identifier: BSD-3-Clause
#include "solid.hpp"

#include "quantities.hpp"
#include "seam/physics/regions.hpp"
#include "seam/physics/stress_law.hpp"

namespace seam::solid {
namespace {

constexpr const char* unknown_name = "displacement";
const std::vector<std::string> displacement_only{unknown_name};
const std::vector<std::string> mixed_unknowns{unknown_name, "pressure", "dilation"};

Schema boundary_schema() {
  Schema s("A condition on part of the boundary.");
  s.names("on", "Boundaries of the mesh").naming("boundary");
  s.vector_expression("displacement", "Prescribed displacement; null leaves a component free")
      .unit("m")
      .optional();
  s.vector_expression("traction", "Dead load per reference area").unit("Pa").optional();
  s.expression("pressure", "Load along the current inward normal, per current area").unit("Pa").optional();
  s.vector("support", "Stiffness, per reference area, of springs along each direction that hold it")
      .unit("Pa/m")
      .at_least(0)
      .optional();
  return s;
}

}  // namespace

Schema Solid::schema() {
  Schema s("Deformable body of hyperelastic material at finite strain; plane strain in 2D.");
  s.reference("mesh", "Its reference shape", "mesh");
  declare_regions(s, [](Schema& r) {
    r.typed("material", "Strain energy", "hyperelastic").optional();
    r.number("density", "Mass per reference volume; 0 leaves out inertia")
        .unit("kg/m^3")
        .otherwise("0")
        .at_least(0);
  });
  s.choice("formulation",
           "`mixed` (with pressure and dilation) does not lock when nearly incompressible; needs order 2",
           {"displacement", "mixed"})
      .otherwise("displacement");
  s.integer("order", "Polynomial order of the displacement").otherwise("1").at_least(1).at_most(2);
  s.vector_expression("body_force", "Force per mass, as gravity").unit("m/s^2").optional();
  s.boolean("interpolate_body_force", "Take it at the nodes and interpolate, instead of at every point")
      .otherwise("false");
  s.list("boundary", "Conditions on the boundary; where there is none, it is free of traction",
         boundary_schema())
      .otherwise("[]");
  Schema initial("State at the start");
  initial.vector_expression("displacement", "Displacement").unit("m").optional();
  initial.vector_expression("velocity", "Velocity").unit("m/s").optional();
  s.object("initial", "State at the start; default at rest, undeformed", initial).optional();
  return s;
}

Solid::Solid(const Parameters& p, const Registry& registry)
    : parameters_(p),
      mixed_(p.text("formulation") == "mixed"),
      nodal_force_(p.has("body_force") && p.boolean("interpolate_body_force")),
      order_(static_cast<int>(p.integer("order"))) {
  for (const MaterialOfRegion& of : materials(p, {"material"})) {
    regions_.push_back({registry.create<Potential>("hyperelastic", of("material").object("material")),
                        of("density").number("density")});
    if (regions_.back().material->arguments() != 3)
      throw Error(of("material").where("material"),
                  "this material does not take the three invariants I1, I2, J");
  }
  has_mass_ = holds_in_all(
      p, regions_, [](const Region& r) { return r.density > 0; }, "a `density`");
  if (mixed_ && order_ != 2)
    throw Error(p.where("formulation"),
                "`formulation: mixed` is stable only with `order: 2` (pressure and dilation of order 1)");
}

std::vector<Unknown> Solid::unknowns(int dimension) const {
  std::vector<Unknown> result{{unknown_name, dimension, order_, has_mass_ ? 2 : 0, "m"}};
  if (mixed_) {
    result.push_back({"pressure", 1, 1, 0, "Pa"});
    result.push_back({"dilation", 1, 1, 0, ""});
  }
  if (nodal_force_) result.push_back({"body_force", dimension, order_, 0, "m/s^2", true});
  return result;
}

void Solid::build(FieldSetup& setup) const {
  divide(setup, parameters_);
  for (std::size_t k = 0; k < regions_.size(); ++k)
    setup.within(static_cast<int>(k), [&, &region = regions_[k]] {
      add_body_terms(setup, region);
      add_outputs(setup, region);
    });
  add_body_force(setup);
  for (const Parameters& condition : parameters_.list("boundary")) add_boundary(setup, condition);
  if (parameters_.has("initial")) {
    const Parameters& initial = parameters_.object("initial");
    for (int d = 0; d < setup.dimension(); ++d) {
      if (initial.has("displacement"))
        setup.set_initial(unknown_name, d, initial.vector_expression("displacement")[d]);
      if (initial.has("velocity"))
        setup.set_initial_rate(unknown_name, d, initial.vector_expression("velocity")[d]);
    }
  }
}

void Solid::add_body_terms(FieldSetup& setup, const Region& region) const {
  if (mixed_)
    setup.add_cell_term(make_term(MixedInternalForce{region.material}), mixed_unknowns);
  else
    setup.add_cell_term(make_term(InternalForce{{region.material}}), displacement_only);
  if (!mixed_) setup.publish("stress", std::make_shared<LawStress<Piola>>(Piola{region.material}));
  if (region.density > 0) setup.add_cell_term(make_term(BodyInertia{region.density}), displacement_only);
}

void Solid::add_body_force(FieldSetup& setup) const {
  if (!parameters_.has("body_force")) return;
  if (!has_mass_)
    throw Error(parameters_.where("body_force"),
                "a body force per mass acts on a body without mass: give a `density`");
  const auto& force = parameters_.vector_expression("body_force");
  for (int d = 0; nodal_force_ && d < setup.dimension(); ++d) setup.give("body_force", d, force[d]);
  for (std::size_t k = 0; k < regions_.size(); ++k)
    setup.within(static_cast<int>(k), [&, density = regions_[k].density] {
      if (nodal_force_)
        setup.add_cell_term(make_term(NodalBodyLoad{density}, 1), {unknown_name, "body_force"});
      else
        setup.add_cell_term(make_term(BodyLoad{force, density}, 1), displacement_only);
    });
}

void Solid::add_boundary(FieldSetup& setup, const Parameters& condition) const {
  for (const std::string& name : condition.names("on")) {
    if (condition.has("displacement"))
      for (int d = 0; d < setup.dimension(); ++d)
        if (condition.component_given("displacement", d))
          setup.prescribe(name, unknown_name, d, condition.vector_expression("displacement")[d],
                          condition.where("displacement"));
    if (condition.has("traction"))
      setup.add_boundary_term(name, make_term(BodyLoad{condition.vector_expression("traction"), 1.0}, 1),
                              displacement_only);
    if (condition.has("support"))
      setup.add_boundary_term(name, make_term(Support{condition.vector("support")}, 1), displacement_only);
    if (condition.has("pressure"))
      setup.add_boundary_term(name, make_term(FollowerPressure{condition.expression("pressure")}, 1),
                              displacement_only);
  }
}

void Solid::add_outputs(FieldSetup& setup, const Region& region) const {
  if (mixed_) {
    setup.add_output("cauchy_stress", make_quantity(MixedCauchyStress{region.material}), mixed_unknowns);
    setup.add_output("von_mises", make_quantity(MixedVonMises{{region.material}}), mixed_unknowns);
  } else {
    setup.add_output("cauchy_stress", make_quantity(CauchyStress{region.material}), displacement_only);
    setup.add_output("von_mises", make_quantity(VonMises{region.material}), displacement_only);
  }
  setup.add_integral("strain_energy", make_quantity(StrainEnergy{region.material}), displacement_only);
  setup.add_integral("volume", make_quantity(CurrentVolume{}), displacement_only);
  if (!has_mass_) return;
  setup.add_integral("volume_rate", make_quantity(VolumeRate{}), displacement_only);
  setup.add_output("velocity", make_quantity(Velocity{}), displacement_only);
  setup.add_integral("kinetic_energy", make_quantity(KineticEnergy{region.density}), displacement_only);
}

}  // namespace seam::solid
