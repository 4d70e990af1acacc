// SPDX-License-Identifier: BSD-3-Clause
#include "fluid.hpp"

#include <fmt/format.h>

#include "quantities.hpp"
#include "weak_condition.hpp"

namespace seam::fluid {
namespace {

/// What a condition gives, by its key. @throws Error unless it is exactly one thing
std::string kind_of(const Parameters& condition) {
  std::vector<std::string> kinds;
  for (const char* key : {"velocity", "traction", "outflow"})
    if (condition.has(key)) kinds.emplace_back(key);
  if (condition.boolean("slip")) kinds.emplace_back("slip");
  if (kinds.size() != 1)
    throw Error(condition.where(),
                fmt::format("found {}, expected one of velocity, slip, traction and outflow",
                            kinds.empty() ? "no condition" : "several conditions"));
  for (const char* key : {"slip_length", "wall_traction", "adjoint", "penalty"})
    if (condition.given(key) && !condition.boolean("weak"))
      throw Error(condition.where(key), fmt::format("`{}` belongs to a velocity with `weak: true`", key));
  if (condition.boolean("weak") && kinds[0] != "velocity")
    throw Error(condition.where("weak"), "only a velocity can be imposed weakly");
  if (condition.given("backflow") && kinds[0] != "outflow")
    throw Error(condition.where("backflow"), "`backflow` belongs to an outflow");
  return kinds[0];
}

/// True when the condition gives the velocity across the boundary.
bool confines(const FieldSetup& setup, const Parameters& condition, const std::string& boundary) {
  if (condition.boolean("slip")) return true;
  if (!condition.has("velocity")) return false;
  const int axis = setup.boundary_axis(boundary);
  if (axis >= 0) return condition.component_given("velocity", axis);
  bool all = true;
  for (int d = 0; d < setup.dimension(); ++d) all = all && condition.component_given("velocity", d);
  return all;
}

}  // namespace

Fluid::Fluid(const Parameters& p, const Registry& registry)
    : parameters_(p),
      stabilisation_(registry.create<Stabilisation>("fluid_stabilisation", p.object("stabilisation"))),
      flow_{p.number("density"), p.number("viscosity"), p.boolean("convection")},
      on_mesh_{p.has("moving_mesh")},
      order_(static_cast<int>(p.integer("order"))),
      body_force_(p, "body_force") {
  if (order_ > stabilisation_->highest_order())
    throw Error(p.where("stabilisation"),
                fmt::format("`{}` is consistent up to order {}; `order: {}` needs `cip`",
                            p.object("stabilisation").type(), stabilisation_->highest_order(), order_));
  if (on_mesh_.moves && !stabilisation_->follows_mesh())
    throw Error(
        p.where("stabilisation"),
        fmt::format("found `{}`, expected `residual`{}: penalties on jumps do not follow a moving mesh",
                    p.object("stabilisation").type(), order_ > 1 ? " and `order: 1`" : ""));
}

std::vector<Unknown> Fluid::unknowns(int dimension) const {
  std::vector<Unknown> result{{"velocity", dimension, order_, 1, "m/s"},
                              {"pressure", 1, order_, 0, "Pa", UnknownRole::constraint}};
  if (on_mesh_.moves)
    result.push_back(
        {"displacement", dimension, 1, 1, "m", UnknownRole::motion, NearNullspace::rigid_motions});
  body_force_.add_unknown(result, dimension, order_);
  return result;
}

void Fluid::build(FieldSetup& setup) const {
  setup.publish("density", flow_.density);
  setup.publish("viscosity", flow_.viscosity);
  setup.publish("convection", flow_.convection ? 1 : 0);
  add_volume_terms(setup);
  if (on_mesh_.moves)
    add_mesh_motion(setup);
  else
    add_ghost_penalty(setup);
  for_each_boundary(parameters_, [&](const Parameters& condition, const std::string& name) {
    add_boundary(setup, condition, name);
  });
  fix_pressure_level(setup);
  set_initial(setup, parameters_, initial_keys());
  add_outputs(setup);
}

void Fluid::add_volume_terms(FieldSetup& setup) const {
  const auto both = on_mesh_.operands("velocity", "pressure");
  setup.add_cell_term(on_mesh_.term(Stokes{flow_.viscosity}), both);
  setup.add_cell_term(on_mesh_.term(Inertia{flow_.density}), both);
  if (flow_.convection) setup.add_cell_term(on_mesh_.term(Convection{flow_.density}, order_ - 1), both);
  body_force_.give(setup);
  if (body_force_.is_nodal())
    setup.add_cell_term(on_mesh_.term(NodalLoad{flow_.density}, 1),
                        on_mesh_.operands("velocity", body_force_.key()));
  else if (body_force_.is_given())
    setup.add_cell_term(on_mesh_.term(Load{body_force_.per_mass(), flow_.density}, 1), both);
  stabilisation_->add(setup, on_mesh_, flow_, body_force_.per_mass());
}

void Fluid::add_mesh_motion(FieldSetup& setup) const {
  const Parameters& motion = parameters_.object("moving_mesh");
  setup.add_cell_term(make_term(PseudoElastic{motion.number("poisson")}), {"displacement"});
  for_each_boundary(motion, [&](const Parameters& condition, const std::string& name) {
    prescribe_given(setup, condition, name, "displacement");
  });
  setup.add_output("mesh_volume", make_quantity(MeshVolume{}), {"displacement"});
}

void Fluid::add_ghost_penalty(FieldSetup& setup) const {
  const Parameters& p = parameters_.object("ghost_penalty");
  const GhostPenalty penalty{flow_, stabilisation_->jumps(), p.number("viscous"), p.number("transient"),
                             p.number("second_order")};
  setup.add_ghost_face_term(p.text("faces") == "all" ? GhostFaces::all : GhostFaces::wet, make_term(penalty),
                            both_sides);
}

void Fluid::add_boundary(FieldSetup& setup, const Parameters& condition, const std::string& boundary) const {
  const std::string kind = kind_of(condition);
  if (kind == "velocity") return add_velocity(setup, condition, boundary);
  if (kind == "slip") return add_slip(setup, condition, boundary);
  if (kind == "outflow") return add_outflow(setup, condition, boundary);
  setup.add_boundary_term(boundary, on_mesh_.term(Load{condition.vector_expression("traction"), 1.0}, 1),
                          on_mesh_.operands("velocity", "pressure"));
}

void Fluid::add_velocity(FieldSetup& setup, const Parameters& condition, const std::string& boundary) const {
  if (!condition.boolean("weak")) return prescribe_given(setup, condition, boundary, "velocity");
  for (int d = 0; d < setup.dimension(); ++d)
    if (!condition.component_given("velocity", d))
      throw Error(condition.where("velocity"),
                  "a weakly imposed velocity needs all its components; see `slip_length` for free sliding");
  const auto& velocity = condition.vector_expression("velocity");
  setup.add_boundary_term(boundary, on_mesh_.term(weak_condition(condition, flow_, velocity), 1),
                          on_mesh_.operands("velocity", "pressure"));
}

/// On a side that a coordinate is constant on, the normal component is prescribed; else it is imposed weakly.
void Fluid::add_slip(FieldSetup& setup, const Parameters& condition, const std::string& boundary) const {
  const int axis = setup.boundary_axis(boundary);
  if (axis >= 0)
    setup.prescribe(boundary, "velocity", axis, Expression(0.0), condition.where("slip"));
  else
    setup.add_boundary_term(boundary, on_mesh_.term(weak_slip(flow_, setup.dimension())),
                            on_mesh_.operands("velocity", "pressure"));
}

void Fluid::add_outflow(FieldSetup& setup, const Parameters& condition, const std::string& boundary) const {
  const auto both = on_mesh_.operands("velocity", "pressure");
  if (condition.text("outflow") == "do_nothing")
    setup.add_boundary_term(boundary, on_mesh_.term(DoNothing{flow_.viscosity}), both);
  const double backflow = condition.number("backflow");
  if (backflow > 0)
    setup.add_boundary_term(boundary, on_mesh_.term(Backflow{flow_.density, backflow}, order_), both);
}

void Fluid::fix_pressure_level(FieldSetup& setup) const {
  const std::string& choice = parameters_.text("fix_pressure");
  if (choice == "never") return;
  std::vector<std::string> open;
  if (choice == "auto") {
    open = setup.boundaries();
    for_each_boundary(parameters_, [&](const Parameters& condition, const std::string& name) {
      if (confines(setup, condition, name)) std::erase(open, name);
    });
  }
  setup.fix_level("pressure", parameters_.number("pressure_level"), open);
}

void Fluid::add_outputs(FieldSetup& setup) const {
  const auto both = on_mesh_.operands("velocity", "pressure");
  setup.add_output("stress", on_mesh_.value(CauchyStress{flow_.viscosity}), both);
  setup.add_output("velocity_gradient", on_mesh_.value(VelocityGradient{}), both);
  setup.add_output("vorticity", on_mesh_.value(Vorticity{}), both);
  setup.add_integral("kinetic_energy", on_mesh_.integrand(KineticEnergy{flow_.density}), both);
  setup.add_integral("dissipation", on_mesh_.integrand(Dissipation{flow_.viscosity}), both);
  setup.add_integral("volume", on_mesh_.integrand(Volume{}), both);
  setup.add_integral("divergence", on_mesh_.integrand(Divergence{}), both);
}

}  // namespace seam::fluid
