// SPDX-License-Identifier: BSD-3-Clause
#include "fsi.hpp"

#include <fmt/format.h>

#include "coupling_sides.hpp"
#include "fluid_sided.hpp"
#include "moving_fluid.hpp"
#include "seam/interface/interface.hpp"
#include "solid_sided.hpp"
#include "trace_eigenvalue.hpp"

namespace seam::fsci {
namespace {

const std::vector<Operand> operands{{0, "velocity"}, {0, "pressure"}, {1, "displacement"}};

/// No slip, or Navier slip, between a fluid and a deforming body.
class Fsi final : public Coupling {
 public:
  explicit Fsi(const Parameters& parameters) : parameters_(parameters) {
    if (!solid_sided()) {
      if (parameters.given("scaling")) throw only(parameters.where("scaling"), "scaling", "solid");
      return;
    }
    if (parameters.number("slip_length") != 0)
      throw only(parameters.where("slip_length"), "slip_length", "fluid");
    const Parameters& penalty = parameters.object("penalty");
    for (const char* key : {"normal", "tangential"})
      if (penalty.given(key)) throw only(penalty.where(key), key, "fluid");
  }

  static Schema schema() {
    Schema s("A fluid and a deforming body that move together and share their traction.");
    s.reference("on", "Interface with the fluid on side 0 and the body on side 1", "interface")
        .of_types({"embedded", "matching"});
    s.choice("stress", "Whose stress is the traction: `fluid`, thesis (3.26), or `solid`, (3.29)",
             {"fluid", "solid"})
        .otherwise("fluid");
    s.number("slip_length", "Navier's: 0 is no slip, .inf leaves the body to glide freely")
        .unit("m")
        .otherwise("0")
        .at_least(0)
        .or_infinite();
    declare_adjoint(s);
    Schema penalty("Factors of Nitsche's penalty, thesis (3.26), (3.29).");
    penalty.number("normal", "For the velocity across the interface, of the fluid's stress")
        .otherwise("35")
        .above(0);
    penalty.number("tangential", "For the velocity along it, of the fluid's stress").otherwise("35").above(0);
    penalty.number("solid", "Of the body's stress").otherwise("2").at_least(0);
    s.object("penalty", "Factors of Nitsche's penalty", penalty).otherwise("{}");
    declare_scaling(s, "step");
    Schema jump("Given jumps between the two sides, as those of a manufactured solution.");
    declare_jump(jump, "velocity", "Of the velocity, thesis (3.48)", "m/s", false);
    declare_jump(jump, "stress",
                 "Of the stress, times the normal out of the fluid the traction's, thesis (3.47)", "Pa",
                 true);
    s.object("jump", "Given jumps between the two sides; default none", jump).optional();
    return s;
  }

  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    const FluidMesh<3> mesh(sides, operands);
    const double adjoint = adjoint_of(parameters_);
    const Parameters& penalty = parameters_.object("penalty");
    if (!solid_sided())
      return mesh.terms(
          FluidSided{flow_of(sides), jumps(), {parameters_.number("slip_length")}, ties_of(parameters_)});
    if (mesh.moves())
      throw Error(parameters_.where("stress"),
                  fmt::format("`stress: solid` does not go with field '{}', whose mesh moves; use `fluid`",
                              sides.fields[0]->name()));
    const auto law = sides.law(1, "stress");
    if (!law)
      throw Error(
          fmt::format("`stress: solid` needs a body that makes its stress known; field '{}' does not (a "
                      "solid does, unless its formulation is mixed)",
                      sides.fields[1]->name()));
    return {{make_term(SolidSided{law, jumps(), adjoint, penalty.number("solid")}, 1),
             operands,
             {{1, std::make_shared<TraceEigenvalue>(law, scaling_of(parameters_))}}}};
  }

  [[nodiscard]] std::vector<Measure> measures(const CouplingSides& sides) const override {
    const FluidMesh<3> mesh(sides, operands);
    return {mesh.measure("mismatch", VelocityMismatch{jumps()}),
            mesh.measure("body_outflow", Outflow<Rate<Displacement>>{}, MeasureOf::integral)};
  }

 private:
  [[nodiscard]] bool solid_sided() const { return parameters_.text("stress") == "solid"; }
  static Error only(const Location& where, const std::string& key, const std::string& side) {
    return {where, fmt::format("`{}` belongs to `stress: {}`", key, side)};
  }
  [[nodiscard]] Jumps jumps() const {
    if (!parameters_.has("jump")) return {};
    const Parameters& all = parameters_.object("jump");
    return {jump_of(all, "velocity", false), jump_of(all, "stress", true)};
  }
  Parameters parameters_;
};

}  // namespace

void declare_fsi(Registry& registry) {
  registry.add<Coupling>("coupling", "fsi", Fsi::schema(),
                         [](const Parameters& p, const Registry&) { return std::make_unique<Fsi>(p); });
  registry.publishes(
      "coupling", "fsi",
      {{Published::As::series, "mismatch", "m/s m^((d-1)/2)",
        "L2 norm of the fluid's velocity less that of the body"},
       {Published::As::series, "body_outflow", "m^d/s", "rate at which the surface itself moves out"}});
}

}  // namespace seam::fsci
