// SPDX-License-Identifier: BSD-3-Clause
#include "stabilisation.hpp"

#include "residual_stabilisation.hpp"

namespace seam::fluid {
namespace {

void declare_jump_constants(Schema& s) {
  s.number("pressure", "gamma_p: jumps of the pressure's derivatives, thesis (2.118)")
      .otherwise("0.05")
      .above(0);
  s.number("convective", "gamma_u: jumps of the velocity's derivatives").otherwise("0.005").at_least(0);
  s.number("divergence", "gamma_div: jumps of the divergence").otherwise("5e-5").at_least(0);
  s.choice("length",
           "The cells' size in these: their `diameter`, or how far they reach `across` the face, for "
           "stretched cells",
           {"diameter", "across"})
      .otherwise("across");
}

JumpConstants jump_constants(const Parameters& parameters) {
  const bool across = parameters.text("length") == "across";
  return {parameters.number("convective"), parameters.number("pressure"), parameters.number("divergence"),
          across ? JumpLength::across : JumpLength::diameter};
}

/// Constants and length beside (2.118).
constexpr JumpConstants jumps_of_the_thesis{
    .convective = 0.05, .pressure = 0.05, .divergence = 5e-5, .length = JumpLength::diameter};

/// Continuous interior penalty, thesis 2.2.4.1.
class InteriorPenaltyStabilisation final : public Stabilisation {
 public:
  explicit InteriorPenaltyStabilisation(const JumpConstants& constants) : constants_(constants) {}
  static Schema schema() {
    Schema s("Continuous interior penalty: jumps of derivatives between all cells.");
    declare_jump_constants(s);
    return s;
  }
  [[nodiscard]] int highest_order() const override { return 2; }
  [[nodiscard]] const JumpConstants& jumps() const override { return constants_; }
  [[nodiscard]] bool follows_mesh() const override { return false; }
  void add(FieldSetup& setup, const OnMesh&, const Flow& flow,
           const std::vector<Expression>&) const override {
    setup.add_interior_face_term(make_term(InteriorPenalty{flow, constants_}), both_sides);
  }

 private:
  JumpConstants constants_;
};

/// Residual-based in cells that no body cuts; cut cells get the interior penalty, on all of their faces.
class ResidualBasedStabilisation final : public Stabilisation {
 public:
  ResidualBasedStabilisation(double momentum, double divergence, const JumpConstants& constants)
      : momentum_(momentum), divergence_(divergence), constants_(constants) {}
  static Schema schema() {
    Schema s("SUPG, PSPG and grad-div in uncut cells, interior penalty around cut ones; for order 1.");
    s.number("momentum", "Factor of tau_M (SUPG, PSPG)").otherwise("0.5").above(0);
    s.number("volume", "Factor of tau_C (grad-div)").otherwise("1").at_least(0);
    declare_jump_constants(s);
    return s;
  }
  [[nodiscard]] int highest_order() const override { return 1; }
  [[nodiscard]] const JumpConstants& jumps() const override { return constants_; }
  [[nodiscard]] bool follows_mesh() const override { return true; }
  void add(FieldSetup& setup, const OnMesh& on_mesh, const Flow& flow,
           const std::vector<Expression>& body_force) const override {
    setup.add_uncut_cell_term(
        on_mesh.term(ResidualStabilisation{flow, body_force, momentum_, divergence_}, 1),
        on_mesh.operands("velocity", "pressure"));
    if (on_mesh.moves) return;
    // All faces, also dry ones: cells that hang on to others by a dry face only would be left out otherwise.
    setup.add_ghost_face_term(GhostFaces::all, make_term(InteriorPenalty{flow, constants_}), both_sides);
  }

 private:
  double momentum_, divergence_;
  JumpConstants constants_;
};

}  // namespace

void declare_stabilisations(Registry& registry) {
  const auto add = [&](const std::string& name, const Schema& schema, const auto& make) {
    registry.add<Stabilisation>(
        "fluid_stabilisation", name, schema,
        [make](const Parameters& p, const Registry&) -> std::unique_ptr<Stabilisation> { return make(p); });
  };
  add("cip", InteriorPenaltyStabilisation::schema(),
      [](const Parameters& p) { return std::make_unique<InteriorPenaltyStabilisation>(jump_constants(p)); });
  add("residual", ResidualBasedStabilisation::schema(), [](const Parameters& p) {
    return std::make_unique<ResidualBasedStabilisation>(p.number("momentum"), p.number("volume"),
                                                        jump_constants(p));
  });
  const std::string numbers =
      "convective 0.05, pressure 0.05, divergence 5e-5, length diameter; stays when defaults change.";
  add("thesis", Schema("Interior penalty as in the thesis: `cip` with " + numbers),
      [](const Parameters&) { return std::make_unique<InteriorPenaltyStabilisation>(jumps_of_the_thesis); });
  add("residual_thesis", Schema("`residual` with the thesis' numbers: momentum 1, volume 1, " + numbers),
      [](const Parameters&) {
        return std::make_unique<ResidualBasedStabilisation>(1.0, 1.0, jumps_of_the_thesis);
      });
}

}  // namespace seam::fluid
