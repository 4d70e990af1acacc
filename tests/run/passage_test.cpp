// SPDX-License-Identifier: BSD-3-Clause
// Bodies do not pass through each other, whatever the step; and what slides off or flies off goes on.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/run_command.hpp"
#include "series.hpp"

using namespace seam_cli_test;

namespace {

/// A block that lies on the ground, and a smaller one above it with a gap of 0.05.
std::string pair(const std::string& upper, const std::string& rest) {
  return R"yaml(
title: A block above another one
dimension: 2
plugins: [solid, nitsche_fsci]
meshes:
  lower: {grid: {from: [0, 0], to: [2, 0.5], cells: [16, 4]}}
  upper: {grid: {from: [0.73, 0.55], to: [1.23, 1.05], cells: [4, 4]}}
fields:
  lower:
    type: solid
    mesh: lower
    density: 1
    material: {type: neo_hookean, young: 1000, poisson: 0.3}
    boundary: [{on: y_min, displacement: [0, 0]}]
  upper:
    type: solid
    mesh: upper
    density: 1
    material: {type: neo_hookean, young: 1000, poisson: 0.3}
)yaml" + upper +
         R"yaml(
interfaces:
  down: {type: contact, from: upper, to: lower}
  up: {type: contact, from: lower, to: upper}
coupling: [{type: contact, on: down}, {type: contact, on: up}]
output:
  fields: false
  probes:
    foot: {field: upper, at: [0.98, 0.55], quantity: displacement}
)yaml" + rest;
}

struct Outcome {
  int code;
  std::string output;
  std::vector<double> time, x, y, gap;
};

Outcome run(const std::string& text) {
  const Folder folder;
  const auto done = seam("run " + folder.file("scene.yaml", text) + " --quiet --no-picture --folder " +
                         (folder.path / "out").string());
  Outcome outcome{done.code, done.output, {}, {}, {}, {}};
  const std::string series = folder.read("out/series.csv");
  if (series.empty()) return outcome;
  outcome.time = column(series, "time");
  outcome.x = column(series, "foot.x");
  outcome.y = column(series, "foot.y");
  outcome.gap = column(series, "down.gap");
  return outcome;
}

/// Half the diameter of the lower block's cells, the default depth.
constexpr double depth = 0.0884;

}  // namespace

TEST_CASE("a block is not pushed through another one by a long static step") {
  const double step = GENERATE(0.5, 0.25, 0.1);
  const Outcome outcome =
      run(pair("    boundary: [{on: y_max, displacement: [0, \"-2*t\"]}]\n",
               fmt::format("time: {{static: true, end: 0.5, step: {{initial: {}}}}}\n", step)));
  CAPTURE(step, outcome.output);
  // The lower block cannot be crushed to nothing: the run gives up, but up to then surfaces face each other.
  REQUIRE(outcome.y.size() > 3);
  CHECK(outcome.y.back() < -0.1);
  for (const double gap : outcome.gap) CHECK(std::abs(gap) < depth);
}

TEST_CASE("a fast block does not get behind what it hits") {
  const double step = GENERATE(0.1, 0.05, 0.02);
  const Outcome outcome =
      run(pair("    initial: {velocity: [0, -10]}\n",
               fmt::format("time: {{theta: 1, end: 0.2, step: {{initial: {}}}}}\n", step)));
  CAPTURE(step, outcome.output);
  CHECK(outcome.code == 0);
  for (const double gap : outcome.gap) CHECK(gap > -depth);
  // It has hit, and comes back.
  REQUIRE(outcome.y.size() > 2);
  CHECK(*std::ranges::min_element(outcome.y) < -0.04);
  CHECK(outcome.y.back() > *std::ranges::min_element(outcome.y));
}

TEST_CASE("a block slides off an edge in one step") {
  // Pressed onto the lower block, then drawn over its edge and down beside it.
  const Outcome outcome =
      run(pair("    boundary: [{on: y_max, displacement: [\"t < 1 ? 0 : 2*(t - 1)\", \"t < 1 ? -0.055*t : "
               "-0.055\"]}]\n",
               "time: {static: true, end: 2, step: {initial: 0.25}}\n"));
  CAPTURE(outcome.output);
  CHECK(outcome.code == 0);
  REQUIRE_FALSE(outcome.x.empty());
  CHECK(outcome.x.back() == Approx(2).margin(0.01));
}

TEST_CASE("a block leaves farther than surfaces look in one step") {
  const Outcome outcome =
      run(pair("    boundary: [{on: y_max, displacement: [0, \"t < 1 ? -0.055*t : 3*(t - 1)\"]}]\n",
               "time: {static: true, end: 2, step: {initial: 1}}\n"));
  CAPTURE(outcome.output);
  CHECK(outcome.code == 0);
  REQUIRE_FALSE(outcome.y.empty());
  CHECK(outcome.y.back() == Approx(3).margin(0.01));
}

TEST_CASE("an obstacle does not get through a body in one step, nor a body through it") {
  const double step = GENERATE(0.5, 0.1);
  const Folder folder;
  const std::string scene = fmt::format(R"yaml(
title: A stamp of given motion
dimension: 2
plugins: [solid, nitsche_fsci]
meshes:
  lower: {{grid: {{from: [0, 0], to: [2, 0.5], cells: [16, 4]}}}}
fields:
  lower:
    type: solid
    mesh: lower
    density: 1
    material: {{type: neo_hookean, young: 1000, poisson: 0.3}}
    boundary: [{{on: y_min, displacement: [0, 0]}}]
interfaces:
  stamp:
    type: obstacle
    from: lower
    body: {{type: box, from: [0.73, 0.55], to: [1.23, 1.05]}}
    motion: {{translation: [0, "-4*t"]}}
coupling: [{{type: contact, on: stamp}}]
time: {{theta: 1, end: 0.5, step: {{initial: {}, minimum: 1e-3}}}}
output: {{fields: false, probes: {{top: {{field: lower, at: [0.98, 0.5], quantity: displacement}}}}}}
)yaml",
                                        step);
  const auto done = seam("run " + folder.file("scene.yaml", scene) + " --quiet --no-picture --folder " +
                         (folder.path / "out").string());
  CAPTURE(step, done.output);
  // The stamp's foot is at 0.55 - 4 t: the body's top is never above it by more than the depth.
  const std::string series = folder.read("out/series.csv");
  const auto time = column(series, "time"), top = column(series, "top.y");
  for (std::size_t k = 0; k < time.size(); ++k) CHECK(top[k] < 0.05 - 4 * time[k] + 0.09);
}

TEST_CASE("a rigid disc does not sink through a soft floor, however that is turned") {
  const double angle = GENERATE(0.0, 0.2, -0.7, 1.5707963267948966);
  CAPTURE(angle);
  const Folder folder;
  // It falls by more than the floor can hold.
  const std::string scene = fmt::format(R"yaml(
title: A disc that falls on a soft floor
dimension: 2
plugins: [solid, nitsche_fsci]
parameters: {{a: {}, c: cos(a), s: sin(a)}}
meshes:
  disc:
    grid:
      from: [-1, -1]
      to: [1, 1]
      cells: [6, 6]
      map: ["c*0.2*x*sqrt(1 - y^2/2) - s*(0.25 + 0.2*y*sqrt(1 - x^2/2))", "s*0.2*x*sqrt(1 - y^2/2) + c*(0.25 + 0.2*y*sqrt(1 - x^2/2))"]
fields:
  disc: {{type: rigid_body, mesh: disc, density: 100, body_force: [9.81*s, -9.81*c]}}
  skin: {{type: rigid_surface, mesh: disc}}
constraints: [{{type: rigid, field: skin, body: disc}}]
interfaces: {{floor: {{type: obstacle, from: skin, body: {{type: box, from: [-5, -1], to: [5, 0]}}, motion: {{rotation: a}}, reach: 0.2, depth: 0.1}}}}
coupling: [{{type: contact, on: floor, surface_stiffness: 1e4}}]
time: {{theta: 0.5, end: 0.4, step: {{initial: 2e-3, minimum: 1e-5}}}}
output: {{fields: false}}
)yaml",
                                        angle);
  const auto done = seam("run " + folder.file("scene.yaml", scene) + " --quiet --no-picture --folder " +
                         (folder.path / "out").string());
  CAPTURE(done.output);
  CHECK(done.code == 1);
  CHECK_THAT(done.output, Catch::Contains("the surface of 'skin' has passed through an obstacle") &&
                              Catch::Contains("more than the interface's `depth` of 0.1 m") &&
                              Catch::Contains("as `gap` tells") &&
                              Catch::Contains("a greater `surface_stiffness`") &&
                              Catch::Contains("(interface 'floor', ") && Catch::Contains("scene.yaml:17:"));
  const std::string series = folder.read("out/series.csv");
  const auto gap = column(series, "floor.gap");
  CHECK(*std::ranges::min_element(gap) > -0.1);
  CHECK(gap.back() < -0.095);
  CHECK(column(series, "time").back() == Approx(0.183).epsilon(0.02));
}

TEST_CASE("in space a block is not pushed through another one by a long step", "[study]") {
  const Folder folder;
  const auto done = seam("run " + folder.file("scene.yaml", R"yaml(
title: A block above another one
dimension: 3
plugins: [solid, nitsche_fsci]
meshes:
  lower: {grid: {from: [0, 0, 0], to: [1, 1, 0.5], cells: [5, 5, 3]}}
  upper: {grid: {from: [0.23, 0.27, 0.53], to: [0.73, 0.77, 0.93], cells: [2, 2, 2]}}
fields:
  lower:
    type: solid
    mesh: lower
    material: {type: neo_hookean, young: 1000, poisson: 0.3}
    boundary: [{on: z_min, displacement: [0, 0, 0]}]
  upper:
    type: solid
    mesh: upper
    material: {type: neo_hookean, young: 1000, poisson: 0.3}
    boundary: [{on: z_max, displacement: [0, 0, "-t"]}]
interfaces:
  down: {type: contact, from: upper, to: lower}
  up: {type: contact, from: lower, to: upper}
coupling: [{type: contact, on: down}, {type: contact, on: up}]
time: {static: true, end: 1, step: {initial: 1, minimum: 0.05}}
output: {fields: false}
)yaml") + " --quiet --no-picture --folder " +
                         (folder.path / "out").string());
  CAPTURE(done.output);
  // At t = 1 the upper block's top lies below the lower block: there is no such state.
  CHECK(done.code == 1);
  const std::string series = folder.read("out/series.csv");
  const auto gap = column(series, "down.gap");
  CHECK(gap.size() > 1);
  for (const double g : gap) CHECK(std::abs(g) < 0.17);  // half the diameter of its largest cell
}
