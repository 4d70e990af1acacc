// SPDX-License-Identifier: BSD-3-Clause
// Static scenes whose loads are too much at once.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "scene_run.hpp"

using namespace seam_cli_test;
using Catch::Matchers::Contains;

namespace {

std::string cavity(const std::string& lid, const std::string& more) {
  return fmt::format(R"yaml(
title: A lid-driven cavity at Reynolds number 1000
dimension: 2
plugins: [cutfem_fluid]
meshes: {{cavity: {{grid: {{from: [0, 0], to: [1, 1], cells: [16, 16]}}}}}}
fields:
  water:
    type: cutfem_fluid
    mesh: cavity
    density: 1
    viscosity: 1e-3
    stabilisation: residual
    boundary:
      - {{on: y_max, velocity: [{}, 0]}}
      - {{on: [x_min, x_max, y_min], velocity: [0, 0]}}
{}
solver: {{newton: {{tolerance: 1e-11}}}}
output: {{fields: false, probes: {{v: {{field: water, at: [0.5, 0.2], quantity: velocity}}}}}}
)yaml",
                     lid, more);
}

std::string membrane(const std::string& load, const std::string& more) {
  return fmt::format(R"yaml(
title: Cook's membrane under a load that Newton's method does not take at once
dimension: 2
plugins: [solid]
meshes: {{membrane: {{grid: {{from: [0, 0], to: [1, 1], cells: [6, 6], map: ["48*x", "44*x + y*(44 - 28*x)"]}}}}}}
fields:
  membrane:
    type: solid
    mesh: membrane
    order: 2
    material: {{type: decoupled_neo_hookean, young: 1098.5, poisson: 0.3}}
    boundary:
      - {{on: x_min, displacement: [0, 0]}}
      - {{on: x_max, traction: [0, "{}"]}}
{}
solver: {{newton: {{tolerance: 1e-11}}}}
output: {{fields: false, probes: {{v: {{field: membrane, at: [48, 60], quantity: displacement}}}}}}
)yaml",
                     load, more);
}

int shares(const Run& run) {
  const auto summary = nlohmann::json::parse(run.folder.read("out/summary.json"));
  return summary.at("newton").back().at("shares");
}

}  // namespace

TEST_CASE("a load that is too much at once is raised by itself, to the state that a ramp ends in") {
  struct Case {
    std::string (*scene)(const std::string&, const std::string&);
    std::string whole, ramp, steps;
  };
  const Case c = GENERATE(Case{cavity, "1", "t", "{initial: 0.25}"},
                          Case{membrane, "625", "625*t", "{initial: 0.0625}"});
  const Run at_once(c.scene(c.whole, ""), "--quiet"),
      ramp(c.scene(c.ramp, "time: {static: true, end: 1, step: " + c.steps + "}"), "--quiet");
  CAPTURE(at_once.done.output, ramp.done.output);
  REQUIRE(at_once.done.code == 0);
  REQUIRE(ramp.done.code == 0);
  CHECK(shares(at_once) > 1);
  CHECK(shares(ramp) == 0);
  for (const std::string of : {"v.x", "v.y"})
    CHECK(std::abs(at_once.series(of).back() / ramp.series(of).back() - 1) < 1e-7);
  const Run ranks(c.scene(c.whole, ""), "--quiet", "mpirun --oversubscribe -np 2");
  CAPTURE(ranks.done.output);
  REQUIRE(ranks.done.code == 0);
  // How many it takes is up to rounding: iterations that diverge magnify it.
  CHECK(shares(ranks) > 1);
  CHECK(std::abs(ranks.series("v.x").back() / at_once.series("v.x").back() - 1) < 1e-9);
}

TEST_CASE("what Newton's method takes at once is not raised by shares") {
  const Run run(membrane("62.5", ""), "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  CHECK(shares(run) == 0);
}

TEST_CASE("where no share leads to all that acts the message says how far they came") {
  // One iteration is enough for no share.
  std::string scene = membrane("625", "");
  scene.replace(scene.find("tolerance: 1e-11"), 16, "tolerance: 1e-11, maximum_iterations: 1");
  const Run run(scene, "--quiet");
  CHECK(run.done.code == 1);
  CHECK_THAT(run.done.output, Contains("not converged after 1 iterations") &&
                                  Contains(", the most at rest at (") &&
                                  Contains("; nor raised little by little, beyond 0 % of what acts"));
}

TEST_CASE("a step that does not converge says where the residual is largest") {
  // Under a pull at its end the rod's strain is uniform in each iteration: inside of it forces cancel.
  const std::string scene = R"yaml(
title: A rod is pulled
dimension: 2
plugins: [solid]
meshes: {rod: {grid: {from: [0, 0], to: [4, 1], cells: [4, 1]}}}
fields:
  rod:
    type: solid
    mesh: rod
    material: {type: neo_hookean, young: 10, poisson: 0}
    boundary:
      - {on: x_min, displacement: [0, null]}
      - {on: [y_min, y_max], displacement: [null, 0]}
      - {on: x_max, traction: [5, 0]}
time: {static: true, end: 1, step: {initial: 1, minimum: 1}}
solver: {newton: {maximum_iterations: 1}}
output: {fields: false}
)yaml";
  for (const std::string with : {"", "mpirun --oversubscribe -np 2"}) {
    const Run run(scene, "--quiet", with);
    CAPTURE(run.done.output);
    CHECK(run.done.code == 1);
    CHECK_THAT(run.done.output, Contains("of rod.displacement, the most at rest at (4, "));
  }
}
