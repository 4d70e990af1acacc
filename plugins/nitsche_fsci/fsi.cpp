// SPDX-License-Identifier: BSD-3-Clause
#include "fsi.hpp"

#include "fluid_sided.hpp"
#include "seam/interface/interface.hpp"

namespace seam::fsci {
namespace {

/// No slip, or Navier slip, between a fluid and a deforming body.
class Fsi final : public Coupling {
 public:
  explicit Fsi(const Parameters& parameters) : parameters_(parameters) {}

  static Schema schema() {
    Schema s("A fluid and a deforming body that move together and share their traction.");
    s.reference("on", "Interface with the fluid on side 0 and the body on side 1", "interface");
    s.number("slip_length", "Navier's: 0 is no slip, .inf leaves the body to glide freely")
        .unit("m")
        .otherwise("0")
        .at_least(0)
        .or_infinite();
    s.choice("adjoint", "Viscous adjoint term: `skew` (xi = 1) is stable for every penalty",
             {"skew", "symmetric", "none"})
        .otherwise("skew");
    Schema penalty("Factors of Nitsche's penalty, thesis (3.26), (3.27).");
    penalty.number("normal", "For the velocity across the interface").otherwise("35").above(0);
    penalty.number("tangential", "For the velocity along it").otherwise("35").above(0);
    s.object("penalty", "Factors of Nitsche's penalty", penalty).otherwise("{}");
    return s;
  }

  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    const std::vector<Operand> operands{{0, "velocity"}, {0, "pressure"}, {1, "displacement"}};
    for (const Operand& operand : operands)
      static_cast<void>(sides.fields.at(operand.side)->place(operand.unknown));
    const Field& fluid = *sides.fields[0];
    const std::string& adjoint = parameters_.text("adjoint");
    const FluidSided kernel{
        {fluid.constant("density"), fluid.constant("viscosity"), fluid.constant("convection") != 0},
        parameters_.number("slip_length"),
        adjoint == "skew" ? 1.0 : (adjoint == "symmetric" ? -1.0 : 0.0),
        parameters_.object("penalty").number("normal"),
        parameters_.object("penalty").number("tangential")};
    return {{make_term(kernel, 1), operands}};
  }

 private:
  Parameters parameters_;
};

}  // namespace

void declare_fsi(Registry& registry) {
  registry.add<Coupling>("coupling", "fsi", Fsi::schema(),
                         [](const Parameters& p, const Registry&) { return std::make_unique<Fsi>(p); });
}

}  // namespace seam::fsci
