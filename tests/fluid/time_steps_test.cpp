// SPDX-License-Identifier: BSD-3-Clause
// How long steps are, and what their error in time is, where bodies cut the mesh.
#include <catch2/catch.hpp>
#include <cmath>

#include "cut_flow.hpp"
#include "seam/cut/cut_mesh.hpp"
#include "seam/field/field.hpp"
#include "seam/run/time_error.hpp"

using namespace seam;
using namespace seam::test;

namespace {

struct Prepared {
  explicit Prepared(Overrides overrides)
      : run(SEAM_SOURCE_DIR "/configs/fluid/shear_2d.yaml", std::move(overrides)) {
    session().prepare();
    session().require_held();  // assembles with the tangent
  }
  Session& session() { return run.simulation().session(); }
  FlowRun run;
};

}  // namespace

TEST_CASE(
    "a step that took many iterations is followed by a shorter one, one that took few by a longer one") {
  Prepared flow(
      Overrides{{"time", "{end: 10, step: {initial: 0.1, adaptive: true, tolerance: 0.01, maximum: 1}}"}});
  const Stepper& stepper = flow.session().stepper();
  REQUIRE(stepper.adaptive());
  const double time = 0.15;
  const auto next = [&](double error, int iterations) {
    return stepper.after_success(time, 0.1, 0.1, error, iterations);
  };
  CHECK(next(0, 3) == Approx(0.15));
  CHECK(next(0.01, 3) == Approx(0.09));
  CHECK(next(0.04, 3) == Approx(0.045));
  CHECK(next(1, 3) == Approx(0.03));
  CHECK(next(0, 9) == Approx(0.07));
  CHECK(next(0.04, 9) == Approx(0.045));
  // At a kink, as the end is one, a short step says nothing of the next one.
  CHECK(stepper.after_success(10, 0.05, 0.4, 0, 3) == Approx(0.1));
  CHECK(stepper.after_success(10, 0.05, 0.02, 0, 3) == Approx(0.05));
}

TEST_CASE("a length that goes on failing is tried less and less often, and again where it works") {
  Refusals refusals;
  // Lengths of 1 fail, those of 1/2 do not.
  std::vector<int> taken{0};
  double step = 1;
  for (int attempt = 0; attempt < 400; ++attempt) {
    if (step > 0.75) {
      refusals.refuse(step);
      taken.push_back(0);
      step /= 2;
    } else {
      ++taken.back();
      step = refusals.accept(step, step, 1);
    }
  }
  taken.resize(9);
  CHECK(taken == std::vector<int>{0, 1, 3, 5, 9, 17, 33, 65, 65});
  // One that works now is planned from then on.
  refusals.waiting = 0;
  for (int k = 0; k < 7; ++k) CHECK(refusals.accept(1, 1, 1) == 1);
  CHECK(refusals.length == 0);
  // A single refusal changes nothing of what was planned otherwise.
  refusals.refuse(1);
  CHECK(refusals.accept(0.5, 0.5, 1) == 1);
}

TEST_CASE("the error in time is relative to the largest state so far, and cut cells count by what is wet") {
  Prepared flow(Overrides{});
  Problem& problem = flow.session().problem();
  const FieldEntry& entry = problem.fields()[0];
  const Field& field = *entry.field;
  REQUIRE(field.cut() != nullptr);
  Block& block = entry.field->blocks()[0];
  const Field::ComponentRange velocity = field.place("velocity");
  // Of the first component: 1 everywhere, with a rate of 2 at every third node.
  const auto set = [&](double size) {
    for (auto* level : {&block.now.value, &block.now.rate, &block.old.rate})
      std::fill(level->begin(), level->end(), 0.0);
    for (int n = 0; n < block.space->nodes(); ++n) {
      block.now.value[static_cast<std::size_t>(n) * block.size + velocity.offset] = size;
      block.now.rate[static_cast<std::size_t>(n) * block.size + velocity.offset] = n % 3 == 0 ? 2 : 0;
    }
  };
  double moved = 0, all = 0;
  for (int c = 0; c < field.mesh().owned_cells(); ++c) {
    if (field.active_cells()[c] == 0) continue;
    const double wet = field.is_cut(c) ? field.cut()->wet_volume(c) / field.cut()->cell_volume(c) : 1.0;
    for (int k = 0; k < block.space->nodes_per_cell(); ++k) {
      all += wet;
      moved += wet * (field.cell_nodes(0, c)[k] % 3 == 0 ? 1 : 0);
    }
  }
  std::vector<double> largest(field.unknowns().size(), 0.0);
  const double step = 0.05, expected = 0.5 * step * 2 * std::sqrt(moved / all);
  set(1);
  CHECK(time_error(problem, step, largest) == Approx(expected).epsilon(1e-12));
  // Of what has come to rest: a tenth of the largest.
  set(1e-3);
  CHECK(time_error(problem, step, largest) == Approx(10 * expected).epsilon(1e-12));
  set(0.5);
  CHECK(time_error(problem, step, largest) == Approx(2 * expected).epsilon(1e-12));
}
