// SPDX-License-Identifier: BSD-3-Clause
// Porous columns without a flow around them: the force on the wall below, how they consolidate, and what
// leaves them.
#include <algorithm>
#include <cmath>

#include "scene_run.hpp"

using namespace seam_cli_test;

namespace {

/// A column on a tight wall under a load that is there at once.
const std::string column_scene = R"(
title: A saturated column
dimension: 2
plugins: [solid, poroelasticity]
parameters: {n: 20, load: 0.05, permeability: 1e-3, end: 20}
meshes:
  column: {grid: {from: [0, 0], to: ["1/n", 1], cells: [1, n]}}
fields:
  column:
    type: porous_solid
    mesh: column
    material: {type: neo_hookean, young: 50, poisson: 0}
    viscosity: 1
    porosity: {initial: 0.5, bulk: 100}
    permeability: ["${permeability}"]
    boundary:
      - {on: [x_min, x_max], displacement: [0, null], velocity: [0, null]}
      - {on: y_min, displacement: [0, 0], velocity: [0, 0]}
      - {on: y_max, traction: [0, -load]}
time: {theta: 1, end: "${end}", step: {initial: 0.025}}
solver: {linear: {type: direct}}
output:
  fields: false
  probes:
    base: {field: column, at: [0, 0], quantity: pressure}
    top: {field: column, at: [0, 1], quantity: displacement, component: y}
    wall: {field: column, on: y_min, quantity: reaction, component: y}
)";

std::vector<double> series_of(const std::string& scene, const std::string& options, const std::string& name) {
  const Run run(scene, options);
  INFO(run.done.output);
  REQUIRE(run.done.code == 0);
  return run.series(name);
}

}  // namespace

TEST_CASE("a wall carries all of the load on a porous column, from the first step on") {
  for (const std::string permeability : {"1e-1", "1e-3", "1e-6", "1e-8"}) {
    INFO(permeability);
    const std::string options = "--set parameters.end=0.1 --set parameters.permeability=" + permeability;
    const std::vector<double> wall = series_of(column_scene, options, "wall");
    REQUIRE(wall.size() == 5);
    for (std::size_t k = 1; k < wall.size(); ++k) CHECK(std::abs(20 * wall[k] / 0.05 - 1) < 1e-8);
  }
  // As printed it is short by the pressure that pores have not taken at the drained end yet.
  const std::vector<double> printed =
      series_of(column_scene,
                "--set parameters.end=0.05 --set fields.column.momentum=printed "
                "--set fields.column.stabilisation.method=interior",
                "wall");
  CHECK(20 * printed[1] / 0.05 == Approx(0.904).epsilon(0.01));
}

// Small-strain diffusion with C = 1/E + (1 - phi_0)^2/kappa, 2,000 cells and 50 substeps a step, of a program
// apart from this one.
TEST_CASE("a porous column under load consolidates as diffusion tells") {
  const Run run(column_scene);
  INFO(run.done.output);
  REQUIRE(run.done.code == 0);
  const std::vector<double> base = run.series("base"), top = run.series("top");
  REQUIRE(base.size() == 801);
  CHECK(base[99] == Approx(0.04151).epsilon(0.01));
  CHECK(top[99] == Approx(-4.4376e-4).epsilon(0.01));
  CHECK(base[399] == Approx(0.018952).epsilon(0.01));
  CHECK(top[399] == Approx(-7.5868e-4).epsilon(0.01));
  CHECK(base[800] == Approx(0.0063131).epsilon(0.01));
}

TEST_CASE("a porous body loses in each step what flows out of it, at any strain") {
  const ShippedRun run("poro/squeezed_column");
  const std::vector<double> time = run.series("time"), volume = run.series("column.fluid_volume"),
                            outflow = run.series("outflow");
  REQUIRE(time.size() > 50);
  CHECK(volume.back() < 0.4 * volume.front());
  for (std::size_t k = 1; k < time.size(); ++k)
    CHECK(std::abs(volume[k - 1] - volume[k] - (time[k] - time[k - 1]) * outflow[k]) < 1e-9 * volume.front());
}

TEST_CASE("walls of a porous body may be made tight weakly", "[sanitized]") {
  const std::string
      coarse = "--set time.end=2 --set checks=[] ",
      weak =
          "--set 'fields.column.boundary.0={on: [x_min, x_max], displacement: [0, null], seepage: "
          "0}' --set 'fields.column.boundary.1={on: y_min, displacement: [0, 0], seepage: 0}'";
  const ShippedRun strong_run("poro/squeezed_column", coarse),
      weak_run("poro/squeezed_column", coarse + weak);
  const std::vector<double> time = weak_run.series("time"), volume = weak_run.series("column.fluid_volume"),
                            outflow = weak_run.series("outflow");
  for (const auto* series : {"top", "column.fluid_volume", "base", "outflow"}) {
    INFO(series);
    const std::vector<double> one = strong_run.series(series), other = weak_run.series(series);
    double size = 0, most = 0;
    for (std::size_t k = 0; k < one.size(); ++k) {
      size = std::max(size, std::abs(one[k]));
      most = std::max(most, std::abs(one[k] - other[k]));
    }
    CHECK(most < 0.01 * size);
  }
  for (std::size_t k = 1; k < time.size(); ++k)
    CHECK(std::abs(volume[k - 1] - volume[k] - (time[k] - time[k - 1]) * outflow[k]) < 1e-9 * volume.front());
}

TEST_CASE("two conditions on what flows through one boundary are refused") {
  const Result run = seam("run " SEAM_SOURCE_DIR
                          "/configs/poro/turned_block.yaml --set fields.block.boundary.0.velocity=[0,0]");
  CHECK(run.code != 0);
  CHECK_THAT(run.output, Catch::Contains("found `seepage` and `velocity` on the same boundary"));
}
