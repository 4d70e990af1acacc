// SPDX-License-Identifier: BSD-3-Clause
#include "porous_solid.hpp"

#include <fmt/format.h>

#include "quantities.hpp"

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

/// @throws Error when there are no 1, dim or dim^2 numbers, or they make no positive definite tensor
template <int dim>
std::array<double, 9> inverse_permeability(const Parameters& parameters) {
  const std::vector<double>& given = parameters.vector("permeability");
  Mat<dim, dim, double> k;
  if (given.size() == 1 || given.size() == dim) {
    for (int i = 0; i < dim; ++i) k(i, i) = given.size() == 1 ? given[0] : given[i];
  } else if (given.size() == dim * dim) {
    std::copy(given.begin(), given.end(), k.c.begin());
  } else {
    throw Error(parameters.where("permeability"),
                fmt::format("found {} numbers; expected 1, {} or {}", given.size(), dim, dim * dim));
  }
  bool positive = determinant(k) > 0;
  for (int i = 0; i < dim; ++i) {
    positive = positive && k(i, i) > 0;
    for (int j = 0; j < i; ++j)
      positive = positive && k(i, j) == k(j, i) && k(i, i) * k(j, j) > k(i, j) * k(i, j);
  }
  if (!positive)
    throw Error(parameters.where("permeability"), "the tensor is not symmetric and positive definite");
  const Mat<dim, dim, double> inverted = inverse(k);
  std::array<double, 9> result{};
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) result[i * 3 + j] = inverted(i, j);
  return result;
}

}  // namespace

PorousSolid::PorousSolid(const Parameters& parameters, const Registry& registry)
    : parameters_(parameters),
      skeleton_(registry.create<Potential>("hyperelastic", parameters.object("material"))),
      flow_{parameters.number("fluid_density"), parameters.number("viscosity"),
            porosity_of(parameters.object("porosity")), parameters.boolean("kozeny_carman"),
            parameters.dimension() == 2 ? inverse_permeability<2>(parameters)
                                        : inverse_permeability<3>(parameters)},
      density_(parameters.number("density")),
      order_(static_cast<int>(parameters.integer("order"))) {
  if (skeleton_->arguments() != 3)
    throw Error(parameters.where("material"), "this material does not take the three invariants I1, I2, J");
}

std::vector<Unknown> PorousSolid::unknowns(int dimension) const {
  return {{"displacement", dimension, order_, density_ > 0 ? 2 : 1, "m"},
          {"velocity", dimension, order_, flow_.density > 0 ? 1 : 0, "m/s"},
          {"pressure", 1, 1, flow_.porosity.given ? 0 : 1, "Pa"}};
}

void PorousSolid::build(FieldSetup& setup) const {
  setup.publish("density", flow_.density);
  setup.publish("viscosity", flow_.viscosity);
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
  if (density_ > 0) setup.add_cell_term(make_term(SkeletonInertia{density_}), {"displacement"});
  for (const std::string& name : setup.boundaries())
    setup.add_boundary_term(name, make_term(Seepage{flow_.porosity}), all_unknowns);
}

void PorousSolid::add_stabilisation(FieldSetup& setup) const {
  const Parameters& factors = parameters_.object("stabilisation");
  double trace = 0;
  for (int d = 0; d < setup.dimension(); ++d) trace += flow_.inverse_permeability[d * 3 + d];
  const double resistance = flow_.viscosity * flow_.porosity.initial * trace / setup.dimension();
  setup.add_interior_face_term(
      make_term(InteriorPenalty{resistance, flow_.density, factors.number("pressure"),
                                factors.number("divergence")}),
      {{0, "velocity"}, {1, "velocity"}, {0, "pressure"}, {1, "pressure"}});
}

void PorousSolid::add_loads(FieldSetup& setup) const {
  if (parameters_.has("body_force")) {
    if (density_ == 0)
      throw Error(parameters_.where("body_force"),
                  "a body force per mass acts on a body without mass: give a `density`");
    setup.add_cell_term(make_term(Load{parameters_.vector_expression("body_force"), density_}, 1),
                        {"displacement"});
  }
  if (!parameters_.has("fluid_body_force")) return;
  if (flow_.density == 0)
    throw Error(parameters_.where("fluid_body_force"),
                "a body force per mass acts on a fluid without mass: give a `fluid_density`");
  setup.add_cell_term(
      make_term(FluidLoad{parameters_.vector_expression("fluid_body_force"), flow_.density}, 1),
      {"displacement", "velocity"});
}

void PorousSolid::add_boundary(FieldSetup& setup, const Parameters& condition,
                               const std::string& name) const {
  for (const std::string unknown : {"displacement", "velocity"})
    for (int d = 0; condition.has(unknown) && d < setup.dimension(); ++d)
      if (condition.component_given(unknown, d))
        setup.prescribe(name, unknown, d, condition.vector_expression(unknown)[d], condition.where(unknown));
  if (condition.has("traction"))
    setup.add_boundary_term(name, make_term(Load{condition.vector_expression("traction"), 1.0}, 1),
                            {"displacement"});
  if (condition.has("pressure"))
    setup.add_boundary_term(name, make_term(MixturePressure{condition.expression("pressure")}, 1),
                            {"displacement"});
  if (condition.has("pore_pressure"))
    setup.add_boundary_term(name, make_term(PorePressure{condition.expression("pore_pressure")}, 1),
                            {"displacement", "velocity"});
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
