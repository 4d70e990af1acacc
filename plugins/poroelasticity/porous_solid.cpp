// SPDX-License-Identifier: BSD-3-Clause
#include "porous_solid.hpp"

#include <fmt/format.h>

#include "quantities.hpp"
#include "seam/physics/law.hpp"
#include "seam/physics/regions.hpp"

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
      nodal_forces_(parameters.boolean("interpolate_body_force")),
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
  std::vector<Unknown> result{{"displacement", dimension, order_, has_mass_ ? 2 : 1, "m"},
                              {"velocity", dimension, order_, fluid_density_ > 0 ? 1 : 0, "m/s"},
                              {"pressure", 1, 1, porosity_changes_ ? 1 : 0, "Pa"}};
  for (const std::string force : {"body_force", "fluid_body_force"})
    if (nodal_forces_ && parameters_.has(force))
      result.push_back({force, dimension, order_, 0, "m/s^2", true});
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
      add_balances(setup, region);
      if (order_ == 1) add_stabilisation(setup, region);
      add_outputs(setup, region);
    });
  add_loads(setup);
  for (const Parameters& condition : parameters_.list("boundary"))
    for (const std::string& name : condition.names("on")) add_boundary(setup, condition, name);
  set_initial(setup);
}

void PorousSolid::add_balances(FieldSetup& setup, const Region& region) const {
  const bool conservative = parameters_.text("storage") == "conservative";
  const PoreFlow& flow = region.flow;
  setup.add_cell_term(make_term(Storage{flow.porosity, conservative}), all_unknowns);
  setup.add_cell_term(make_term(PoreMomentum{flow}), all_unknowns);
  setup.add_cell_term(make_term(Mixture{region.skeleton, flow}), all_unknowns);
  if (region.density > 0) setup.add_cell_term(make_term(BodyInertia{region.density}), {"displacement"});
  setup.add_surface_term(make_term(Seepage{flow.porosity}, 4), all_unknowns);
}

void PorousSolid::add_stabilisation(FieldSetup& setup, const Region& region) const {
  const Parameters& factors = parameters_.object("stabilisation");
  if (factors.text("method") == "residual") {
    const bool has_force = parameters_.has("fluid_body_force");
    if (has_force && nodal_forces_)
      throw Error(factors.where("method"),
                  "the residual needs `fluid_body_force` at every point; leave out "
                  "`interpolate_body_force`, or take `method: interior`");
    const auto force =
        has_force ? parameters_.vector_expression("fluid_body_force") : std::vector<Expression>{};
    setup.add_cell_term(make_term(ResidualStabilisation{region.flow, force, factors.number("momentum")}),
                        all_unknowns);
    return;
  }
  setup.add_interior_face_term(
      make_term(InteriorPenalty{region.flow.scale(setup.dimension()), factors.number("pressure"),
                                factors.number("divergence")}),
      {{0, "velocity"}, {1, "velocity"}, {0, "pressure"}, {1, "pressure"}});
}

void PorousSolid::add_loads(FieldSetup& setup) const {
  const auto check = [&](const std::string& key, bool has_mass, const std::string& missing) {
    if (!has_mass)
      throw Error(parameters_.where(key),
                  "a force per mass acts on something without mass: give a `" + missing + "`");
    for (int d = 0; nodal_forces_ && d < setup.dimension(); ++d)
      setup.give(key, d, parameters_.vector_expression(key)[d]);
    return parameters_.vector_expression(key);
  };
  if (parameters_.has("body_force")) {
    const std::vector<Expression> force = check("body_force", has_mass_, "density");
    for (std::size_t k = 0; k < regions_.size(); ++k)
      setup.within(static_cast<int>(k), [&, density = regions_[k].density] {
        if (nodal_forces_)
          setup.add_cell_term(make_term(NodalBodyLoad{density}, 1), {"displacement", "body_force"});
        else
          setup.add_cell_term(make_term(BodyLoad{force, density}, 1), {"displacement"});
      });
  }
  if (parameters_.has("fluid_body_force")) {
    const std::vector<Expression> force = check("fluid_body_force", fluid_density_ > 0, "fluid_density");
    if (nodal_forces_)
      setup.add_cell_term(make_term(NodalFluidLoad{fluid_density_}, 1),
                          {"displacement", "velocity", "fluid_body_force"});
    else
      setup.add_cell_term(make_term(FluidLoad{force, fluid_density_}, 1), {"displacement", "velocity"});
  }
  if (parameters_.has("mass_source"))
    setup.add_cell_term(make_term(MassSource{parameters_.expression("mass_source")}, 1), {"pressure"});
}

void PorousSolid::add_boundary(FieldSetup& setup, const Parameters& condition,
                               const std::string& name) const {
  for (const std::string unknown : {"displacement", "velocity"})
    for (int d = 0; condition.has(unknown) && d < setup.dimension(); ++d)
      if (condition.component_given(unknown, d))
        setup.prescribe(name, unknown, d, condition.vector_expression(unknown)[d], condition.where(unknown));
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

void PorousSolid::set_initial(FieldSetup& setup) const {
  if (!parameters_.has("initial")) return;
  const Parameters& initial = parameters_.object("initial");
  for (int d = 0; d < setup.dimension(); ++d) {
    for (const std::string unknown : {"displacement", "velocity"})
      if (initial.has(unknown)) setup.set_initial(unknown, d, initial.vector_expression(unknown)[d]);
    if (initial.has("velocity_of_skeleton"))
      setup.set_initial_rate("displacement", d, initial.vector_expression("velocity_of_skeleton")[d]);
  }
  if (initial.has("pressure")) setup.set_initial("pressure", 0, initial.expression("pressure"));
}

void PorousSolid::add_outputs(FieldSetup& setup, const Region& region) {
  const Porosity& porosity = region.flow.porosity;
  setup.add_output("porosity", make_quantity(PorosityValue{porosity}), {"displacement", "pressure"});
  setup.add_output("seepage", make_quantity(SeepageVelocity{porosity}), all_unknowns);
  setup.add_integral("fluid_volume", make_quantity(FluidVolume{porosity}), {"displacement", "pressure"});
  setup.add_integral("volume", make_quantity(CurrentVolume{}), {"displacement"});
}

}  // namespace seam::poro
