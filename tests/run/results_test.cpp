// SPDX-License-Identifier: BSD-3-Clause
// Numbers that mean nothing do not pass as results.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/run_command.hpp"
#include "series.hpp"

using namespace seam_cli_test;
using Catch::Matchers::Contains;

namespace {

std::string drawn(const std::string& rest) {
  return R"yaml(
title: A block that is drawn
dimension: 2
plugins: [solid]
meshes:
  block: {grid: {from: [0, 0], to: [1, 1], cells: [2, 2]}}
fields:
  block:
    type: solid
    mesh: block
    material: {type: neo_hookean, young: 100, poisson: 0.3}
    boundary: [{on: x_min, displacement: [0, 0]}, {on: x_max, displacement: ["0.1*t", 0]}]
time: {static: true, end: 1, step: {initial: 0.5}}
)yaml" + rest;
}

Result run(const Folder& folder, const std::string& text, const std::string& options = "") {
  return seam("run " + folder.file("scene.yaml", text) + " --quiet --no-picture --folder " +
              (folder.path / "out").string() + options);
}

const std::string tip = "probes: {tip: {field: block, at: [1, 0.5], quantity: displacement, component: x}}";

}  // namespace

TEST_CASE("a check is taken at its time: between two steps, and never beyond the run") {
  const auto outcome = [](const std::string& check) {
    const Folder folder;
    return run(folder, drawn("output: {fields: false, " + tip + "}\nchecks: [{that: tip, " + check +
                             ", within: 1e-9, source: linear in time}]\n"))
        .code;
  };
  CHECK(outcome("at: 0.5, is: 0.05") == 0);
  CHECK(outcome("at: 0.7, is: 0.07") == 0);
  CHECK(outcome("at: 0.7, is: 0.05") == 1);
  CHECK(outcome("at: 8, is: 0.1") == 1);
  CHECK(outcome("at: -1, is: 0") == 1);
}

TEST_CASE("a statistic of too few samples is no number and fails, asked for or not") {
  const std::string what = GENERATE("roughness", "frequency");
  const std::string check = GENERATE("", "checks: [{that: s, at_most: 1e9, source: nothing}]\n");
  const Folder folder;
  const auto outcome = run(folder, drawn("output: {fields: false, " + tip +
                                         ", statistics: {s: {of: tip, what: " + what + "}}}\n" + check));
  CAPTURE(what, check, outcome.output);
  CHECK(outcome.code == 1);
  CHECK_THAT(outcome.output, Catch::Contains("FAIL  s"));
}

TEST_CASE("a formula without a value at the end fails") {
  const Folder folder;
  const auto outcome =
      run(folder, drawn("output: {fields: false, " + tip + ", formulas: {f: sqrt(0 - tip)}}\n"));
  CHECK(outcome.code == 1);
  CHECK_THAT(outcome.output, Catch::Contains("FAIL  f"));
}

TEST_CASE("iterations are those of steps that were taken; rejected steps are counted apart") {
  const Folder folder;
  const auto outcome =
      seam("run " SEAM_SOURCE_DIR "/tests/run/moving_disc.yaml --quiet --no-picture --folder " +
           (folder.path / "out").string() +
           " --set time.step.initial=0.6 --set 'meshes.channel.grid.cells=[60, 30]'");
  CAPTURE(outcome.output);
  const auto summary = nlohmann::json::parse(folder.read("out/summary.json"));
  const long taken = summary["steps"], rejected = summary["rejected_steps"];
  CHECK(rejected > 0);
  const auto& results = summary["results"];
  CHECK(results["steps.taken"] == taken);
  CHECK(results["steps.rejected"] == rejected);
  CHECK(results["newton.iterations.median"] >= 1);
  CHECK(results["newton.iterations.most"] >= results["newton.iterations.median"]);
}

TEST_CASE("a picture that cannot be made is told, and the run is not a good one") {
  const Folder folder;
  const auto with = [&](const std::string& quantity) {
    const std::string scene = folder.file(
        "scene.yaml", drawn("output: {picture: {field: block, quantity: " + quantity + ", width: 200}}\n"));
    return seam("run " + scene + " --overwrite --folder " + (folder.path / "out").string());
  };
  const auto bad = with("von_mises, component: z");
  CAPTURE(bad.output);
  CHECK(bad.code == 1);
  CHECK_THAT(bad.output, Contains("the picture that the scene asks for was not made"));
  const auto good = with("displacement");
  CAPTURE(good.output);
  CHECK(good.code == 0);
}

TEST_CASE("the reaction of what is prescribed is recorded, all of its components") {
  const Folder folder;
  const auto result = run(folder, R"yaml(
title: Seepage through a porous block that stands still
source: Darcy's law, the fluid is pressed in by porosity viscosity velocity length/permeability = 0.005 Pa
dimension: 2
plugins: [solid, poroelasticity]
meshes:
  block: {grid: {from: [0, 0], to: [1, 1], cells: [2, 2]}}
fields:
  block:
    type: porous_solid
    mesh: block
    material: {type: neo_hookean, young: 1e9, poisson: 0}
    viscosity: 1
    porosity: {initial: 0.5}
    permeability: [1]
    boundary:
      - {on: y_min, displacement: [0, 0]}
      - {on: [x_min, x_max], displacement: [0, null], velocity: [0, null]}
      - {on: y_max, velocity: [null, -0.01]}
output: {fields: false, probes: {f: {field: block, on: y_max, quantity: reaction}}}
checks:
  - {that: f.x, kind: exact, is: 0, within: 1e-12, source: symmetry}
  - {that: f.y, kind: exact, is: -0.005, within: 1e-10, source: Darcy's law}
)yaml");
  CAPTURE(result.output);
  CHECK(result.code == 0);
}

TEST_CASE("a known solution that does not fit its field is refused where it stands") {
  const Folder folder;
  const auto told = [&](const std::string& known) {
    const Result result =
        seam("check " +
             folder.file("scene.yaml", drawn("output:\n  errors:\n    e: {field: block, " + known + "}\n")));
    CHECK(result.code == 2);
    return result.output;
  };
  CHECK_THAT(told("unknown: displacment, exact: [0, 0]"),
             Contains("scene.yaml:16:32: error: field 'block' has no unknown 'displacment'; did you mean "
                      "'displacement'?"));
  CHECK_THAT(told("unknown: displacement, exact: [0]"),
             Contains("scene.yaml:16:") && Contains("has 1 entries here; expected 2, one a component"));
  CHECK_THAT(told("unknown: displacement, exact: [0, 0], gradient: [0, 0]"),
             Contains("scene.yaml:16:") && Contains("has 2 entries here; expected 4, derivatives"));
}
