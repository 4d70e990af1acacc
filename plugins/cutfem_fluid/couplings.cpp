// SPDX-License-Identifier: BSD-3-Clause
#include "couplings.hpp"

#include "seam/interface/interface.hpp"
#include "weak_condition.hpp"

namespace seam::fluid {
namespace {

const std::vector<Operand> fluid_side{{0, "velocity"}, {0, "pressure"}};

/// The fluid on side 0. @throws Error when it is none
const Field& fluid_of(const CouplingSides& sides) {
  const Field& field = *sides.fields.at(0);
  for (const Operand& operand : fluid_side) static_cast<void>(field.place(operand.unknown));
  return field;
}

/// A wall whose velocity is given, with Navier slip.
class FluidWall final : public Coupling {
 public:
  explicit FluidWall(const Parameters& parameters) : parameters_(parameters) {}
  static Schema schema() {
    Schema s("A given velocity of the fluid where it meets a body, imposed weakly, with Navier slip.");
    s.reference("on", "Interface with the fluid on side 0", "interface");
    s.vector_expression("velocity", "Velocity of the wall").unit("m/s");
    declare_weak_condition(s);
    return s;
  }
  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    const Field& field = fluid_of(sides);
    const Flow flow{field.constant("density"), field.constant("viscosity"),
                    field.constant("convection") != 0};
    return {{make_term(weak_condition(parameters_, flow, parameters_.vector_expression("velocity")), 1),
             fluid_side}};
  }

 private:
  Parameters parameters_;
};

/// A given traction.
class FluidTraction final : public Coupling {
 public:
  explicit FluidTraction(const Parameters& parameters) : parameters_(parameters) {}
  static Schema schema() {
    Schema s("A given traction on the fluid where it meets a body.");
    s.reference("on", "Interface with the fluid on side 0", "interface");
    s.vector_expression("traction", "Force per area on the fluid").unit("Pa");
    return s;
  }
  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    static_cast<void>(fluid_of(sides));
    return {{make_term(Load{parameters_.vector_expression("traction"), 1.0}, 1), {fluid_side[0]}}};
  }

 private:
  Parameters parameters_;
};

}  // namespace

void declare_couplings(Registry& registry) {
  registry.add<Coupling>("coupling", "fluid_wall", FluidWall::schema(),
                         [](const Parameters& p, const Registry&) { return std::make_unique<FluidWall>(p); });
  registry.add<Coupling>(
      "coupling", "fluid_traction", FluidTraction::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<FluidTraction>(p); });
}

}  // namespace seam::fluid
