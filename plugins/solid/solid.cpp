// SPDX-License-Identifier: BSD-3-Clause
#include "solid.hpp"

#include "quantities.hpp"
#include "seam/physics/conditions.hpp"
#include "seam/physics/regions.hpp"
#include "seam/physics/stress_law.hpp"

namespace seam::solid {
namespace {

constexpr const char* unknown_name = "displacement";
const std::vector<std::string> displacement_only{unknown_name};
const std::vector<std::string> mixed_unknowns{unknown_name, "pressure", "dilation"};

const std::vector<InitialKey> initial_keys{
    {"displacement", "Displacement", "m", unknown_name},
    {"velocity", "Velocity", "m/s", unknown_name, InitialKey::Of::rate_of_vector}};

Schema boundary_schema() {
  Schema s("A condition on part of the boundary.");
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
  declare_body_forces(s, {{"body_force", "Force per mass, as gravity"}});
  declare_boundary(s, "Conditions on the boundary; where there is none, it is free of traction",
                   boundary_schema());
  declare_initial(s, "State at the start; default at rest, undeformed", initial_keys);
  return s;
}

Solid::Solid(const Parameters& p, const Registry& registry)
    : parameters_(p),
      body_force_(p, "body_force"),
      mixed_(p.text("formulation") == "mixed"),
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
  std::vector<Unknown> result{{unknown_name, dimension, order_, has_mass_ ? 2 : 0, "m", UnknownRole::motion,
                               NearNullspace::rigid_motions}};
  if (mixed_) {
    result.push_back({"pressure", 1, 1, 0, "Pa", UnknownRole::constraint});
    result.push_back({"dilation", 1, 1, 0, ""});
  }
  body_force_.add_unknown(result, dimension, order_);
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
  for_each_boundary(parameters_, [&](const Parameters& condition, const std::string& name) {
    add_boundary(setup, condition, name);
  });
  set_initial(setup, parameters_, initial_keys);
}

void Solid::add_body_terms(FieldSetup& setup, const Region& region) const {
  if (mixed_)
    setup.add_cell_term(make_term(MixedInternalForce{region.material}), mixed_unknowns);
  else
    setup.add_cell_term(make_term(InternalForce{{region.material}}), displacement_only);
  // That of the mixed form is no function of the displacement alone.
  setup.publish(mixed_ ? "elastic" : "stress", std::make_shared<LawStress<Piola>>(Piola{region.material}));
  if (region.density > 0) setup.add_cell_term(make_term(BodyInertia{region.density}), displacement_only);
}

void Solid::add_body_force(FieldSetup& setup) const {
  body_force_.require_mass(has_mass_, "density");
  std::vector<double> densities;
  for (const Region& region : regions_) densities.push_back(region.density);
  add_body_loads(setup, body_force_, unknown_name, densities);
}

void Solid::add_boundary(FieldSetup& setup, const Parameters& condition, const std::string& name) {
  prescribe_given(setup, condition, name, unknown_name);
  if (condition.has("traction"))
    setup.add_boundary_term(name, make_term(BodyLoad{condition.vector_expression("traction"), 1.0}, 1),
                            displacement_only);
  if (condition.has("support"))
    setup.add_boundary_term(name, make_term(Support{condition.vector("support")}, 1), displacement_only);
  if (condition.has("pressure"))
    setup.add_boundary_term(name, make_term(FollowerPressure{condition.expression("pressure")}, 1),
                            displacement_only);
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
