// SPDX-License-Identifier: BSD-3-Clause
// Contact that ends everywhere at once.
#include "scene_run.hpp"

using namespace seam_cli_test;

namespace {

const std::string pulled_apart = R"scene(
title: Blocks are pressed together and pulled apart
dimension: 2
plugins: [solid, mortar_contact]
parameters: {poisson: 0.3, upper: 5, lower: 3}
meshes:
  lower: {grid: {from: [0, 0], to: [1, 0.5], cells: ["${lower}", 2]}}
  upper: {grid: {from: [0, 0.5], to: [1, 1], cells: ["${upper}", 3]}}
fields:
  lower:
    type: solid
    mesh: lower
    material: {type: neo_hookean, young: 10, poisson: "${poisson}"}
    boundary: [{on: y_min, displacement: [null, 0]}, {on: [x_min, x_max], displacement: [0, null]}]
  upper:
    type: solid
    mesh: upper
    material: {type: neo_hookean, young: 10, poisson: "${poisson}"}
    boundary: [{on: y_max, displacement: [null, "t < 0.5 ? -0.2*t : -0.2 + 0.2*t"]}, {on: [x_min, x_max], displacement: [0, null]}]
interfaces: {face: {type: contact, from: upper, to: lower, boundaries: [y_min], opposite: [y_max]}}
coupling: [{type: mortar_contact, on: face}]
time: {static: true, end: 1.5, step: {initial: 0.125}}
output: {fields: false}
checks:
  - {that: newton.iterations.most, kind: trend, at_most: 6, source: contact ends in one step}
  - {that: steps.rejected, kind: trend, at_most: 0, source: the same}
)scene";

}  // namespace

TEST_CASE("what rounding leaves of a pressure that has gone keeps no iterations going") {
  // What is left, and whether it is anything at all, is up to chance: hence some blocks.
  const std::string upper = GENERATE("4", "5"), lower = GENERATE("2", "3"), poisson = GENERATE("0.1", "0.45");
  CAPTURE(upper, lower, poisson);
  const Run run(pulled_apart, "--quiet --set parameters.upper=" + upper + " parameters.lower=" + lower +
                                  " parameters.poisson=" + poisson);
  CAPTURE(run.done.output);
  CHECK(run.done.code == 0);
  CHECK(run.series("face.gap").back() > 0.05);
}
