// SPDX-License-Identifier: BSD-3-Clause
// Which time steps a run takes.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/run_command.hpp"
#include "series.hpp"

using namespace seam_cli_test;

namespace {

/// A block that a load pulls, with a kink in time. @param time the scene's time block
std::string scene(const std::string& load, const std::string& time) {
  return "title: a block\ndimension: 2\nplugins: [solid]\nparameters: {late: 0.2}\n"
         "meshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [2, 2]}}}\n"
         "fields:\n  block:\n    type: solid\n    mesh: block\n    density: 1\n"
         "    material: {type: neo_hookean, young: 10, poisson: 0.3}\n"
         "    boundary: [{on: x_min, displacement: [0, 0]}, {on: x_max, traction: [\"" +
         load +
         "\", 0]}]\noutput: {fields: false, probes: {tip: {field: block, at: [1, 0.5], quantity: "
         "displacement}}}\ntime: " +
         time + "\n";
}

std::vector<double> times(const Folder& folder, const std::string& where) {
  std::vector<double> result;
  for (const auto& row : table(folder.read(where + "/series.csv"))) result.push_back(row[0]);
  return result;
}

Result run(const Folder& folder, const std::string& file, const std::string& where) {
  return seam("run " + file + " --quiet --no-picture --folder " + (folder.path / where).string());
}

bool contains(const std::vector<double>& list, double value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

}  // namespace

TEST_CASE("steps end exactly at the kinks of loads and return to their grid") {
  const Folder folder;
  const std::string file = folder.file(
      "kinks.yaml", scene("t <= 0.3 + late/3 ? 0 : min(t, 0.77)", "{end: 1, step: {initial: 0.1}}"));
  REQUIRE(run(folder, file, "r").code == 0);
  const std::vector<double> taken = times(folder, "r");
  CHECK(contains(taken, 0.3 + 0.2 / 3));
  CHECK(contains(taken, 0.77));
  CHECK(taken.back() == 1);
  REQUIRE(taken.size() == 13);  // the start, ten steps of the grid and two kinks
  CHECK(taken[5] == Approx(0.4));
  CHECK(taken[10] == Approx(0.8));
}

TEST_CASE("kinks are found within conditions, sums and functions; not where only something is recorded") {
  const Folder folder;
  std::string text =
      scene("2*t < 0.5 ? 0 : (0.59 > t - x*0 ? max(0, t - 0.63) : abs(t - 0.85) + 0*min(x, t))",
            "{end: 1, step: {initial: 0.1}}");
  text.replace(text.find("fields: false"), 13, "fields: false, formulas: {begun: t < 0.123}");
  const Result result = run(folder, folder.file("s.yaml", text), "r");
  INFO(result.output);
  REQUIRE(result.code == 0);
  const std::vector<double> taken = times(folder, "r");
  for (const double kink : {0.25, 0.59, 0.63, 0.85}) CHECK(contains(taken, kink));
  CHECK(taken.size() == 15);

  const auto times_of = [&](const std::string& load) {
    REQUIRE(run(folder, folder.file("s.yaml", scene(load, "{end: 1, step: {initial: 0.3}}")), "s").code == 0);
    return times(folder, "s");
  };
  for (const std::string load : {"t < 0.5 == 1", "0.5 > t", "t == 0.5 ? 1 : 0", "t < 0.5 + 0*x ? 0 : 1"})
    CHECK(contains(times_of(load), 0.5));
  // What changes for ever is for the steps to resolve; a kink next to the end is the end.
  CHECK(times_of("sin(1e6*t) > 0").size() == 5);
  CHECK(times_of("t < 0.9999999999").back() == 1);
}

TEST_CASE("a replay takes the steps of another run from the first one on, and ends where it is to end") {
  const Folder folder;
  const auto times_of = [&](const std::string& series) {
    static_cast<void>(folder.file("in.csv", "time,a\n" + series));
    const Result result =
        run(folder, folder.file("s.yaml", scene("t", "{end: 1, step: {initial: 0.1, replay: in.csv}}")), "s");
    INFO(result.output);
    REQUIRE(result.code == 0);
    return times(folder, "s");
  };
  CHECK(times_of("0,1\n0.5,1\n1,1\n") == std::vector<double>{0, 0.5, 1});
  CHECK(times_of("0,1\n0.6,1\n2,1\n") == std::vector<double>{0, 0.6, 1});
  static_cast<void>(folder.file("in.csv", "time,a\n5,1\n6,1\n"));
  const Result other =
      run(folder, folder.file("s.yaml", scene("t", "{end: 1, step: {initial: 0.1, replay: in.csv}}")), "s");
  CHECK(other.code == 2);
  CHECK_THAT(other.output, Catch::Contains("lies within this run"));
}

TEST_CASE("what is left before the end is no step of its own where it is next to nothing") {
  const Folder folder;
  const auto taken = [&](const std::string& end) {
    const std::string file = folder.file("s.yaml", scene("t", "{end: " + end + ", step: {initial: 0.1}}"));
    REQUIRE(run(folder, file, end).code == 0);
    const std::vector<double> all = times(folder, end);
    CHECK(all.back() == std::stod(end));
    return all.size() - 1;
  };
  CHECK(taken("0.5005") == 5);
  CHECK(taken("0.52") == 6);
  CHECK(taken("0.4995") == 5);
}

TEST_CASE("a step whose error in time is too large leaves nothing behind") {
  const Folder folder;
  // The load sets in without a kink, while steps of a body at rest have grown.
  const std::string load = "exp(-((t - 2)/0.05)^2)";
  const std::string adaptive =
      "{end: 3, step: {initial: 0.002, adaptive: true, maximum: 0.2, tolerance: 1e-2";
  REQUIRE(run(folder, folder.file("a.yaml", scene(load, adaptive + "}}")), "first").code == 0);
  REQUIRE(nlohmann::json::parse(folder.read("first/summary.json"))["rejected_steps"].get<int>() > 0);
  CHECK_THAT(folder.read("first/events.jsonl"), Catch::Contains("its error in time is"));
  // Those that were refused do not count where a run is to stop: one step before its end.
  const auto steps = nlohmann::json::parse(folder.read("first/summary.json"))["steps"].get<int>();
  const std::string part = "run " + (folder.path / "a.yaml").string() + " --quiet --no-picture --folder " +
                           (folder.path / "part").string();
  REQUIRE(seam(part + " --stop-after " + std::to_string(steps - 1)).code == 0);
  CHECK(times(folder, "part").size() == static_cast<std::size_t>(steps));
  const std::string again = adaptive + ", replay: first/series.csv}}";
  REQUIRE(run(folder, folder.file("b.yaml", scene(load, again)), "second").code == 0);
  CHECK(nlohmann::json::parse(folder.read("second/summary.json"))["rejected_steps"].get<int>() == 0);
  CHECK(folder.read("first/series.csv") == folder.read("second/series.csv"));
}

TEST_CASE("steps that are refused again and again are not tried each time, also after a restart",
          "[sanitized]") {
  // A wheel that turns evenly: each step is as hard as the one before.
  const std::string text = R"yaml(
title: A wheel
dimension: 3
plugins: [solid]
meshes: {b: {grid: {from: [0, 0, 0], to: [1, 1, 0.2], cells: [1, 1, 1]}}}
fields: {b: {type: rigid_body, mesh: b, density: 1, initial: {rotation_rate: [0.3, 0, 1]}}}
time: {theta: 0.5, end: 40, step: {initial: 0.8}}
solver: {newton: {maximum_iterations: 2}}
output: {fields: false, restart: {every: 1}, probes: {a: {field: b, quantity: rotation}}}
)yaml";
  const Folder folder;
  const std::string file = folder.file("wheel.yaml", text);
  REQUIRE(run(folder, file, "whole").code == 0);
  const auto refused = [&](const std::string& where) {
    return nlohmann::json::parse(folder.read(where + "/summary.json"))["rejected_steps"].get<int>();
  };
  CHECK(refused("whole") > 5);
  CHECK(refused("whole") < 25);  // of 50 steps, each of which fails as it is planned
  const std::vector<double> ends = times(folder, "whole");
  for (int k = 0; k <= 50; ++k)
    CHECK(std::ranges::any_of(ends, [&](double t) { return std::abs(t - 0.8 * k) < 1e-9; }));
  for (const int steps : {9, 20, 100}) {
    const std::string where = std::to_string(steps);
    CAPTURE(steps);
    REQUIRE(run(folder, file + " --stop-after " + where, where).code == 0);
    REQUIRE(run(folder, file + " --resume", where).code == 0);
    CHECK(folder.read(where + "/series.csv") == folder.read("whole/series.csv"));
    CHECK(refused(where) == refused("whole"));
  }
}

TEST_CASE("adaptive steps have the error that is asked for") {
  // dx/dt + x = exp(t), so that x = sinh(t) and its second derivative is x itself: half the step times the
  // change of the rate is h^2/2 of x. Steps aim at 0.9^2 of the tolerance.
  const auto scene = [](double tolerance) {
    return "title: a dashpot\ndimension: 2\nplugins: [solid]\n"
           "meshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [1, 1]}}}\n"
           "fields: {block: {type: rigid_body, mesh: block, translation: [null, 0], rotation: [0], "
           "stiffness: [1, 0], damping: [1, 0], force: [exp(t), 0]}}\n"
           "output: {fields: false, probes: {x: {field: block, quantity: translation, component: x}}}\n"
           "time: {theta: 0.5, end: 3, step: {initial: 1e-3, adaptive: true, maximum: 1, tolerance: " +
           std::to_string(tolerance) + "}}\n";
  };
  const Folder folder;
  for (const double tolerance : {1e-3, 1e-4}) {
    const std::string where = "r" + std::to_string(tolerance);
    const Result result = run(folder, folder.file("a.yaml", scene(tolerance)), where);
    CAPTURE(result.output);
    REQUIRE(result.code == 0);
    const std::string series = folder.read(where + "/series.csv");
    CHECK(column(series, "x").back() == Approx(std::sinh(3)).epsilon(3 * tolerance));
    const std::vector<double> time = times(folder, where);
    int compared = 0;
    for (std::size_t k = 1; k + 1 < time.size(); ++k) {
      if (time[k - 1] < 1) continue;
      CHECK(time[k] - time[k - 1] == Approx(0.9 * std::sqrt(2 * tolerance)).epsilon(0.03));
      ++compared;
    }
    CHECK(compared > 20);
  }
}

TEST_CASE("adaptive steps are small where a load sets in, grow, and can be taken again") {
  const Folder folder;
  const std::string load = "t <= 0.5 ? 0 : 1";
  const std::string adaptive = "{end: 4, step: {initial: 0.02, adaptive: true, tolerance: 1e-2";
  REQUIRE(run(folder, folder.file("a.yaml", scene(load, adaptive + "}}")), "first").code == 0);
  const std::vector<double> first = times(folder, "first");
  const auto kink = std::find(first.begin(), first.end(), 0.5);
  REQUIRE(kink + 1 < first.end());
  CHECK(*(kink + 1) - *kink <= 0.02 + 1e-12);
  CHECK(*kink - *(kink - 1) > 0.05);
  const std::string again = adaptive + ", replay: first/series.csv}}";
  REQUIRE(run(folder, folder.file("b.yaml", scene(load, again)), "second").code == 0);
  CHECK(folder.read("first/series.csv") == folder.read("second/series.csv"));
}

TEST_CASE("an adaptive run that is resumed takes the steps of one that is not") {
  const Folder folder;
  // It swings through rest, where the error is measured against the motion that was.
  const std::string file = folder.file(
      "a.yaml", scene("t <= 0.5 ? 4*t : 0", "{end: 3, step: {initial: 0.02, adaptive: true, maximum: 4}}"));
  REQUIRE(run(folder, file, "whole").code == 0);
  const std::size_t steps = times(folder, "whole").size();
  const std::string part = file + " --set output.restart.every=20 --stop-after " + std::to_string(steps / 2);
  REQUIRE(run(folder, part, "part").code == 0);
  REQUIRE(run(folder, file + " --resume --set output.restart.every=20", "part").code == 0);
  CHECK(folder.read("whole/series.csv") == folder.read("part/series.csv"));
}

TEST_CASE("each unknown of a field sets the pace") {
  // The body is held everywhere: only the fluid in its pores moves, from rest to its drift, within some 0.1
  // s.
  const std::string text = R"yaml(
title: A held sponge
dimension: 2
plugins: [solid, poroelasticity]
meshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [1, 1]}}}
fields:
  block:
    type: porous_solid
    mesh: block
    density: 1
    fluid_density: 1
    viscosity: 1
    permeability: [0.1]
    porosity: {initial: 0.5, bulk: 1000}
    material: {type: neo_hookean, young: 100, poisson: 0.3}
    fluid_body_force: [1, 0]
    boundary:
      - {on: [x_min, x_max], displacement: [0, 0], pore_pressure: 0}
      - {on: [y_min, y_max], displacement: [0, 0], velocity: [null, 0]}
output: {fields: false, probes: {drift: {field: block, at: [0.5, 0.5], quantity: velocity, component: x}}}
time: {end: 1, theta: 1, step: {initial: 1e-3, adaptive: true, maximum: 1, tolerance: 1e-3}}
)yaml";
  const Folder folder;
  const Result result = run(folder, folder.file("a.yaml", text), "r");
  CAPTURE(result.output);
  REQUIRE(result.code == 0);
  // Steps that nothing holds back grow by a half: 17 rows. Its pressure, which is rounding, sets no pace: it
  // would take thousands.
  const std::size_t rows = times(folder, "r").size();
  CHECK(rows > 40);
  CHECK(rows < 200);
}

TEST_CASE("a static problem that does not depend on time is not tried again in vain") {
  const Folder folder;
  const std::string text =
      scene("-1000", "{static: true, end: 1}") + "solver: {newton: {maximum_iterations: 1}}\n";
  const Result result = run(folder, folder.file("crushed.yaml", text), "r");
  CHECK(result.code != 0);
  CHECK_THAT(result.output, Catch::Contains("from t = 0 fails down to a length of 1:"));
}

TEST_CASE("a series that was damaged is not taken again") {
  const Folder folder;
  const std::string file = folder.file("s.yaml", scene("t", "{end: 1, step: {initial: 0.25}}"));
  REQUIRE(run(folder, file, "r").code == 0);
  const std::string whole = folder.read("r/series.csv");
  const auto again = [&](const std::string& series) {
    return seam("check " + file + " --set time.step.replay=" + folder.file("old.csv", series));
  };
  CHECK(again(whole).code == 0);
  // Cut short within the last line: within its first number, within another one, before the end of the line.
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  for (const std::size_t length : {last + 1, last + 8, whole.size() - 1}) {
    const Result result = again(whole.substr(0, length));
    CAPTURE(result.output);
    CHECK(result.code == 2);
    CHECK_THAT(result.output, Catch::Contains("line 6 of ") && Catch::Contains("is not whole"));
  }
  CHECK_THAT(again("timer" + whole.substr(4)).output, Catch::Contains("holds no series of an earlier run"));
  CHECK_THAT(again(whole.substr(0, last) + "2,3\n").output,
             Catch::Contains("found 2 values, expected 7 and the end of the line"));
}
