// SPDX-License-Identifier: BSD-3-Clause
// Errors on a mesh that moves through space are measured where it is now.
#include "seam/record/error_norms.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "seam/mesh/mesh.hpp"
#include "solver/diffusion.hpp"

using namespace seam;

namespace {

/// c on a mesh that has been stretched to twice its length and to three quarters of its height.
class Stretched final : public Physics {
 public:
  explicit Stretched(bool moves) : moves_(moves) {}
  [[nodiscard]] std::vector<Unknown> unknowns(int dimension) const override {
    return {{"c", 1, 1, 0, ""}, {"shift", dimension, 1, 0, "m", UnknownRole::motion}};
  }
  void build(FieldSetup& setup) const override {
    setup.add_cell_term(make_term(test::Diffusion{}), {"c"});
    setup.set_initial("c", 0, Expression("3 + 4*x", {}));
    setup.set_initial("shift", 0, Expression("x", {}));
    setup.set_initial("shift", 1, Expression("-y/4", {}));
  }
  [[nodiscard]] std::string displacement() const override { return "shift"; }
  [[nodiscard]] bool moves_through_space() const override { return moves_; }

 private:
  bool moves_;
};

ErrorNorms norms(CellType cell, bool moves, const std::string& exact, double slope) {
  Problem problem{Communicator()};
  problem.add_field("body", std::make_shared<Mesh>("box", test::box(cell, 3), Communicator()),
                    std::make_unique<Stretched>(moves));
  problem.finish();
  problem.initialise(0, false);
  std::vector<Expression> gradient(topology(cell).dimension);
  gradient[0] = Expression(slope);
  return error_norms(problem.field("body"), "c", {Expression(exact, {})}, gradient, 0);
}

}  // namespace

TEST_CASE("errors on a moving mesh are those over its present volume", "[ranks]") {
  const CellType cell = GENERATE(CellType::triangle, CellType::quadrilateral, CellType::hexahedron);
  // At the present place X = 2 x, c = 3 + 2 X. The box has grown to 1.5 times its volume.
  const ErrorNorms exact = norms(cell, true, "3 + 2*x", 2);
  CHECK(exact.l2 == Approx(0).margin(1e-12));
  CHECK(*exact.h1 == Approx(0).margin(1e-12));
  const ErrorNorms off = norms(cell, true, "3 + 2*x + 0.5", 2.25);
  CHECK(off.l2 == Approx(0.5 * std::sqrt(1.5)).epsilon(1e-12));
  CHECK(*off.h1 == Approx(0.25 * std::sqrt(1.5)).epsilon(1e-12));
  // A body's unknowns are functions of where its points were.
  const ErrorNorms body = norms(cell, false, "3 + 4*x + 0.5", 4.25);
  CHECK(body.l2 == Approx(0.5).epsilon(1e-12));
  CHECK(*body.h1 == Approx(0.25).epsilon(1e-12));
}
