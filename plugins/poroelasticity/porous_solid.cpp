// SPDX-License-Identifier: BSD-3-Clause
#include "porous_solid.hpp"

#include <fmt/format.h>

#include "quantities.hpp"
#include "seam/physics/regions.hpp"
#include "seam/physics/stress_law.hpp"

namespace seam::poro {
namespace {

const std::vector<std::string> all_unknowns{"displacement", "velocity", "pressure"};

Porosity porosity_of(const Parameters& given) {
  const double initial = given.number("initial"), opening = given.number("opening");
  if (!given.has("bulk")) {
    if (opening > 0)
      throw Error(given.where("opening"),
                  "a porosity that does not change needs nothing to stay open; give `bulk`, or leave it out");
    return {initial, true};
  }
  return {initial, false, given.number("bulk"), opening};
}

/// K, [3][3]; in the plane its out-of-plane entry is the mean of the others.
/// @throws Error when there are no 1, dim or dim^2 numbers, or they make no positive definite tensor
template <int dim>
Mat<3, 3, double> permeability(const Parameters& parameters) {
  const std::vector<double>& given = parameters.vector("permeability");
  Mat<3, 3, double> k;
  if (given.size() == 1 || given.size() == dim) {
    for (int i = 0; i < dim; ++i) k(i, i) = given.size() == 1 ? given[0] : given[i];
  } else if (given.size() == dim * dim) {
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) k(i, j) = given[i * dim + j];
  } else {
    throw Error(parameters.where("permeability"),
                fmt::format("found {} numbers; expected 1, {} or {}", given.size(), dim, dim * dim));
  }
  if (dim == 2) k(2, 2) = 0.5 * (k(0, 0) + k(1, 1));
  bool positive = determinant(k) > 0;
  for (int i = 0; i < 3; ++i) {
    positive = positive && k(i, i) > 0;
    for (int j = 0; j < i; ++j)
      positive = positive && k(i, j) == k(j, i) && k(i, i) * k(j, j) > k(i, j) * k(i, j);
  }
  if (!positive)
    throw Error(parameters.where("permeability"), "the tensor is not symmetric and positive definite");
  return k;
}

}  // namespace

PorousSolid::PorousSolid(const Parameters& parameters, const Registry& registry)
    : parameters_(parameters),
      fluid_density_(parameters.number("fluid_density")),
      viscosity_(parameters.number("viscosity")),
      body_force_(parameters, "body_force"),
      fluid_force_(parameters, "fluid_body_force"),
      order_(static_cast<int>(parameters.integer("order"))) {
  for (const MaterialOfRegion& of : materials(parameters, {"material", "porosity", "permeability"})) {
    PotentialPointer skeleton = registry.create<Potential>("hyperelastic", of("material").object("material"));
    if (skeleton->arguments() != 3)
      throw Error(of("material").where("material"),
                  "this material does not take the three invariants I1, I2, J");
    const Parameters& given = of("permeability");
    const Mat<3, 3, double> k = parameters.dimension() == 2 ? permeability<2>(given) : permeability<3>(given);
    const PoreFlow flow{fluid_density_, viscosity_, porosity_of(of("porosity").object("porosity")),
                        of("kozeny_carman").boolean("kozeny_carman"), inverse(k).c};
    regions_.push_back({std::move(skeleton), k, flow, of("density").number("density")});
  }
  has_mass_ = holds_in_all(
      parameters, regions_, [](const Region& r) { return r.density > 0; }, "a `density`");
  porosity_changes_ = holds_in_all(
      parameters, regions_, [](const Region& r) { return !r.flow.porosity.given; }, "`porosity: {bulk}`");
}

std::vector<Unknown> PorousSolid::unknowns(int dimension) const {
  std::vector<Unknown> result{{"displacement", dimension, order_, has_mass_ ? 2 : 1, "m", UnknownRole::motion,
                               NearNullspace::rigid_motions},
                              {"velocity", dimension, order_, fluid_density_ > 0 ? 1 : 0, "m/s"},
                              {"pressure", 1, 1, porosity_changes_ ? 1 : 0, "Pa", UnknownRole::constraint}};
  body_force_.add_unknown(result, dimension, order_);
  fluid_force_.add_unknown(result, dimension, order_);
  return result;
}

void PorousSolid::build(FieldSetup& setup) const {
  divide(setup, parameters_);
  setup.publish("density", fluid_density_);
  setup.publish("viscosity", viscosity_);
  for (std::size_t k = 0; k < regions_.size(); ++k)
    setup.within(static_cast<int>(k), [&, &region = regions_[k]] {
      setup.publish("pores",
                    std::make_shared<LawOf<PoresFormula>>(PoresFormula{region.flow, region.permeability.c}));
      setup.publish("mixture", std::make_shared<LawOf<MixtureFormula>>(mixture(region)));
      setup.publish("skeleton", std::make_shared<LawStress<SkeletonStress>>(SkeletonStress{region.skeleton}));
      add_balances(setup, region);
      if (order_ == 1) add_stabilisation(setup, region);
      add_outputs(setup, region);
    });
  add_loads(setup);
  for_each_boundary(parameters_, [&](const Parameters& condition, const std::string& name) {
    add_boundary(setup, condition, name);
  });
  set_initial(setup, parameters_, initial_keys());
}

void PorousSolid::add_balances(FieldSetup& setup, const Region& region) const {
  const bool conservative = parameters_.text("storage") == "conservative";
  const PoreFlow& flow = region.flow;
  setup.add_cell_term(make_term(Storage{flow.porosity, conservative}), all_unknowns);
  setup.add_cell_term(make_term(PoreMomentum{flow}), all_unknowns);
  setup.add_cell_term(make_term(MixtureStress{mixture(region)}), {"displacement", "pressure"});
  if (is_printed()) setup.add_cell_term(make_term(PrintedExchange{flow}), all_unknowns);
  if (flow.density > 0)
    setup.add_cell_term(make_term(PoreInertia{flow.density, share(region)}), all_unknowns);
  if (region.density > 0) setup.add_cell_term(make_term(BodyInertia{region.density}), {"displacement"});
  setup.add_surface_term(make_term(Seepage{flow.porosity}, 4), all_unknowns, "seepage");
}

void PorousSolid::add_stabilisation(FieldSetup& setup, const Region& region) const {
  const Parameters& factors = parameters_.object("stabilisation");
  if (factors.text("method") == "residual") {
    if (fluid_force_.is_nodal())
      throw Error(factors.where("method"),
                  "the residual needs `fluid_body_force` at every point; leave out "
                  "`interpolate_body_force`, or take `method: interior`");
    setup.add_cell_term(
        make_term(ResidualStabilisation{region.flow, fluid_force_.per_mass(), factors.number("momentum")}),
        all_unknowns);
    return;
  }
  setup.add_interior_face_term(
      make_term(InteriorPenalty{region.flow.scale(setup.dimension()), factors.number("pressure"),
                                factors.number("divergence")}),
      {{0, "velocity"}, {1, "velocity"}, {0, "pressure"}, {1, "pressure"}});
}

void PorousSolid::add_loads(FieldSetup& setup) const {
  body_force_.require_mass(has_mass_, "density");
  std::vector<double> densities;
  for (const Region& region : regions_) densities.push_back(region.density);
  add_body_loads(setup, body_force_, "displacement", densities);
  fluid_force_.require_mass(fluid_density_ > 0, "fluid_density");
  fluid_force_.give(setup);
  for (std::size_t k = 0; k < regions_.size() && fluid_force_.is_given(); ++k)
    setup.within(static_cast<int>(k), [&] { add_fluid_load(setup, regions_[k]); });
  if (parameters_.has("mass_source"))
    setup.add_cell_term(make_term(MassSource{parameters_.expression("mass_source")}, 1), {"pressure"});
}

void PorousSolid::add_fluid_load(FieldSetup& setup, const Region& region) const {
  std::vector<std::string> operands = all_unknowns;
  if (fluid_force_.is_nodal()) {
    operands.push_back(fluid_force_.key());
    setup.add_cell_term(make_term(NodalFluidLoad{fluid_density_, share(region)}, 1), operands);
  } else {
    setup.add_cell_term(make_term(FluidLoad{fluid_force_.per_mass(), fluid_density_, share(region)}, 1),
                        operands);
  }
}

void PorousSolid::add_boundary(FieldSetup& setup, const Parameters& condition,
                               const std::string& name) const {
  for (const std::string unknown : {"displacement", "velocity"})
    prescribe_given(setup, condition, name, unknown);
  if (condition.has("traction"))
    setup.add_boundary_term(name, make_term(BodyLoad{condition.vector_expression("traction"), 1.0}, 1),
                            {"displacement"});
  if (condition.has("pressure"))
    setup.add_boundary_term(name, make_term(MixturePressure{condition.expression("pressure")}, 1),
                            {"displacement"});
  if (condition.has("pore_pressure"))
    setup.add_boundary_term(name, make_term(PorePressure{condition.expression("pore_pressure")}, 1),
                            {"displacement", "velocity"});
  if (!condition.has("seepage")) return;
  for (const std::string other : {"velocity", "pore_pressure"})
    if (condition.has(other))
      throw Error(condition.where("seepage"), "found `seepage` and `" + other +
                                                  "` on the same boundary, both of which say what flows "
                                                  "through it; give one of them");
  for (std::size_t k = 0; k < regions_.size(); ++k)
    setup.within(static_cast<int>(k), [&, &flow = regions_[k].flow] {
      setup.add_boundary_term(
          name,
          make_term(WeakSeepage{flow.porosity, flow.scale(setup.dimension()), condition.expression("seepage"),
                                condition.number("seepage_penalty")},
                    4),
          all_unknowns);
    });
}

void PorousSolid::add_outputs(FieldSetup& setup, const Region& region) {
  const Porosity& porosity = region.flow.porosity;
  setup.add_output("porosity", make_quantity(PorosityValue{porosity}), {"displacement", "pressure"});
  setup.add_output("seepage", make_quantity(SeepageVelocity{porosity}), all_unknowns);
  setup.add_boundary_quantity("outflow", make_quantity(Outflow{porosity}, 4), all_unknowns);
  setup.add_integral("fluid_volume", make_quantity(FluidVolume{porosity}), {"displacement", "pressure"});
  setup.add_integral("volume", make_quantity(CurrentVolume{}), {"displacement"});
}

}  // namespace seam::poro
