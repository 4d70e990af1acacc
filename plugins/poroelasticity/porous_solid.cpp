// SPDX-License-Identifier: BSD-3-Clause
#include "porous_solid.hpp"

#include <fmt/format.h>

#include "quantities.hpp"
#include "seam/physics/law.hpp"

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
      skeleton_(registry.create<Potential>("hyperelastic", parameters.object("material"))),
      permeability_(parameters.dimension() == 2 ? permeability<2>(parameters) : permeability<3>(parameters)),
      flow_{parameters.number("fluid_density"), parameters.number("viscosity"),
            porosity_of(parameters.object("porosity")), parameters.boolean("kozeny_carman"),
            inverse(permeability_).c},
      density_(parameters.number("density")),
      nodal_forces_(parameters.boolean("interpolate_body_force")),
      order_(static_cast<int>(parameters.integer("order"))) {
  if (skeleton_->arguments() != 3)
    throw Error(parameters.where("material"), "this material does not take the three invariants I1, I2, J");
}

std::vector<Unknown> PorousSolid::unknowns(int dimension) const {
  std::vector<Unknown> result{{"displacement", dimension, order_, density_ > 0 ? 2 : 1, "m"},
                              {"velocity", dimension, order_, flow_.density > 0 ? 1 : 0, "m/s"},
                              {"pressure", 1, 1, flow_.porosity.given ? 0 : 1, "Pa"}};
  for (const std::string force : {"body_force", "fluid_body_force"})
    if (nodal_forces_ && parameters_.has(force))
      result.push_back({force, dimension, order_, 0, "m/s^2", true});
  return result;
}

void PorousSolid::build(FieldSetup& setup) const {
  setup.publish("density", flow_.density);
  setup.publish("viscosity", flow_.viscosity);
  setup.publish("pores", std::make_shared<LawOf<PoresFormula>>(PoresFormula{flow_, permeability_.c}));
  add_balances(setup);
  if (order_ == 1) add_stabilisation(setup);
  add_loads(setup);
  for (const Parameters& condition : parameters_.list("boundary"))
    for (const std::string& name : condition.names("on")) add_boundary(setup, condition, name);
  set_initial(setup);
  add_outputs(setup);
}

void PorousSolid::add_balances(FieldSetup& setup) const {
  const bool conservative = parameters_.text("storage") == "conservative";
  setup.add_cell_term(make_term(Storage{flow_.porosity, conservative}), all_unknowns);
  setup.add_cell_term(make_term(PoreMomentum{flow_}), all_unknowns);
  setup.add_cell_term(make_term(Mixture{skeleton_, flow_}), all_unknowns);
  if (density_ > 0) setup.add_cell_term(make_term(BodyInertia{density_}), {"displacement"});
  for (const std::string& name : setup.boundaries())
    setup.add_boundary_term(name, make_term(Seepage{flow_.porosity}, 4), all_unknowns);
}

void PorousSolid::add_stabilisation(FieldSetup& setup) const {
  const Parameters& factors = parameters_.object("stabilisation");
  setup.add_interior_face_term(
      make_term(InteriorPenalty{flow_.scale(setup.dimension()), factors.number("pressure"),
                                factors.number("divergence")}),
      {{0, "velocity"}, {1, "velocity"}, {0, "pressure"}, {1, "pressure"}});
}

void PorousSolid::add_loads(FieldSetup& setup) const {
  const auto add = [&](const std::string& key, double density, const std::string& missing, const auto& term,
                       const auto& nodal, const std::vector<std::string>& operands) {
    if (!parameters_.has(key)) return;
    if (density == 0)
      throw Error(parameters_.where(key),
                  "a force per mass acts on something without mass: give a `" + missing + "`");
    const std::vector<Expression>& force = parameters_.vector_expression(key);
    if (!nodal_forces_) {
      setup.add_cell_term(term(force), operands);
      return;
    }
    for (int d = 0; d < setup.dimension(); ++d) setup.give(key, d, force[d]);
    std::vector<std::string> with_force = operands;
    with_force.push_back(key);
    setup.add_cell_term(nodal, with_force);
  };
  add("body_force", density_, "density",
      [&](const std::vector<Expression>& force) {
        return make_term(BodyLoad{force, density_}, 1);
      },
      make_term(NodalBodyLoad{density_}, 1), {"displacement"});
  add("fluid_body_force", flow_.density, "fluid_density",
      [&](const std::vector<Expression>& force) {
        return make_term(FluidLoad{force, flow_.density}, 1);
      },
      make_term(NodalFluidLoad{flow_.density}, 1), {"displacement", "velocity"});
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
  setup.add_boundary_term(
      name,
      make_term(WeakSeepage{flow_.porosity, flow_.scale(setup.dimension()), condition.expression("seepage"),
                            condition.number("seepage_penalty")},
                4),
      all_unknowns);
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

void PorousSolid::add_outputs(FieldSetup& setup) const {
  setup.add_output("porosity", make_quantity(PorosityValue{flow_.porosity}), {"displacement", "pressure"});
  setup.add_output("seepage", make_quantity(SeepageVelocity{flow_.porosity}), all_unknowns);
  setup.add_integral("fluid_volume", make_quantity(FluidVolume{flow_.porosity}),
                     {"displacement", "pressure"});
  setup.add_integral("volume", make_quantity(CurrentVolume{}), {"displacement"});
}

}  // namespace seam::poro
