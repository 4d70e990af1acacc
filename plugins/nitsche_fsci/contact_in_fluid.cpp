// SPDX-License-Identifier: BSD-3-Clause
#include "contact_in_fluid.hpp"

#include <algorithm>

#include "contact_in_fluid_kernels.hpp"
#include "coupling_sides.hpp"
#include "seam/field/field.hpp"
#include "seam/interface/interface.hpp"
#include "trace_eigenvalue.hpp"

namespace seam::fsci {
namespace {

using SideTerm = Coupling::SideTerm;

const std::vector<Operand> free_operands{{0, "velocity"}, {0, "pressure"}, {1, "displacement"}};

/// What the terms of a part where there is another body stand for.
/// @param edge the side of operand 4, of closed parts; else -1
std::vector<Operand> operands_of(const CouplingSides& sides, bool meets_fluid, int edge) {
  std::vector<Operand> result = free_operands;
  if (!meets_fluid) result[0] = result[1] = {1, "displacement"};
  result.push_back({2, "displacement"});
  const bool porous = is_porous(sides, 2);
  // Operand 5 is the pressure, also where there is no edge.
  if (edge >= 0 || porous) result.push_back({std::max(edge, 1), "displacement"});
  if (porous) result.push_back({2, "pressure"});
  return result;
}

/// A deforming body in a fluid that may touch another one, or itself.
class ContactInFluid final : public Coupling {
 public:
  explicit ContactInFluid(const Parameters& parameters) : parameters_(parameters) {}

  static Schema schema() {
    Schema s(
        "A fluid and a body that share their motion and traction, and that body's contact without friction.");
    s.reference("on", "Interface of type embedded_contact: the surface of one body", "interface")
        .of_types({"embedded_contact"});
    s.number("slip_length", "Navier's, wherever it is: 0 is no slip, .inf leaves the body to glide freely")
        .unit("m")
        .otherwise("0")
        .at_least(0)
        .or_infinite();
    Schema slip(
        "Slip that grows without bound as a gap closes, thesis (6.30): factor reach (reach/gap - 1).");
    slip.number("factor", "kappa_0; 0 leaves no slip until the surfaces touch").otherwise("0.1").at_least(0);
    slip.number("reach", "The gap below which it sets in; default the width of the fluid's cell")
        .unit("m")
        .above(0)
        .optional();
    s.object("near_slip", "Additional slip near the other surface", slip).otherwise("{}");
    s.number(
         "extension_reach",
         "How far the fluid's traction reaches into contact: linearly less of it up to there, dry contact "
         "beyond; .inf takes that at the nearest wet point for all of it")
        .unit("m")
        .otherwise(".inf")
        .above(0)
        .or_infinite();
    declare_adjoint(s);
    Schema penalty("Factors of Nitsche's penalty.");
    penalty.number("normal", "For the velocity across the interface, thesis (3.26)").otherwise("35").above(0);
    penalty.number("tangential", "For the velocity along it").otherwise("35").above(0);
    penalty.number("contact", "gamma_0 of contact, thesis (6.17)").otherwise("1").above(0);
    s.object("penalty", "Factors of Nitsche's penalty", penalty).otherwise("{}");
    declare_stress(s);
    declare_surface_stiffness(s);
    declare_scaling(s, "once");
    return s;
  }

  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    std::vector<SideTerm> result{
        {make_term(fluid_sided(sides), 1), free_operands, {}, "free"},
        {make_term(FluidSidedNear{fluid_sided(sides)}, 1), free_operands, {}, "near"}};
    for (SideTerm& term : is_porous(sides, 2) ? contact<true>(sides) : contact<false>(sides))
      result.push_back(std::move(term));
    return result;
  }

  void check_beside(const std::vector<Neighbour>& all, std::size_t self) const override {
    check_looks(all, self);
  }

  [[nodiscard]] std::vector<Measure> measures(const CouplingSides& sides) const override {
    return is_porous(sides, 2) ? measures_of<true>(sides) : measures_of<false>(sides);
  }

 private:
  /// @tparam porous whether the other body has pores
  template <bool porous>
  [[nodiscard]] std::vector<SideTerm> contact(const CouplingSides& sides) const {
    const std::vector<SideConstant> scale = scales(sides);
    return {
        {make_term(near_contact<porous>(sides), 1), operands_of(sides, true, -1), scale, "near"},
        {make_term(closed_contact<porous>(sides), 1), operands_of(sides, true, 3), scale, "closed"},
        {make_term(ShutContact<porous>{{bodies(sides)}}, 1), operands_of(sides, false, -1), scale, "shut"}};
  }
  template <bool porous>
  [[nodiscard]] std::vector<Measure> measures_of(const CouplingSides& sides) const {
    using Near = TouchState<NearContact<porous>>;
    using Closed = TouchState<ClosedContact<porous>>;
    using Shut = TouchState<ShutContact<porous>>;
    using Number = typename Near::Number;
    const std::vector<SideConstant> scale = scales(sides);
    const std::vector<Operand> near_operands = operands_of(sides, true, -1),
                               closed_operands = operands_of(sides, true, 3),
                               shut_operands = operands_of(sides, false, -1);
    const NearContact<porous> near = near_contact<porous>(sides);
    const ClosedContact<porous> closed = closed_contact<porous>(sides);
    const ShutContact<porous> shut{{bodies(sides)}};
    const FluidSided flow = fluid_sided(sides);
    const auto on_wet = [](const std::shared_ptr<const Term>& term,
                           const std::vector<Operand>& operands = free_operands) {
      return std::vector<SideTerm>{{term, operands, {}, "free"}, {term, operands, {}, "near"}};
    };
    const auto touch = [&](Number number, int component = 0) {
      return std::vector<SideTerm>{
          {make_quantity(Near{near, number, component}), near_operands, scale, "near"},
          {make_quantity(Closed{closed, typename Closed::Number(number), component}), closed_operands, scale,
           "closed"},
          {make_quantity(Shut{shut, typename Shut::Number(number), component}), shut_operands, scale,
           "shut"}};
    };
    std::vector<Measure> result{
        {"mismatch", on_wet(make_quantity(VelocityMismatch{}))},
        {"gap", touch(Number::gap), MeasureOf::least},
        {"contact_area", touch(Number::touches), MeasureOf::integral},
        {"contact_pressure", touch(Number::pressure), MeasureOf::greatest},
        {"fluid_outflow", on_wet(make_quantity(Outflow<Value<Vector<0>>>{}), {{0, "velocity"}}),
         MeasureOf::integral},
        {"body_outflow", on_wet(make_quantity(Outflow<Rate<Vector<0>>>{}), {{1, "displacement"}}),
         MeasureOf::integral}};
    constexpr const char* axis[] = {".x", ".y", ".z"};
    for (int c = 0; c < parameters_.dimension(); ++c) {
      result.push_back(
          {std::string("contact_force") + axis[c], touch(Number::traction, c), MeasureOf::integral});
      std::vector<SideTerm> all = on_wet(make_quantity(TractionOf<FluidSided>{flow, c}));
      all.push_back({make_quantity(TractionOf<NearContact<porous>>{near, c}), near_operands, scale, "near"});
      all.push_back(
          {make_quantity(TractionOf<ClosedContact<porous>>{closed, c}), closed_operands, scale, "closed"});
      all.push_back({make_quantity(TractionOf<ShutContact<porous>>{shut, c}), shut_operands, scale, "shut"});
      result.push_back({std::string("force") + axis[c], std::move(all), MeasureOf::integral});
    }
    return result;
  }

  [[nodiscard]] FluidSided fluid_sided(const CouplingSides& sides) const {
    for (const Operand& operand : free_operands)
      static_cast<void>(sides.fields.at(operand.side)->place(operand.unknown));
    const Parameters& near = parameters_.object("near_slip");
    return {flow_of(sides),
            {},
            {parameters_.number("slip_length"), near.number("factor"),
             near.has("reach") ? near.number("reach") : 0.0},
            ties_of(parameters_)};
  }
  [[nodiscard]] FluidPull fluid_pull(const CouplingSides& sides) const {
    return {flow_of(sides), parameters_.object("penalty").number("normal")};
  }
  [[nodiscard]] BodyPull bodies(const CouplingSides& sides) const {
    return body_pull(parameters_, sides, 1, 2, parameters_.object("penalty").number("contact"));
  }
  template <bool porous>
  [[nodiscard]] NearContact<porous> near_contact(const CouplingSides& sides) const {
    NearContact<porous> result;
    result.bodies = bodies(sides);
    result.fluid = fluid_pull(sides);
    return result;
  }
  template <bool porous>
  [[nodiscard]] ClosedContact<porous> closed_contact(const CouplingSides& sides) const {
    ClosedContact<porous> result;
    result.bodies = bodies(sides);
    result.fluid = fluid_pull(sides);
    result.reach = parameters_.number("extension_reach");
    return result;
  }
  [[nodiscard]] std::vector<SideConstant> scales(const CouplingSides& sides) const {
    return {{1, scale_of(parameters_, sides, 1)}, {2, scale_of(parameters_, sides, 2)}};
  }
  Parameters parameters_;
};

}  // namespace

void declare_contact_in_fluid(Registry& registry) {
  registry.add<Coupling>(
      "coupling", "contact_in_fluid", ContactInFluid::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<ContactInFluid>(p); });
  registry.publishes(
      "coupling", "contact_in_fluid",
      {{Published::As::series, "mismatch", "m/s m^((d-1)/2)",
        "L2 norm of the fluid's velocity less that of the body"},
       {Published::As::series, "gap", "m",
        "least gap; below 0 an overlap, infinite where nothing is opposite"},
       {Published::As::series, "contact_area", "m^(d-1)", "in touch"},
       {Published::As::series, "contact_pressure", "Pa", "greatest pressure of contact"},
       {Published::As::series, "fluid_outflow", "m^d/s",
        "rate at which the fluid goes through the wet surface"},
       {Published::As::series, "body_outflow", "m^d/s", "rate at which the surface itself moves out"},
       {Published::As::series, "contact_force.x", "N", "force of contact on the body"},
       {Published::As::series, "force.x", "N", "force of contact and fluid on the body"},
       {Published::As::series, "contact_force.y", "N", "force of contact on the body"},
       {Published::As::series, "force.y", "N", "force of contact and fluid on the body"},
       {Published::As::series, "contact_force.z", "N", "force of contact on the body"},
       {Published::As::series, "force.z", "N", "force of contact and fluid on the body"}});
}

}  // namespace seam::fsci
