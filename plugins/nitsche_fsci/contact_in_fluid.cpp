// SPDX-License-Identifier: BSD-3-Clause
#include "contact_in_fluid.hpp"

#include "contact_in_fluid_kernels.hpp"
#include "coupling_sides.hpp"
#include "seam/field/field.hpp"
#include "seam/interface/interface.hpp"
#include "trace_eigenvalue.hpp"

namespace seam::fsci {
namespace {

using SideTerm = Coupling::SideTerm;

const std::vector<Operand> free_operands{{0, "velocity"}, {0, "pressure"}, {1, "displacement"}};
const std::vector<Operand> near_operands{
    {0, "velocity"}, {0, "pressure"}, {1, "displacement"}, {2, "displacement"}};
const std::vector<Operand> closed_operands{
    {0, "velocity"}, {0, "pressure"}, {1, "displacement"}, {2, "displacement"}, {3, "displacement"}};

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
    const std::vector<SideConstant> scale = scales(sides);
    return {{make_term(fluid_sided(sides), 1), free_operands, {}, "free"},
            {make_term(FluidSidedNear{fluid_sided(sides)}, 1), free_operands, {}, "near"},
            {make_term(near_contact(sides), 1), near_operands, scale, "near"},
            {make_term(closed_contact(sides), 1), closed_operands, scale, "closed"}};
  }

  void check_beside(const std::vector<Neighbour>& all, std::size_t self) const override {
    check_looks(all, self);
  }

  [[nodiscard]] std::vector<Measure> measures(const CouplingSides& sides) const override {
    using Near = TouchState<NearContact>;
    using Closed = TouchState<ClosedContact>;
    const std::vector<SideConstant> scale = scales(sides);
    const NearContact near = near_contact(sides);
    const ClosedContact closed = closed_contact(sides);
    const FluidSided flow = fluid_sided(sides);
    const auto on_wet = [](const std::shared_ptr<const Term>& term,
                           const std::vector<Operand>& operands = free_operands) {
      return std::vector<SideTerm>{{term, operands, {}, "free"}, {term, operands, {}, "near"}};
    };
    const auto touch = [&](Near::Number number, int component = 0) {
      return std::vector<SideTerm>{
          {make_quantity(Near{near, number, component}), near_operands, scale, "near"},
          {make_quantity(Closed{closed, Closed::Number(number), component}), closed_operands, scale,
           "closed"}};
    };
    std::vector<Measure> result{
        {"mismatch", on_wet(make_quantity(VelocityMismatch{}))},
        {"gap", touch(Near::Number::gap), MeasureOf::least},
        {"contact_area", touch(Near::Number::touches), MeasureOf::integral},
        {"contact_pressure", touch(Near::Number::pressure), MeasureOf::greatest},
        {"fluid_outflow", on_wet(make_quantity(Outflow<Value<Vector<0>>>{}), {{0, "velocity"}}),
         MeasureOf::integral},
        {"body_outflow", on_wet(make_quantity(Outflow<Rate<Vector<0>>>{}), {{1, "displacement"}}),
         MeasureOf::integral}};
    constexpr const char* axis[] = {".x", ".y", ".z"};
    for (int c = 0; c < parameters_.dimension(); ++c) {
      result.push_back(
          {std::string("contact_force") + axis[c], touch(Near::Number::traction, c), MeasureOf::integral});
      std::vector<SideTerm> all = on_wet(make_quantity(TractionOf<FluidSided>{flow, c}));
      all.push_back({make_quantity(TractionOf<NearContact>{near, c}), near_operands, scale, "near"});
      all.push_back({make_quantity(TractionOf<ClosedContact>{closed, c}), closed_operands, scale, "closed"});
      result.push_back({std::string("force") + axis[c], std::move(all), MeasureOf::integral});
    }
    return result;
  }

 private:
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
  [[nodiscard]] NearContact near_contact(const CouplingSides& sides) const {
    return {{fluid_pull(sides), bodies(sides)}};
  }
  [[nodiscard]] ClosedContact closed_contact(const CouplingSides& sides) const {
    return {{fluid_pull(sides), bodies(sides)}, parameters_.number("extension_reach")};
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
