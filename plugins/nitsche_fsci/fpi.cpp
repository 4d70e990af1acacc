// SPDX-License-Identifier: BSD-3-Clause
#include "fpi.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "coupling_sides.hpp"
#include "fluid_porous.hpp"
#include "moving_fluid.hpp"
#include "seam/interface/interface.hpp"

namespace seam::fsci {
namespace {

const std::vector<Operand> operands{
    {0, "velocity"}, {0, "pressure"}, {1, "displacement"}, {1, "velocity"}, {1, "pressure"}};

/// Flow over, into and out of a porous body.
class Fpi final : public Coupling {
 public:
  explicit Fpi(const Parameters& parameters) : parameters_(parameters) {
    if (!substitution()) return;
    const Parameters& penalty = parameters.object("penalty");
    if (penalty.given("tangential"))
      throw Error(penalty.where("tangential"),
                  "`tangential: substitution` has no penalty along the interface");
    if (std::isinf(parameters.number("alpha")))
      throw Error(parameters.where("alpha"),
                  "`tangential: substitution` divides by the slip length, which "
                  "would be 0; use `nitsche`");
  }

  static Schema schema() {
    Schema s("A fluid and a porous body that it flows along, into and out of.");
    s.reference("on", "Interface with the fluid on side 0 and the porous body on side 1", "interface")
        .of_types({"embedded", "matching"});
    s.number("alpha",
             "Of Beavers and Joseph: the slip length is sqrt(tr k/3)/alpha, thesis (2.65); .inf is no slip")
        .otherwise("1")
        .above(0)
        .or_infinite();
    s.choice("slip_against",
             "What the fluid slips along: the `mixture` of skeleton and seepage (Beavers and Joseph), or the "
             "`skeleton` (Saffmann)",
             {"mixture", "skeleton"})
        .otherwise("mixture");
    s.choice("tangential",
             "How the tangential condition is imposed: by Nitsche's method, thesis (4.5), for every slip "
             "length, or by `substitution` of the traction, (4.4), which fails towards no slip",
             {"nitsche", "substitution"})
        .otherwise("nitsche");
    declare_adjoint(s);
    Schema penalty("Factors of Nitsche's penalty, thesis (4.1), (4.5).");
    penalty.number("normal", "For the velocity across the interface").otherwise("45").above(0);
    penalty.number("tangential", "For the velocity along it").otherwise("45").above(0);
    s.object("penalty", "Factors of Nitsche's penalty", penalty).otherwise("{}");
    Schema jump("Given jumps between the two sides, as those of a manufactured solution.");
    declare_jump(jump, "flow", "Of the velocity across, thesis (4.22)", "m/s", false);
    declare_jump(jump, "slip", "Of the velocity along, (4.23) without friction", "m/s", false);
    declare_jump(jump, "friction", "Stress whose traction the law of slip does not see", "Pa", true);
    declare_jump(jump, "stress", "Of the stress of fluid and mixture, (4.20)", "Pa", true);
    declare_jump(jump, "pore_stress", "Of the stress of fluid and fluid in the pores, (4.21)", "Pa", true);
    s.object("jump", "Given jumps between the two sides; default none", jump).optional();
    return s;
  }

  /// The porosity is no polynomial, and what leaves the fluid should be what the body's own balance takes in.
  /// In space there are many pieces to a facet and each needs few points.
  [[nodiscard]] int extra_degree(int dimension) const override { return dimension == 2 ? 4 : 1; }

  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    Ties ties = ties_of(parameters_);
    if (substitution()) ties.tangential_penalty = std::numeric_limits<double>::infinity();
    return FluidMesh<5>(sides, operands)
        .terms(FluidPorous{flow_of(sides), mismatch(sides), parameters_.number("alpha"), ties});
  }

  [[nodiscard]] std::vector<Measure> measures(const CouplingSides& sides) const override {
    using Of = PorousMeasure::Of;
    const FluidMesh<5> mesh(sides, operands);
    const auto of = [&](Of what) { return PorousMeasure{mismatch(sides), what}; };
    return {mesh.measure("mismatch_across", of(Of::across)), mesh.measure("mismatch_along", of(Of::along)),
            mesh.measure("seepage", of(Of::seepage), MeasureOf::integral),
            mesh.measure("body_outflow", of(Of::body), MeasureOf::integral)};
  }

 private:
  [[nodiscard]] bool substitution() const { return parameters_.text("tangential") == "substitution"; }
  [[nodiscard]] PorousMismatch mismatch(const CouplingSides& sides) const {
    const std::shared_ptr<const Law> pores = sides.law(1, "pores");
    if (!pores)
      throw Error(
          fmt::format("`fpi` needs a porous body; field '{}' does not make known what its pores are "
                      "(a porous_solid does)",
                      sides.fields[1]->name()));
    return {pores, jumps(), parameters_.text("slip_against") == "skeleton"};
  }
  [[nodiscard]] PorousJumps jumps() const {
    if (!parameters_.has("jump")) return {};
    const Parameters& all = parameters_.object("jump");
    return {jump_of(all, "flow", false), jump_of(all, "slip", false), jump_of(all, "friction", true),
            jump_of(all, "stress", true), jump_of(all, "pore_stress", true)};
  }
  Parameters parameters_;
};

}  // namespace

void declare_fpi(Registry& registry) {
  registry.add<Coupling>("coupling", "fpi", Fpi::schema(),
                         [](const Parameters& p, const Registry&) { return std::make_unique<Fpi>(p); });
  registry.publishes(
      "coupling", "fpi",
      {{Published::As::series, "mismatch_across", "m/s m^((d-1)/2)",
        "L2 norm of what the condition across the interface leaves"},
       {Published::As::series, "mismatch_along", "m/s m^((d-1)/2)",
        "L2 norm of what the condition along it leaves"},
       {Published::As::series, "seepage", "m^d/s", "rate at which fluid enters or leaves the pores"},
       {Published::As::series, "body_outflow", "m^d/s", "rate at which the surface itself moves out"}});
}

}  // namespace seam::fsci
