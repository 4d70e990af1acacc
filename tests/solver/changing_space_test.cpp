// SPDX-License-Identifier: BSD-3-Clause
// Active unknowns that change between two Newton iterations.
#include <catch2/catch.hpp>

#include "diffusion.hpp"
#include "seam/assembly/assembler.hpp"
#include "seam/mesh/mesh.hpp"

namespace {

using namespace seam;

/// Cells whose first vertex lies left of `front`.
std::vector<char> left_of(const Mesh& mesh, double front) {
  std::vector<char> active(mesh.cells());
  for (int cell = 0; cell < mesh.cells(); ++cell)
    active[cell] = mesh.geometry(cell)[0] < front - 1e-12 ? 1 : 0;
  return active;
}

double value_near(const FieldEntry& entry, double x) {
  const ProbePoint probe(entry, {x, 0.5}, {});
  return probe.evaluate(entry, find_quantity(entry, "c"), time_point(1, 0, 1))[0];
}

}  // namespace

TEST_CASE("unknowns that come alive between two iterations join the solution", "[ranks]") {
  const CellType cell = GENERATE(CellType::quadrilateral, CellType::triangle);
  const test::Options options{1.0, 0.05, 0.0, true, 1, "0"};
  auto problem = test::diffusion_problem(cell, 8, options);
  FieldEntry& entry = problem->fields()[0];
  std::vector<long long> sizes;
  std::vector<double> kept;
  int call = 0;
  problem->add_space_update([&](const TimePoint&) {
    // The domain grows from half to three quarters in iteration 2: a decision of the state alone.
    const double front = call < 2 ? 0.5 : 0.75;
    const bool changed = call == 0 || call == 2;
    if (call == 2) kept.push_back(value_near(entry, 0.25));
    ++call;
    if (changed) problem->occupy(entry, left_of(*entry.mesh, front));
    return changed;
  });
  problem->finish();
  problem->initialise(0);
  const NewtonReport report = test::solve_static(*problem);
  REQUIRE(report.converged);
  REQUIRE(report.history.size() > 3);
  CHECK(report.history[2].space_changed);
  CHECK(problem->assembler().matrix().global_rows == 9 * 7);
  // The first two iterations were not lost: the old unknowns kept their values when the new ones came.
  REQUIRE(kept.size() == 1);
  CHECK(kept[0] > 0.08);

  // The same final domain from the start gives the same solution.
  auto fresh = test::diffusion_problem(cell, 8, options);
  bool first = true;
  fresh->add_space_update([&](const TimePoint&) {
    if (!std::exchange(first, false)) return false;
    fresh->occupy(fresh->fields()[0], left_of(*fresh->fields()[0].mesh, 0.75));
    return true;
  });
  fresh->finish();
  fresh->initialise(0);
  REQUIRE(test::solve_static(*fresh).converged);
  for (const double x : {0.1, 0.3, 0.5, 0.7})
    CHECK(value_near(entry, x) == Approx(value_near(fresh->fields()[0], x)).epsilon(1e-10));
}

TEST_CASE("unknowns that go leave the others and their values in place", "[ranks]") {
  auto problem = test::diffusion_problem(CellType::quadrilateral, 8, {});
  FieldEntry& entry = problem->fields()[0];
  double front = 2;
  bool changed = false;
  problem->add_space_update([&](const TimePoint&) {
    if (!std::exchange(changed, false)) return false;
    problem->occupy(entry, left_of(*entry.mesh, front));
    return true;
  });
  problem->finish();
  problem->initialise(0);
  REQUIRE(test::solve_static(*problem).converged);
  const long long all = problem->assembler().matrix().global_rows;
  const double outside = value_near(entry, 0.9);
  front = 0.5;
  changed = true;
  REQUIRE(test::solve_static(*problem).converged);
  CHECK(problem->assembler().matrix().global_rows == 9 * 5);
  CHECK(all == 9 * 9);
  CHECK(value_near(entry, 0.9) == outside);  // asleep, not lost
}
