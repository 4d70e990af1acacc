// SPDX-License-Identifier: BSD-3-Clause
// Flows whose numbers are published, as a user writes them: few cells, nothing said of stabilisation.
#include "scene_run.hpp"

using namespace seam_cli_test;

namespace {

/// Turek and Hron 2006 (CFD2).
const std::string flag = R"yaml(
title: Flow round a cylinder with a rigid flag at Reynolds number 100
dimension: 2
plugins: [cutfem_fluid]
meshes:
  channel:
    grid:
      segments:
        from: [0, 0]
        x:
          - {to: 0.14, cells: 12, grading: 0.25}
          - {to: 0.26, cells: 24}
          - {to: 0.58, cells: 20}
          - {to: 0.62, cells: 12}
          - {to: 2.5, cells: 24, grading: 30}
        y: [{to: 0.14, cells: 12, grading: 0.3}, {to: 0.26, cells: 28}, {to: 0.41, cells: 12, grading: 3.3}]
fields:
  water:
    type: cutfem_fluid
    mesh: channel
    density: 1000
    viscosity: 1
    boundary:
      - {on: x_min, velocity: ["1.5*4*y*(0.41 - y)/0.1681", 0]}
      - {on: [y_min, y_max], velocity: [0, 0]}
      - {on: x_max, outflow: do_nothing}
interfaces:
  cylinder: {type: cut, field: water, body: {type: circle, centre: [0.2, 0.2], radius: 0.05}}
  flag: {type: cut, field: water, body: {type: box, from: [0.22, 0.19], to: [0.6, 0.21]}}
coupling: [{type: fluid_wall, on: cylinder, velocity: [0, 0]}, {type: fluid_wall, on: flag, velocity: [0, 0]}]
output:
  fields: false
  probes:
    cylinder: {interface: cylinder, quantity: force, component: x}
    flag: {interface: flag, quantity: force, component: x}
  formulas: {drag: cylinder + flag}
)yaml";

/// Botella and Peyret 1998, extremes on the centre lines.
const std::string cavity = R"yaml(
title: A lid-driven cavity at Reynolds number 1000
dimension: 2
plugins: [cutfem_fluid]
meshes: {cavity: {grid: {from: [0, 0], to: [1, 1], cells: [32, 32]}}}
fields:
  water:
    type: cutfem_fluid
    mesh: cavity
    density: 1
    viscosity: 1e-3
    boundary:
      - {on: y_max, velocity: [1, 0]}
      - {on: [x_min, x_max, y_min], velocity: [0, 0]}
output:
  fields: false
  probes:
    low: {field: water, at: [0.5, 0.1717], quantity: velocity, component: x}
    left: {field: water, at: [0.1578, 0.5], quantity: velocity, component: y}
    right: {field: water, at: [0.9092, 0.5], quantity: velocity, component: y}
)yaml";

double last(const Run& run, const std::string& name) {
  INFO(run.done.output);
  REQUIRE(run.done.code == 0);
  return run.series(name).back();
}

}  // namespace

TEST_CASE("by default the drag of a cylinder with a flag is within 1 % on few cells") {
  CHECK(last(Run(flag), "drag") == Approx(136.7).epsilon(0).margin(1.4));
}

TEST_CASE("by default a cavity of 32 x 32 cells is within 2 % from rest") {
  const Run run(cavity);
  CHECK(last(run, "low") == Approx(-0.3885698).epsilon(0.02));
  CHECK(last(run, "left") == Approx(0.3769447).epsilon(0.02));
  CHECK(last(run, "right") == Approx(-0.5270771).epsilon(0.02));
}
