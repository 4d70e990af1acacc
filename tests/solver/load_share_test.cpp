// SPDX-License-Identifier: BSD-3-Clause
// A part of what acts.
#include "seam/solve/load_share.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "diffusion.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"

namespace {

using namespace seam;
using test::c;

/// (dc, 2 c^2 + 3 c - 5), from 0.2.
struct Parabola {
  using Reads = Slots<Value<c>>;
  using Tests = Slots<Value<c>>;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(c{}) += 2.0 * s.value(c{}) * s.value(c{}) + 3.0 * s.value(c{}) - 5.0;
  }
};

class Everywhere final : public Physics {
 public:
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override { return {{"c", 1, 1, 0, ""}}; }
  void build(FieldSetup& setup) const override {
    setup.add_cell_term(make_term(Parabola{}), {"c"});
    setup.set_initial("c", 0, Expression(0.2));
  }
};

const std::vector<double>& solve(Problem& problem, const TimePoint& at) {
  MumpsSolver solver;
  Newton newton(problem, solver, {1e-12, 1e-8, 25, true});
  REQUIRE(newton.solve(at).converged);
  return problem.fields()[0].field->blocks()[0].now.value;
}

}  // namespace

TEST_CASE("of the residual at the start the share that does not act is left out") {
  Problem problem{Communicator()};
  problem.add_field("body",
                    std::make_shared<Mesh>("box", test::box(CellType::quadrilateral, 2), Communicator()),
                    std::make_unique<Everywhere>());
  problem.finish();
  problem.initialise(0);
  const TimePoint at = time_point(1, 0, 1);
  problem.begin_step(at);
  {
    LoadShare load(problem, at);
    for (const double share : {0.0, 0.25, 0.5}) {
      load.set(share);
      const double root = (-3 + std::sqrt(9 + 8 * (5 - (1 - share) * 4.32))) / 4;
      for (const double value : solve(problem, at)) CHECK(std::abs(value - root) < 1e-12);
    }
  }
  for (const double value : solve(problem, at)) CHECK(std::abs(value - 1) < 1e-12);
}

TEST_CASE("a share of a source and of what is prescribed is a smaller source and a smaller value") {
  const TimePoint at = time_point(1, 0, 1);
  const auto begun = [&](const test::Options& options) {
    auto problem = test::diffusion_problem(CellType::triangle, 3, options);
    problem->finish();
    problem->initialise(0, false);
    problem->begin_step(at);
    return problem;
  };
  const auto whole = begun({.source = 1, .value = "2"});
  LoadShare load(*whole, at);
  load.set(0.25);
  const std::vector<double> share = solve(*whole, at);
  const auto other = begun({.source = 0.25, .value = "0.5"});
  const std::vector<double>& smaller = solve(*other, at);
  REQUIRE(share.size() == smaller.size());
  for (std::size_t i = 0; i < share.size(); ++i) CHECK(std::abs(share[i] - smaller[i]) < 1e-12);
  CHECK(*std::ranges::max_element(share) > 0.4);
}

TEST_CASE("what comes to be prescribed while a share acts is so as a whole") {
  const TimePoint at = time_point(1, 0, 1);
  auto problem = test::diffusion_problem(CellType::triangle, 3, {.value = "2"});
  problem->finish();
  problem->initialise(0, false);
  problem->begin_step(at);
  Block& block = problem->fields()[0].field->blocks()[0];
  const auto free =
      static_cast<std::size_t>(std::ranges::find(block.prescribed, 0) - block.prescribed.begin());
  {
    LoadShare load(*problem, at);
    load.set(0.25);
    block.prescribed[free] = 1;
    block.prescribed_value[free] = 3;
    load.set(0.5);
    CHECK(block.prescribed_value[free] == 3);
    CHECK(*std::ranges::min_element(block.prescribed_value) >= 0);
    CHECK(std::ranges::count(block.prescribed_value, 1.0) > 0);  // half of 2
  }
  CHECK(block.prescribed_value[free] == 3);
  CHECK(std::ranges::count(block.prescribed_value, 2.0) > 0);
}
