// SPDX-License-Identifier: BSD-3-Clause
// Ties and contact with unknowns on surfaces.
#include <cmath>

#include "scene_run.hpp"

using namespace seam_cli_test;

namespace {

/// Two blocks between walls, pressed together. @param cells of the upper one, of the lower one, along the
/// seam
std::string blocks(int upper, int lower, const std::string& rest) {
  return R"scene(
title: Two blocks between walls
dimension: 2
plugins: [solid, mortar_contact]
parameters: {order: 1}
meshes:
  lower: {grid: {from: [0, 0], to: [1, 0.5], cells: [)scene" +
         std::to_string(lower) + R"scene(, 2], order: "${order}"}}
  upper: {grid: {from: [0, 0.5], to: [1, 1], cells: [)scene" +
         std::to_string(upper) + R"scene(, 3], order: "${order}"}}
fields:
  lower:
    type: solid
    mesh: lower
    order: "${order}"
    material: {type: neo_hookean, young: 10, poisson: 0.3}
    boundary:
      - {on: y_min, displacement: [null, 0]}
      - {on: [x_min, x_max], displacement: [0, null]}
  upper:
    type: solid
    mesh: upper
    order: "${order}"
    material: {type: neo_hookean, young: 10, poisson: 0.3}
    boundary:
      - {on: y_max, displacement: [null, "-0.2*t"]}
      - {on: [x_min, x_max], displacement: [0, null]}
solver: {newton: {tolerance: 1e-12, increment_tolerance: 1e-12}}
)scene" + rest;
}

const std::string tie = R"scene(
interfaces:
  seam: {type: non_matching, fields: [upper, lower], boundaries: [y_min, y_max]}
coupling:
  - {type: mortar_tie, on: seam}
output:
  fields: false
  probes:
    top: {field: upper, on: y_max, quantity: reaction, component: y}
    wall: {field: upper, at: [0, 0.5], quantity: seam.traction, component: y}
    middle: {field: upper, at: [0.45, 0.5], quantity: seam.traction, component: y}
)scene";

const std::string contact = R"scene(
interfaces:
  seam: {type: contact, from: upper, to: lower, boundaries: [y_min], opposite: [y_max]}
coupling:
  - {type: mortar_contact, on: seam}
output:
  fields: false
  probes:
    top: {field: upper, on: y_max, quantity: reaction, component: y}
    wall: {field: upper, at: [0, 0.5], quantity: seam.pressure}
    middle: {field: upper, at: [0.45, 0.5], quantity: seam.pressure}
)scene";

/// Pressed by this, they press on each other alike everywhere.
double uniform_push(const Run& run) {
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  const double push = -run.series("top").back();
  CHECK(push > 1);
  CHECK(run.series("middle").back() == Approx(push).epsilon(1e-11));
  CHECK(run.series("wall").back() == Approx(push).epsilon(1e-11));
  return push;
}

}  // namespace

TEST_CASE("blocks between walls are tied where nodes match and where they do not") {
  // What the walls give already is left to them: where nodes match, a multiplier for it would find nothing to
  // hold.
  const auto [upper, lower] = GENERATE(std::pair(4, 4), std::pair(5, 3), std::pair(3, 5));
  const int order = GENERATE(1, 2);
  CAPTURE(upper, lower, order);
  const Run run(blocks(upper, lower, tie), "--set parameters.order=" + std::to_string(order));
  const double push = uniform_push(run);
  CHECK(run.series("seam.apart").back() < 1e-14);
  CHECK(run.series("seam.force.y").back() == Approx(push).epsilon(1e-11));
}

TEST_CASE("blocks between planes of symmetry are tied as between walls") {
  std::string text = blocks(4, 4, tie);
  const std::string wall = "      - {on: [x_min, x_max], displacement: [0, null]}\n";
  for (std::size_t at = text.find(wall); at != std::string::npos; at = text.find(wall))
    text.erase(at, wall.size());
  text += R"scene(
constraints:
  - {type: symmetry, field: lower, boundaries: [x_min, x_max]}
  - {type: symmetry, field: upper, boundaries: [x_min, x_max]}
)scene";
  uniform_push(Run(text));
}

TEST_CASE("a pressure between blocks is uniform, of the first order and of the second") {
  const int order = GENERATE(1, 2);
  CAPTURE(order);
  const Run run(blocks(5, 3, contact), "--set parameters.order=" + std::to_string(order));
  const double push = uniform_push(run);
  CHECK(run.series("seam.area").back() == Approx(1));
  CHECK(std::abs(run.series("seam.gap").back()) < 1e-13);
  CHECK(run.series("seam.force.y").back() == Approx(push).epsilon(1e-11));
}

TEST_CASE("blocks that are pulled apart part, and nothing acts between them") {
  std::string text = blocks(5, 3, contact);
  const std::string pressed = "-0.2*t";
  text.replace(text.find(pressed), pressed.size(), "0.2*t");
  const Run run(text);
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  CHECK(std::abs(run.series("top").back()) < 1e-12);
  CHECK(std::abs(run.series("seam.pressure").back()) < 1e-12);
  CHECK(run.series("seam.area").back() == 0);
  CHECK(run.series("seam.gap").back() == Approx(0.2));
}

TEST_CASE("a body that touches itself is sent to Nitsche's contact") {
  std::string text = blocks(5, 3, contact);
  const std::string to = "to: lower, boundaries: [y_min], opposite: [y_max]";
  text.replace(text.find(to), to.size(), "to: upper, boundaries: [y_min], opposite: [y_max]");
  const Run run(text);
  CHECK(run.done.code == 2);
  CHECK_THAT(run.done.output, Catch::Contains("field 'upper' touches itself there"));
  CHECK_THAT(run.done.output, Catch::Contains("use the coupling `contact`"));
}

TEST_CASE("boundaries that do not lie on each other are not tied in silence") {
  std::string text = blocks(5, 3, tie);
  const std::string right = "boundaries: [y_min, y_max]";
  text.replace(text.find(right), right.size(), "boundaries: [y_max, y_min]");
  const Run run(text);
  CAPTURE(run.done.output);
  CHECK(run.done.code == 2);
  CHECK_THAT(run.done.output, Catch::Contains("do not lie on each other"));
}

TEST_CASE("a block that touches another one exactly is held by it under a dead load") {
  std::string text = blocks(5, 3, contact);
  const std::string given = "{on: y_max, displacement: [null, \"-0.2*t\"]}";
  text.replace(text.find(given), given.size(), "{on: y_max, traction: [0, -2]}");
  const Run run(text);
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  CHECK(run.series("middle").back() == Approx(2).epsilon(1e-11));
}

TEST_CASE("a surface of the second order that is partly covered finds where it touches") {
  const std::string text = blocks(5, 3, R"scene(
interfaces:
  lid:
    type: obstacle
    from: upper
    boundaries: [y_max]
    reach: 0.3
    body: {type: outline, corners: [{at: [0.73, 1.02]}, {at: [1.4, 1]}, {at: [1.4, 1.4]}, {at: [0.73, 1.4]}]}
    motion: {translation: [0, "-0.1*t"]}
  seam: {type: non_matching, fields: [upper, lower], boundaries: [y_min, y_max]}
coupling:
  - {type: mortar_contact, on: lid}
  - {type: mortar_tie, on: seam}
time: {static: true, end: 1, step: {initial: 0.25}}
output: {fields: false}
)scene");
  std::string free = text;
  const std::string given = "      - {on: y_max, displacement: [null, \"-0.2*t\"]}\n";
  free.erase(free.find(given), given.size());
  const Run run(free, "--set parameters.order=2");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  CHECK(run.series("lid.force.y").back() < -0.1);
  CHECK(run.series("time").size() == 5);
}
