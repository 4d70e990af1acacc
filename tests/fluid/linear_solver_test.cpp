// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <catch2/catch.hpp>

#include "flow_problem.hpp"
#include "seam/field/field.hpp"
#include "solver/krylov.hpp"

using namespace seam;
using namespace seam::test;

namespace {

const std::string channel = R"yaml(
density: 1
viscosity: 0.02
stabilisation: residual
boundary:
  - {on: x_min, velocity: ["16*y*(1 - y)*z*(1 - z)", 0, 0]}
  - {on: [y_min, y_max, z_min, z_max], velocity: [0, 0, 0]}
  - {on: x_max, outflow: do_nothing}
)yaml";

struct Solved {
  int iterations = 0;  ///< most of a linear solve
  std::vector<double> values;
};

/// One time step from rest.
Solved step(int cells, LinearSolver& solver) {
  const auto problem = make_flow({CellType::hexahedron, cells, false}, channel);
  Newton newton(*problem, solver, {1e-9, 1e-5, 15, true});
  problem->initialise(0);
  const TimePoint at = time_point(0.1, 0.1, 1);
  problem->begin_step(at);
  const NewtonReport report = newton.solve(at);
  INFO(report.reason);
  REQUIRE(report.converged);
  Solved result;
  for (const NewtonIteration& iteration : report.history)
    result.iterations = std::max(result.iterations, iteration.linear_iterations);
  for (const Block& block : problem->fields()[0].field->blocks())
    result.values.insert(result.values.end(), block.now.value.begin(), block.now.value.end());
  return result;
}

}  // namespace

TEST_CASE("with a Schur complement iterations do not grow with the mesh") {
  const KrylovOptions options{1e-8, 0, 0, {}};
  KrylovSolver coarse = krylov("schur", options), fine = krylov("schur", options),
               plain = krylov("ilu", options);
  MumpsSolver direct;
  const Solved on_coarse = step(10, coarse), exact = step(10, direct);
  REQUIRE(on_coarse.values.size() == exact.values.size());
  for (std::size_t i = 0; i < exact.values.size(); ++i)
    CHECK(on_coarse.values[i] == Approx(exact.values[i]).epsilon(0).margin(1e-6));
  const int few = step(16, fine).iterations;
  CAPTURE(on_coarse.iterations, few);
  CHECK(few <= on_coarse.iterations + 5);
  CHECK(step(16, plain).iterations > few);
}
