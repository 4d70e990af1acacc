// SPDX-License-Identifier: BSD-3-Clause
#include "seam/conformance/scene_checks.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "seam/assembly/assembler.hpp"
#include "seam/base/plugin_fault.hpp"
#include "seam/conformance/constraints.hpp"
#include "seam/conformance/given_values.hpp"
#include "seam/conformance/tangent.hpp"
#include "seam/field/field.hpp"
#include "seam/record/evaluate.hpp"
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

/// Collects what is made but not declared.
class Undeclared {
 public:
  Undeclared(const Registry& registry, std::string kind, const std::vector<std::string>& types)
      : kind_(std::move(kind)), types_(types) {
    for (const std::string& type : types)
      for (const Published& p : registry.published(kind_, type)) units_[{p.as, p.name}] = p.unit;
  }
  /// @param unit null where what is made has none of its own
  void find(Published::As as, const std::string& name, const std::string* unit, std::string& wrong) const {
    const auto declared = units_.find({as, name});
    const std::string of = fmt::format("{}{} '{}' of {} '{}'", wrong.empty() ? "" : "\n",
                                       as == Published::As::series ? "the series" : "the quantity", name,
                                       kind_, fmt::join(types_, "', '"));
    if (declared == units_.end())
      wrong += of + " is not declared by Registry::publishes, so that `seam explain` leaves it out";
    else if (unit && *unit != declared->second)
      wrong += fmt::format("{} has the unit '{}', declared is '{}'", of, *unit, declared->second);
  }

 private:
  std::string kind_;
  std::vector<std::string> types_;
  std::map<std::pair<Published::As, std::string>, std::string> units_;
};

std::vector<std::string> couplings_on(const Scene& scene, const std::string& interface) {
  std::vector<std::string> types;
  for (const Parameters& coupling : scene.root.list("coupling"))
    if (coupling.text("on") == interface) types.push_back(coupling.type());
  return types;
}

/// Of an unknown that a coupling has brought, `interface.name`: both parts.
std::pair<std::string, std::string> brought_to(const Problem& problem, const std::string& unknown) {
  const std::size_t dot = unknown.find('.');
  const std::string interface = dot == std::string::npos ? "" : unknown.substr(0, dot);
  if (interface.empty() || !problem.interfaces().contains(interface)) return {};
  return {interface, unknown.substr(dot + 1)};
}

/// What `seam explain` says of the types against what the scene gets of them.
ConformanceCheck check_published(const Scene& scene, const Registry& registry, Problem& problem) {
  std::string wrong;
  std::size_t count = 0;
  for (const auto& [name, parameters] : scene.root.map("fields")) {
    const Undeclared undeclared(registry, "field", {parameters.type()});
    const FieldEntry& entry = problem.field(name);
    for (const Unknown& unknown : entry.field->unknowns())
      if (const auto [interface, rest] = brought_to(problem, unknown.name); interface.empty())
        undeclared.find(Published::As::quantity, unknown.name, &unknown.unit, wrong);
      else
        Undeclared(registry, "coupling", couplings_on(scene, interface))
            .find(Published::As::quantity, rest, &unknown.unit, wrong);
    for (const FieldQuantity& output : entry.outputs)
      undeclared.find(Published::As::quantity, output.name, nullptr, wrong);
    for (const FieldQuantity& integral : entry.integrals)
      undeclared.find(Published::As::series, integral.name, nullptr, wrong);
    count += entry.field->unknowns().size() + entry.outputs.size() + entry.integrals.size();
  }
  for (const InterfaceMeasure& measure : problem.measures()) {
    Undeclared(registry, "coupling", couplings_on(scene, measure.interface))
        .find(Published::As::series, measure.name, nullptr, wrong);
    ++count;
  }
  return conformance_check("quantities and series are declared", wrong.empty(),
                           wrong.empty() ? fmt::format("{} of {}", count, count) : wrong);
}

RunOptions quiet_run(const std::filesystem::path& folder) {
  RunOptions options;
  options.folder = folder;
  options.quiet = true;
  return options;
}

/// Takes a step, goes back, lets a longer one fail, goes back, and takes the first one again. Whatever
/// differs then has been remembered by somebody else than the store of states.
ConformanceCheck check_rewind(Session& half) {
  const std::string name = "rewind of a failed step";
  const StateStore& states = half.problem().state();
  TimeStep& step = half.time_step();
  const double from = half.state().time, length = half.stepper().initial();
  const auto take = [&](double part, int iterations) {
    step.begin(from, from + part * length, half.last_step());
    for (int k = 0; k < iterations && step.iterate(); ++k) continue;
  };
  constexpr int plenty = 1000;
  const StateStore::Snapshot before = states.snapshot(from);
  take(1, plenty);
  if (!step.report().converged)
    return conformance_check(name, false, "the step to be repeated fails itself: " + step.report().reason);
  const StateStore::Snapshot once = states.snapshot(from);
  step.rewind();
  take(1.7, 2);
  step.rewind();
  if (const auto names = differences(states, states.snapshot(from), before); !names.empty())
    return conformance_check(
        name, false, fmt::format("the states before the step are not restored: {}", fmt::join(names, ", ")));
  take(1, plenty);
  const StateStore::Snapshot twice = states.snapshot(from);
  const auto names = differences(states, once, twice);
  return conformance_check(
      name, names.empty(),
      names.empty()
          ? "the repeated step is the same to the bit"
          : fmt::format("the repeated step differs by {:.1e} relative in {}: something remembers the "
                        "failed one",
                        relative_difference(once, twice), fmt::join(names, ", ")));
}

ConformanceCheck check_restart(const Scene& scene, const Registry& registry, Simulation& whole,
                               const Results& expected, const std::filesystem::path& folder) {
  Simulation second(scene, registry, Communicator());
  const long steps = whole.session().state().step_number;
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
  const StateStore& states = second.problem().state();
  const StateStore::Snapshot end = states.snapshot(0), expected_end = whole.problem().state().snapshot(0);
  if (const auto names = differences(states, end, expected_end); !names.empty())
    differs += fmt::format("{}at the end {}, by {:.1e} relative", differs.empty() ? "" : ", ",
                           fmt::join(names, ", "), relative_difference(expected_end, end));
  return conformance_check(
      "restart", differs.empty(),
      differs.empty()
          ? fmt::format("{} of {} steps after the restart, the same to the bit", steps - steps / 2, steps)
          : "not as the uninterrupted run: " + differs);
}

/// At the start, where bodies are at rest and much is zero, as no shaken state is: the slope of sqrt(x) at 0
/// is no number. Whether slopes are right there cannot be said: what has a kink has it at rest.
ConformanceCheck check_start(const Scene& scene, const Registry& registry) {
  Session start(scene, registry, Communicator());
  start.prepare();
  const TimePoint at = step_from(start.stepper(), start.stepper().start());
  Problem& problem = start.problem();
  problem.assembler().assemble(at, true);
  // What is written for pictures, too: a run of the kit writes none.
  for (const FieldEntry& entry : problem.fields())
    for (const FieldQuantity& output : entry.outputs)
      static_cast<void>(
          nodal_values(entry, *entry.field->blocks().front().space, find_quantity(entry, output.name), at));
  const bool finite = problem.assembler().is_finite();
  return conformance_check("finite at the start", finite,
                           finite ? "all terms and their derivatives"
                                  : "at the start" + problem.assembler().describe_not_finite(at));
}

}  // namespace

Overrides conformance_overrides(const PluginInfo& plugin) {
  Overrides overrides = {
      {"output.fields", "false"}, {"output.restart.every", "1"}, {"output.restart.keep", "1000000"}};
  const bool brings_solvers = std::ranges::any_of(plugin.provides, [](const auto& type) {
    return type.first == "linear_solver" || type.first == "block_inverse";
  });
  if (!brings_solvers) overrides.insert(overrides.begin(), {"solver.linear", "direct"});
  return overrides;
}

std::vector<ConformanceCheck> check_scene(const Scene& scene, const Registry& registry,
                                          const std::filesystem::path& folder,
                                          const std::function<void(const std::string&)>& begins) {
  std::vector<ConformanceCheck> checks;
  std::string doing;
  const auto begin = [&](const std::string& what) { begins(doing = what); };
  try {
    begin("derivatives at the start");
    checks.push_back(check_start(scene, registry));
    begin("runs");
    Simulation whole(scene, registry, Communicator());
    const Results results = whole.run(quiet_run(folder / "whole"));
    checks.push_back(check_own(scene, results));
    checks.push_back(check_published(scene, registry, whole.problem()));

    begin("restart");
    Simulation half(scene, registry, Communicator());
    RunOptions options = quiet_run(folder / "half");
    const long steps = whole.session().state().step_number;
    options.stop_after = steps / 2;
    const double time = half.run(options).time.back();
    if (steps > 1)
      checks.push_back(check_restart(scene, registry, whole, results, folder / "half"));
    else
      checks.push_back({"restart", ConformanceCheck::Outcome::skipped, "the scene takes one step only"});
    begin("rewind of a failed step");
    checks.push_back(check_rewind(half.session()));
    const TimePoint at = step_from(half.session().stepper(), time);
    begin("ties of unknowns");
    const auto ties = check_constraints(half.problem(), at);
    checks.insert(checks.end(), ties.begin(), ties.end());
    begin("rates of given values");
    const auto given = check_given_values(half.problem(), at.time);
    checks.insert(checks.end(), given.begin(), given.end());
    begin("tangents");
    const auto tangents = check_tangents(half.problem(), at);
    checks.insert(checks.end(), tangents.begin(), tangents.end());
  } catch (...) {
    checks.push_back(conformance_check(doing, false, text_of_exception()));
  }
  return checks;
}

}  // namespace seam
