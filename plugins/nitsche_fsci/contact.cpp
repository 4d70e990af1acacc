// SPDX-License-Identifier: BSD-3-Clause
#include "contact.hpp"

#include "contact_kernels.hpp"
#include "coupling_sides.hpp"
#include "seam/interface/adjoint.hpp"
#include "seam/interface/interface.hpp"
#include "trace_eigenvalue.hpp"

namespace seam::fsci {
namespace {

class ContactCoupling final : public Coupling {
 public:
  explicit ContactCoupling(const Parameters& parameters) : parameters_(parameters) {
    if (!both() && parameters.given("share"))
      throw Error(parameters.where("share"), "`share` belongs to `acts_on: both`");
  }

  static Schema schema() {
    Schema s("A body that touches another one, an obstacle or itself, without friction.");
    s.reference("on", "Interface of type contact or obstacle: how one surface looks at the other",
                "interface")
        .of_types({"contact", "obstacle"});
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
    declare_surface_stiffness(s);
    s.choice(
         "adjoint",
         "Adjoint term: with `symmetric` (xi = -1) contact has an energy, which the scheme with theta 1/2 "
         "keeps; needs a penalty above 1. `skew` (xi = 1) is stable for every penalty",
         {"none", "symmetric", "skew"})
        .otherwise("none");
    s.choice(
         "in_time",
         "For theta < 1. `plain`: the scheme takes its means of the traction at both ends of a step, energy "
         "may grow where bodies part. `hybrid`: where they part, the mean traction is kept from pulling "
         "instead, and energy does not grow (Chouly, Hild and Renard); for obstacles at rest",
         {"plain", "hybrid"})
        .otherwise("plain");
    declare_scaling(s, "once");
    return s;
  }

  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    return sides.fields.size() == 1 ? terms_between<1>(sides) : terms_between<2>(sides);
  }

  void check_beside(const std::vector<Neighbour>& all, std::size_t self) const override {
    check_looks(all, self);
  }

  [[nodiscard]] std::vector<Measure> measures(const CouplingSides& sides) const override {
    return sides.fields.size() == 1 ? measures_between<1>(sides) : measures_between<2>(sides);
  }

 private:
  [[nodiscard]] bool both() const { return parameters_.text("acts_on") == "both"; }
  template <int count>
  [[nodiscard]] Bodies<count> bodies(const CouplingSides& sides) const {
    BodyPull pull = body_pull(parameters_, sides, 0, count == 2 ? 1 : -1, parameters_.number("penalty"));
    if (!pull.own && !pull.other && parameters_.text("adjoint") != "none")
      throw Error(parameters_.where("adjoint"), "rigid bodies have no stress, and no adjoint term of it");
    return {std::move(pull)};
  }
  template <int count>
  [[nodiscard]] std::vector<SideTerm> terms_between(const CouplingSides& sides) const {
    const bool hybrid = parameters_.text("in_time") == "hybrid";
    const bool adjoint = parameters_.text("adjoint") != "none";
    if (hybrid) return adjoint ? of_kind<count, true, true>(sides) : of_kind<count, true, false>(sides);
    return adjoint ? of_kind<count, false, true>(sides) : of_kind<count, false, false>(sides);
  }
  template <int count, bool hybrid, bool adjoint>
  [[nodiscard]] std::vector<SideTerm> of_kind(const CouplingSides& sides) const {
    const double share = count == 2 && both() ? parameters_.number("share") : 1;
    return {{make_term(Contact<count, hybrid, adjoint>{bodies<count>(sides), share, both() ? share : 0,
                                                       adjoint_of(parameters_)}),
             operands(sides), scales(sides)}};
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
  template <int count>
  [[nodiscard]] std::vector<Measure> measures_between(const CouplingSides& sides) const {
    using State = ContactState<count>;
    using Number = typename State::Number;
    const auto measure = [&](const std::string& name, Number number, MeasureOf of) {
      const State state{bodies<count>(sides), number};
      return Measure{name, {{make_quantity(state), operands(sides), scales(sides)}}, of};
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
  registry.add<Coupling>(
      "coupling", "contact", ContactCoupling::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<ContactCoupling>(p); });
  registry.publishes("coupling", "contact",
                     {{Published::As::series, "gap", "m",
                       "least gap; below 0 an overlap, infinite where nothing is opposite"},
                      {Published::As::series, "overlap", "m m^((d-1)/2)", "L2 norm of the overlap"},
                      {Published::As::series, "area", "m^(d-1)", "in touch"},
                      {Published::As::series, "pressure", "Pa", "greatest pressure"}});
}

}  // namespace seam::fsci
