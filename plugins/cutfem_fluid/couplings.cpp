// SPDX-License-Identifier: BSD-3-Clause
#include "couplings.hpp"

#include <fmt/format.h>

#include "fluid_fluid.hpp"
#include "seam/field/field.hpp"
#include "seam/interface/adjoint.hpp"
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

Flow flow_of(const Field& field) {
  return {field.constant("density"), field.constant("viscosity"), field.constant("convection") != 0};
}

/// A wall whose velocity is given, with Navier slip.
class FluidWall final : public Coupling {
 public:
  explicit FluidWall(const Parameters& parameters) : parameters_(parameters) {}
  static Schema schema() {
    Schema s("A given velocity of the fluid where it meets a body, imposed weakly, with Navier slip.");
    s.reference("on", "Interface with the fluid on side 0", "interface")
        .of_types({"cut", "embedded", "matching"});
    s.vector_expression("velocity", "Velocity of the wall").unit("m/s");
    declare_weak_condition(s);
    return s;
  }
  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    const Flow flow = flow_of(fluid_of(sides));
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
    s.reference("on", "Interface with the fluid on side 0", "interface")
        .of_types({"cut", "embedded", "matching"});
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

/// Two meshes of one fluid: a patch that moves, and the background that it is cut out of.
class FluidPatch final : public Coupling {
 public:
  explicit FluidPatch(const Parameters& parameters) : parameters_(parameters) {}
  static Schema schema() {
    Schema s("One fluid on two meshes: a patch with a moving mesh, and the background it is cut out of.");
    s.reference("on", "Embedded interface with the background on side 0 and the patch on side 1", "interface")
        .of_types({"embedded"});
    s.number("patch_share", "Weight of the patch's stress in that of the interface, 0 to 1")
        .otherwise("1")
        .at_least(0)
        .at_most(1);
    declare_adjoint(s);
    s.number("penalty", "Factor of Nitsche's penalty, gamma of thesis (3.37)").otherwise("35").above(0);
    s.boolean("upwind", "Keep what convection carries through the interface from bringing in energy")
        .otherwise("true");
    return s;
  }
  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    const Field &background = fluid_of(sides), &patch = *sides.fields.at(1);
    for (const char* unknown : {"velocity", "pressure", "displacement"})
      static_cast<void>(patch.place(unknown));
    const Flow flow = flow_of(background);
    const Flow other = flow_of(patch);
    if (flow.density != other.density || flow.viscosity != other.viscosity ||
        flow.convection != other.convection)
      throw Error(parameters_.where(),
                  fmt::format("'{}' and '{}' are not the same fluid: density {} and {}, viscosity {} and {}, "
                              "convection {} and {}",
                              background.name(), patch.name(), flow.density, other.density, flow.viscosity,
                              other.viscosity, flow.convection, other.convection));
    const FluidFluid kernel{flow, parameters_.number("patch_share"), adjoint_of(parameters_),
                            parameters_.number("penalty"), flow.convection && parameters_.boolean("upwind")};
    return {{make_term(kernel, 1),
             {fluid_side[0], fluid_side[1], {1, "velocity"}, {1, "pressure"}, {1, "displacement"}}}};
  }
  [[nodiscard]] std::vector<Measure> measures(const CouplingSides&) const override {
    return {{"jump", {{make_quantity(FluidJump{}), {fluid_side[0], {1, "velocity"}}}}},
            {"transfer",
             {{make_quantity(FluidTransfer{}), {fluid_side[0], {1, "displacement"}}}},
             MeasureOf::integral}};
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
  registry.add<Coupling>(
      "coupling", "fluid_patch", FluidPatch::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<FluidPatch>(p); });
  registry.publishes(
      "coupling", "fluid_patch",
      {{Published::As::series, "jump", "m/s m^((d-1)/2)", "L2 norm of the difference of the velocities"},
       {Published::As::series, "transfer", "m^d/s",
        "rate at which fluid goes through the border that moves"}});
}

}  // namespace seam::fluid
