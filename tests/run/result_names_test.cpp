// SPDX-License-Identifier: BSD-3-Clause
// Each number that a run records has a name of its own, and what is asked for exists: said before the first
// step.
#include "scene_run.hpp"

using Catch::Matchers::Contains;
using namespace seam_cli_test;

namespace {

std::string block(const std::string& output, const std::string& checks = "[]") {
  return R"yaml(
title: A block
dimension: 2
plugins: [solid]
parameters: {size: 1}
meshes: {block: {grid: {from: [0, 0], to: [size, 1], cells: [2, 2]}}}
fields:
  block:
    type: solid
    mesh: block
    density: 1
    material: {type: neo_hookean, young: 10, poisson: 0.3}
    boundary: [{on: y_min, displacement: [0, 0]}]
    body_force: [0, -1]
time: {end: 1, step: {initial: 0.25}}
output:
  fields: false
  probes:
    tip: {field: block, at: [1, 1], quantity: displacement}
)yaml" + output +
         "\nchecks: " + checks + "\n";
}

}  // namespace

TEST_CASE("each number of a run has a name of its own") {
  struct Wrong {
    std::string output, says;
  };
  const std::vector<Wrong> all{
      {"  formulas: {time: 1}", "called 'time'"},
      {"  formulas: {t: 1}", "called 't'"},
      {"  formulas: {tip_x: 1}", "called 'tip_x'"},
      {"  formulas: {size: 1}", "a parameter are both called 'size'"},
      {"  formulas: {a: tip_x}\n  statistics: {a: {of: tip.x, what: maximum}}", "called 'a'"},
      {"  statistics: {tip_x: {of: tip.y, what: maximum}}", "called 'tip_x'"},
      {"  statistics: {unknowns: {of: tip.y, what: maximum}}", "a count of the run"},
      {"  statistics: {high: {of: tip.z, what: maximum}}",
       "no result is called 'tip.z'; did you mean 'tip.x'?"},
      {"  formulas: {twice: 2*tip_z}", "unknown name 'tip_z'"},
      {"  errors: {e: {field: block, unknown: velocity, exact: [0, 0]}}", "no unknown 'velocity'"},
      {"  errors: {e: {field: block, unknown: displacement, exact: [0]}}", "expected 2, one a component"},
  };
  for (const Wrong& wrong : all) {
    const Run run(block(wrong.output), "--quiet");
    CAPTURE(wrong.output, run.done.output);
    CHECK(run.done.code == 2);
    CHECK_THAT(run.done.output, Contains(wrong.says));
    CHECK_FALSE(std::filesystem::exists(run.folder.path / "out/series.csv"));
  }
  // Without formulas a parameter may be called like a series.
  CHECK(Run(block("  statistics: {size: {of: tip.x, what: maximum}}")).done.code == 0);
  const Run right(block("  formulas: {a: size*tip_x}\n  statistics: {b: {of: a, what: maximum}}",
                        "[{that: a, at_most: 1, source: x}, {that: b, at_most: 1, source: x}, "
                        "{that: steps.taken, is: 4, within: 0, source: x}]"));
  CAPTURE(right.done.output);
  CHECK(right.done.code == 0);
}

TEST_CASE("a check of a result that is not there is said before the first step") {
  for (const std::string name : {"nope", "size", "time"}) {
    const Run run(block("  formulas: {a: tip_x}", "[{that: " + name + ", at_most: 1, source: x}]"),
                  "--quiet");
    CAPTURE(run.done.output);
    CHECK(run.done.code == 2);
    CHECK_THAT(run.done.output,
               Contains("no result is called '" + name + "'") && !Contains("did you mean ''"));
    CHECK_FALSE(std::filesystem::exists(run.folder.path / "out/series.csv"));
  }
}

TEST_CASE("errors of what is built come all at once") {
  const Run run(block(R"yaml(    far: {field: block, at: [9, 9], quantity: displacement}
    wrong: {field: block, at: [1, 1], quantity: speed}
  interfaces: true
  cut: true
  picture: {field: block, quantity: vorticity})yaml"),
                "--quiet");
  CAPTURE(run.done.output);
  CHECK(run.done.code == 2);
  for (const char* part : {"(9, 9)", "speed", "interfaces: no coupling", "cut: no interface", "vorticity"})
    CHECK_THAT(run.done.output, Contains(part));

  // Interfaces before them, each by itself: a boundary of two faces does not match one of three.
  const std::string apart =
      "--quiet --set meshes.other='{grid: {from: [1, 0], to: [2, 1], cells: [3, 3]}}' --set "
      "fields.other='{type: solid, mesh: other, density: 1, material: {type: neo_hookean, young: 1, poisson: "
      "0.3}}' --set interfaces.first='{type: matching, fields: [block, other], boundaries: [x_max, x_min]}' "
      "--set interfaces.second='{type: matching, fields: [other, block], boundaries: [x_min, x_max]}'";
  const Run both(block(""), apart);
  CAPTURE(both.done.output);
  CHECK(both.done.code == 2);
  CHECK_THAT(both.done.output, Contains("the face of 'block' on boundary 'x_max'") &&
                                   Contains("the face of 'other' on boundary 'x_min'"));
}
