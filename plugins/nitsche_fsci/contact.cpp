// SPDX-License-Identifier: BSD-3-Clause
#include "contact.hpp"

#include "contact_kernels.hpp"
#include "coupling_sides.hpp"
#include "seam/interface/interface.hpp"
#include "trace_eigenvalue.hpp"

namespace seam::fsci {
namespace {

class Contact final : public Coupling {
 public:
  explicit Contact(const Parameters& parameters) : parameters_(parameters) {
    if (!both() && parameters.given("share"))
      throw Error(parameters.where("share"), "`share` belongs to `acts_on: both`");
  }

  static Schema schema() {
    Schema s("A deforming body that touches another one, a rigid one or itself, without friction.");
    s.reference("on", "Interface of type contact or obstacle: how one surface looks at the other",
                "interface");
    s.number("penalty", "Factor gamma_0 of Nitsche's penalty, thesis (6.17)").otherwise("1").above(0);
    s.choice(
         "acts_on",
         "`own`: each surface carries the traction it finds itself, forces on the two bodies balance as the "
         "mesh is refined. `both`: what acts on this surface acts back on the other one, forces balance "
         "exactly",
         {"own", "both"})
        .otherwise("own");
    s.number("share", "With `both`: part of the traction; 1/2 where the other surface looks back, else 1")
        .otherwise("1/2")
        .above(0)
        .at_most(1);
    declare_stress(s);
    declare_scaling(s, "once");
    return s;
  }

  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    const double share = parameters_.number("share");
    if (sides.fields.size() == 1)
      return {{make_term(ContactOfOne{one_body(sides)}), operands(sides), scales(sides)}};
    return {{make_term(ContactOfTwo{two_bodies(sides), both() ? share : 1, both() ? share : 0}),
             operands(sides), scales(sides)}};
  }

  [[nodiscard]] std::vector<Measure> measures(const CouplingSides& sides) const override {
    return sides.fields.size() == 1 ? measures_of(one_body(sides), sides)
                                    : measures_of(two_bodies(sides), sides);
  }

 private:
  [[nodiscard]] bool both() const { return parameters_.text("acts_on") == "both"; }
  [[nodiscard]] OneBody one_body(const CouplingSides& sides) const {
    return {law_of(sides, 0), parameters_.number("penalty")};
  }
  [[nodiscard]] TwoBodies two_bodies(const CouplingSides& sides) const {
    return {body_pull(parameters_, sides, 0, 1, parameters_.number("penalty"))};
  }
  [[nodiscard]] static std::vector<Operand> operands(const CouplingSides& sides) {
    if (sides.fields.size() == 1) return {{0, "displacement"}};
    return {{0, "displacement"}, {1, "displacement"}};
  }
  [[nodiscard]] std::vector<SideConstant> scales(const CouplingSides& sides) const {
    std::vector<SideConstant> result;
    for (int side = 0; side < static_cast<int>(sides.fields.size()); ++side)
      result.push_back({side, scale_of(parameters_, sides, side)});
    return result;
  }
  template <class Bodies>
  [[nodiscard]] std::vector<Measure> measures_of(const Bodies& bodies, const CouplingSides& sides) const {
    using State = ContactState<Bodies>;
    using Number = typename State::Number;
    const auto measure = [&](const std::string& name, Number number, MeasureOf of) {
      return Measure{name, {{make_quantity(State{bodies, number}), operands(sides), scales(sides)}}, of};
    };
    return {measure("gap", Number::gap, MeasureOf::least),
            measure("overlap", Number::overlap, MeasureOf::norm),
            measure("area", Number::touches, MeasureOf::integral),
            measure("pressure", Number::pressure, MeasureOf::greatest)};
  }
  Parameters parameters_;
};

}  // namespace

void declare_contact(Registry& registry) {
  registry.add<Coupling>("coupling", "contact", Contact::schema(),
                         [](const Parameters& p, const Registry&) { return std::make_unique<Contact>(p); });
}

}  // namespace seam::fsci
