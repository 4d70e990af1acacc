// SPDX-License-Identifier: BSD-3-Clause
// Rigid bodies whose surface is cut out of a fluid, free to move and turn.
#include <cmath>

#include "scene_run.hpp"

using namespace seam_cli_test;

namespace {

const std::string unchecked = "--set 'checks=[]' --set 'output.statistics={}' ";

}  // namespace

TEST_CASE("a free disc in a shear flow turns with half its rate") { ShippedRun("fsi/turning_disc"); }

TEST_CASE("the points of a body that moves at the start have its velocity from then on") {
  const Run run(R"yaml(
title: A block that flies and turns
dimension: 2
plugins: [solid]
meshes: {block: {grid: {from: [0, 0], to: [2, 1], cells: [2, 2]}}}
fields:
  block: {type: rigid_body, mesh: block, density: 1, initial: {velocity: [0.3, 0], rotation_rate: [0.2]}}
  skin: {type: rigid_surface, mesh: block}
constraints: [{type: rigid, field: skin, body: block}]
time: {theta: 0.5, end: 1, step: {initial: 0.05}}
output:
  fields: false
  probes: {corner: {field: skin, at: [2, 1], quantity: velocity}}
)yaml",
                "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  // v + omega x arm, the arm of (1, 1/2) turned by 0.2 t.
  const std::vector<double> x = run.series("corner.x"), y = run.series("corner.y");
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double angle = 0.2 * 0.05 * static_cast<double>(k), c = std::cos(angle), s = std::sin(angle);
    CHECK(x[k] == Approx(0.3 - 0.2 * (s + 0.5 * c)).margin(1e-5));
    CHECK(y[k] == Approx(0.2 * (c - 0.5 * s)).margin(1e-5));
  }
}

TEST_CASE("so does a ball", "[study]") { ShippedRun("fsi/turning_ball"); }

TEST_CASE("a disc between walls takes Faxen's force", "[study]") {
  ShippedRun("fsi/towed_disc");
  // At order 1 the error falls with the cells.
  const auto speed = [](const std::string& options) {
    return ShippedRun("fsi/towed_disc", unchecked + "--set parameters.order=1 " + options)("speed");
  };
  const double coarse = std::abs(speed("--set parameters.n=20") - 1),
               fine = std::abs(speed("--set parameters.n=40") - 1);
  CAPTURE(coarse, fine);
  CHECK(fine < 0.01);
  CHECK(fine < 0.6 * coarse);
}

TEST_CASE("a disc that settles does so alike on all numbers of ranks") {
  ShippedRun("fsi/settling_disc");
  const std::string two_steps = unchecked + "--set time.end=0.06 ";
  const ShippedRun one("fsi/settling_disc", two_steps);
  CHECK(std::abs(one("angle")) > 1e-6);
  for (const char* ranks : {"2", "3"}) {
    const ShippedRun several("fsi/settling_disc", two_steps,
                             std::string("mpirun --oversubscribe -np ") + ranks);
    CHECK(difference(one.csv, several.csv, 1e-6) < 1e-8);
  }
}

TEST_CASE("what a weight does that settles goes into motion and heat, the more so the finer the cells",
          "[study]") {
  const auto loss = [](const std::string& cells) {
    const ShippedRun run("fsi/settling_disc",
                         "--set 'checks=[]' --set parameters.m=12 --set parameters.n=" + cells);
    const std::vector<double> time = run.series("time"), heating = run.series("water.dissipation");
    double heat = 0;
    for (std::size_t k = 1; k < time.size(); ++k)
      heat += (time[k] - time[k - 1]) * (heating[k - 1] + heating[k]) / 2;
    CHECK(run("work") > 0.005);
    return 1 - (run("motion") + heat) / run("work");
  };
  const double coarse = loss("20"), fine = loss("40");
  CAPTURE(coarse, fine);
  CHECK(std::abs(fine) < 0.04);
  CHECK(std::abs(fine) < 0.5 * std::abs(coarse));
}

TEST_CASE("a disc of a hundredth of the fluid's density rises without instability at any step", "[study]") {
  double last = 0;
  for (const char* step : {"0.03", "0.01", "0.005"}) {
    const ShippedRun run("fsi/settling_disc", unchecked +
                                                  "--set parameters.n=40 --set parameters.ratio=0.01 "
                                                  "--set parameters.end=0.12 --set parameters.step=" +
                                                  step);
    const std::vector<double> height = run.series("centre.y"), time = run.series("time");
    CAPTURE(step, height);
    // It only ever rises, and ever faster while it starts.
    double before = 0;
    for (std::size_t k = 1; k < height.size(); ++k) {
      const double speed = (height[k] - height[k - 1]) / (time[k] - time[k - 1]);
      CHECK(speed > 0.9 * before);
      before = speed;
    }
    if (last > 0) CHECK(height.back() == Approx(last).epsilon(0.06));
    last = height.back();
  }
}
