// SPDX-License-Identifier: BSD-3-Clause
// A node that holds the level of an unknown that is determined but for a constant.
#include <catch2/catch.hpp>

#include "diffusion.hpp"
#include "seam/mesh/mesh.hpp"

namespace {

using namespace seam;

/// Diffusion without a source whose level is 5 wherever nothing else gives one.
class Levelled final : public Physics {
 public:
  explicit Levelled(bool prescribed) : prescribed_(prescribed) {}
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override { return {{"c", 1, 1, 0, ""}}; }
  void build(FieldSetup& setup) const override {
    setup.add_cell_term(make_term(test::Diffusion{0}), {"c"});
    setup.fix_level("c", 5, {});
    if (prescribed_) setup.prescribe("x_min", "c", 0, Expression(1.0), {});
  }

 private:
  bool prescribed_;
};

std::vector<double> solution(bool prescribed, bool occupied_again) {
  Problem problem{Communicator()};
  problem.add_field("body",
                    std::make_shared<Mesh>("box", test::box(CellType::quadrilateral, 4), Communicator()),
                    std::make_unique<Levelled>(prescribed));
  problem.finish();
  FieldEntry& entry = problem.fields()[0];
  if (occupied_again) problem.occupy(entry, std::vector<char>(entry.mesh->cells(), 1));
  problem.initialise(0);
  REQUIRE(test::solve_static(problem).converged);
  std::vector<double> values;
  for (const double x : {0.0, 0.3, 1.0})
    for (const double y : {0.0, 1.0})
      values.push_back(
          ProbePoint(entry, {x, y}, {}).evaluate(entry, find_quantity(entry, "c"), time_point(1, 0, 1))[0]);
  return values;
}

}  // namespace

TEST_CASE("a level is held where nothing else gives it, and nowhere else", "[ranks]") {
  const bool occupied_again = GENERATE(false, true);
  for (const double value : solution(false, occupied_again)) CHECK(value == Approx(5));
  // The node that would hold it lies on the boundary where 1 is prescribed.
  for (const double value : solution(true, occupied_again)) CHECK(value == Approx(1));
}
