// SPDX-License-Identifier: BSD-3-Clause
#include "seam/conformance/scene_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "seam/conformance/tangent.hpp"
#include "seam/run/simulation.hpp"

namespace seam {
namespace {

/// A step from a time, part of the scene's first one long.
TimePoint step_from(const Stepper& stepper, double time, double part = 1) {
  const double length = part * stepper.initial();
  return time_point(time + length, stepper.is_static() ? 0 : length, stepper.theta());
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

bool same_bits(const Problem::Snapshot& a, const Problem::Snapshot& b) {
  using State = Problem::BlockSnapshot;
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const State& x, const State& y) {
    return same_bits(x.now.value, y.now.value) && same_bits(x.now.rate, y.now.rate) &&
           same_bits(x.now.second_rate, y.now.second_rate) && same_bits(x.now.mean_rate, y.now.mean_rate) &&
           same_bits(x.now.mean_second_rate, y.now.mean_second_rate) && x.known == y.known;
  });
}

/// Largest difference of two states, over the largest value.
double relative_difference(const Problem::Snapshot& a, const Problem::Snapshot& b) {
  double difference = 0, largest = 0;
  for (std::size_t s = 0; s < std::min(a.size(), b.size()); ++s) {
    const auto &first = a[s].now.value, &second = b[s].now.value;
    for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i) {
      difference = std::max(difference, std::abs(first[i] - second[i]));
      largest = std::max(largest, std::abs(first[i]));
    }
  }
  return largest > 0 ? difference / largest : difference;
}

ConformanceCheck check_own(const Scene& scene, const Results& results) {
  const auto outcomes = evaluate_checks(scene.root.list("checks"), results);
  std::string wrong;
  for (const CheckResult& c : outcomes)
    if (!c.passed)
      wrong +=
          fmt::format("{}{} = {:.10g}, expected {}", wrong.empty() ? "" : "\n", c.that, c.value, c.expected);
  return conformance_check(
      "the scene's own checks", wrong.empty(),
      wrong.empty() ? fmt::format("{} of {} hold", outcomes.size(), outcomes.size()) : wrong);
}

RunOptions quiet_run(const std::filesystem::path& folder) {
  RunOptions options;
  options.folder = folder;
  options.quiet = true;
  return options;
}

/// Takes a step, goes back, lets a longer one fail, goes back, and takes the first one again.
ConformanceCheck check_rewind(const Scene& scene, const Registry& registry, Problem& problem, double time) {
  const Stepper stepper(scene);
  const auto linear =
      registry.create<LinearSolver>("linear_solver", scene.root.object("solver").object("linear"));
  NewtonOptions options;
  const Parameters& newton = scene.root.object("solver").object("newton");
  options.tolerance = newton.number("tolerance");
  options.increment_tolerance = newton.number("increment_tolerance");
  const auto take = [&](double part, int iterations) {
    options.maximum_iterations = iterations;
    const TimePoint at = step_from(stepper, time, part);
    problem.begin_step(at);
    return Newton(problem, *linear, options).solve(at);
  };
  constexpr int plenty = 50;
  const Problem::Snapshot before = problem.snapshot();
  const NewtonReport first = take(1, plenty);
  if (!first.converged)
    return conformance_check("rewind of a failed step", false,
                             "the step to be repeated fails itself: " + first.reason);
  const Problem::Snapshot once = problem.snapshot();
  problem.restore(before);
  take(1.7, 1);
  problem.restore(before);
  if (!same_bits(problem.snapshot(), before))
    return conformance_check("rewind of a failed step", false, "the states before the step are not restored");
  take(1, plenty);
  const Problem::Snapshot twice = problem.snapshot();
  const bool same = same_bits(once, twice);
  return conformance_check(
      "rewind of a failed step", same,
      same ? "the repeated step is the same to the bit"
           : fmt::format("the repeated step differs by {:.1e} relative: something remembers the "
                         "failed one",
                         relative_difference(once, twice)));
}

ConformanceCheck check_restart(const Scene& scene, const Registry& registry, Simulation& whole,
                               const Results& expected, const std::filesystem::path& folder) {
  Simulation second(scene, registry, Communicator());
  RunOptions options = quiet_run(folder);
  options.resume = true;
  const Results& found = second.run(options);
  std::string differs;
  if (!same_bits(found.time, expected.time)) differs = "the times of the steps";
  for (const auto& [name, values] : expected.series) {
    const auto other = found.series.find(name);
    if (other == found.series.end() || !same_bits(other->second, values))
      differs += (differs.empty() ? "" : ", ") + name;
  }
  const Problem::Snapshot end = second.problem().snapshot(), expected_end = whole.problem().snapshot();
  if (!same_bits(end, expected_end))
    differs += fmt::format("{}the final state, by {:.1e} relative", differs.empty() ? "" : ", ",
                           relative_difference(expected_end, end));
  return conformance_check(
      "restart", differs.empty(),
      differs.empty() ? fmt::format("{} of {} steps after the restart, the same to the bit",
                                    whole.step_number() - whole.step_number() / 2, whole.step_number())
                      : "not as the uninterrupted run: " + differs);
}

}  // namespace

Overrides conformance_overrides() {
  return {{"solver.linear", "direct"},
          {"output.fields", "false"},
          {"output.restart.every", "1"},
          {"output.restart.keep", "1000000"}};
}

std::vector<ConformanceCheck> check_scene(const Scene& scene, const Registry& registry,
                                          const std::filesystem::path& folder) {
  std::vector<ConformanceCheck> checks;
  try {
    Simulation whole(scene, registry, Communicator());
    const Results results = whole.run(quiet_run(folder / "whole"));
    checks.push_back(check_own(scene, results));

    Simulation half(scene, registry, Communicator());
    RunOptions options = quiet_run(folder / "half");
    options.stop_after = whole.step_number() / 2;
    const double time = half.run(options).time.back();
    if (whole.step_number() > 1)
      checks.push_back(check_restart(scene, registry, whole, results, folder / "half"));
    else
      checks.push_back({"restart", ConformanceCheck::Outcome::skipped, "the scene takes one step only"});
    checks.push_back(check_rewind(scene, registry, half.problem(), time));
    const auto tangents = check_tangents(half.problem(), step_from(Stepper(scene), time));
    checks.insert(checks.end(), tangents.begin(), tangents.end());
  } catch (const Error& error) {
    checks.push_back(conformance_check("runs", false, error.what()));
  }
  return checks;
}

}  // namespace seam
