// SPDX-License-Identifier: BSD-3-Clause
// Ties that meet at a point.
#include <cmath>

#include "scene_run.hpp"

using namespace seam_cli_test;

namespace {

/// Four blocks around a point, each tied to the next, that a traction pulls apart.
const std::string around_a_point = R"scene(
title: Four blocks around a point
dimension: 2
plugins: [solid, mortar_contact]
parameters: {n: 16, finer: 0, order: 1}
meshes:
  a: {grid: {from: [0, 0], to: [1, 1], cells: [n, n], order: "${order}"}}
  b: {grid: {from: [1, 0], to: [2, 1], cells: [n + finer, n + finer], order: "${order}"}}
  c: {grid: {from: [1, 1], to: [2, 2], cells: [n, n + finer], order: "${order}"}}
  d: {grid: {from: [0, 1], to: [1, 2], cells: [n + finer, n], order: "${order}"}}
fields:
  a:
    type: solid
    mesh: a
    order: "${order}"
    material: {type: saint_venant_kirchhoff, young: 10, poisson: 0.3}
    boundary: [{on: x_min, displacement: [0, null]}, {on: y_min, displacement: [null, 0]}]
  b:
    type: solid
    mesh: b
    order: "${order}"
    material: {type: saint_venant_kirchhoff, young: 10, poisson: 0.3}
    boundary: [{on: y_min, displacement: [null, 0]}, {on: x_max, traction: [1, 0]}]
  c: {type: solid, mesh: c, order: "${order}", material: {type: saint_venant_kirchhoff, young: 10, poisson: 0.3}, boundary: [{on: x_max, traction: [1, 0]}]}
  d: {type: solid, mesh: d, order: "${order}", material: {type: saint_venant_kirchhoff, young: 10, poisson: 0.3}, boundary: [{on: x_min, displacement: [0, null]}]}
interfaces:
  ab: {type: non_matching, fields: [a, b], boundaries: [x_max, x_min]}
  bc: {type: non_matching, fields: [b, c], boundaries: [y_max, y_min]}
  cd: {type: non_matching, fields: [c, d], boundaries: [x_min, x_max]}
  da: {type: non_matching, fields: [d, a], boundaries: [y_min, y_max]}
coupling:
  - {type: mortar_tie, on: ab}
  - {type: mortar_tie, on: bc}
  - {type: mortar_tie, on: cd}
  - {type: mortar_tie, on: da}
solver: {newton: {tolerance: 1e-12}}
output:
  fields: false
  probes:
    end: {field: c, at: [2, 2], quantity: displacement}
    low: {field: b, at: [2, 0], quantity: displacement}
    traction: {field: a, at: [1, 1], quantity: ab.traction}
)scene";

}  // namespace

TEST_CASE("ties that go around a point hold it once") {
  const std::string order = GENERATE("1", "2"), finer = GENERATE("0", "2");
  CAPTURE(order, finer);
  const Run run(around_a_point, "--quiet --set parameters.order=" + order + " parameters.finer=" + finer);
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  const auto last = [&run](const std::string& name) { return run.series(name).back(); };
  CHECK(std::abs(last("ab.force.x") - 1) < 1e-12);
  CHECK(std::abs(last("cd.force.x") + 1) < 1e-12);
  for (const char* still : {"ab.force.y", "bc.force.x", "bc.force.y", "da.force.x", "da.force.y"})
    CHECK(std::abs(last(still)) < 1e-12);
  CHECK(std::abs(last("traction.x") - 1) < 1e-12);
  // Uniform: F S = 1 along it with S = E/(1 - nu^2) times the strain (F^2 - 1)/2, and -nu/(1 - nu) of that
  // across.
  constexpr double young = 10, poisson = 0.3;
  const double stretch = 1 + last("end.x") / 2, strain = (stretch * stretch - 1) / 2;
  const double across = 1 + last("end.y") / 2, strain_across = (across * across - 1) / 2;
  CHECK(std::abs(stretch * young / (1 - poisson * poisson) * strain - 1) < 1e-12);
  CHECK(std::abs(strain_across + poisson / (1 - poisson) * strain) < 1e-12);
  CHECK(std::abs(last("low.x") - last("end.x")) < 1e-12);
}
