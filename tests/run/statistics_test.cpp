// SPDX-License-Identifier: BSD-3-Clause
// What statistics and formulas make of series.
#include <nlohmann/json.hpp>

#include "cli/run_command.hpp"

using namespace seam_cli_test;

TEST_CASE("a kink in a series is found with its size and its time") {
  // A rigid motion in one direction: x(t) = t^2/2 with a kink of slope 3 at t = 0.6. The second derivative is
  // 1, at the kink 3/step more.
  const Folder folder;
  const std::string scene = folder.file("block.yaml", R"scene(
title: a block that is led
dimension: 2
plugins: [solid]
meshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [1, 1]}}}
fields:
  block:
    type: solid
    mesh: block
    density: 1
    material: {type: neo_hookean, young: 10, poisson: 0}
    boundary:
      - {on: [x_min, x_max], displacement: ["t*t/2 + 3*max(t - 0.6, 0)", 0]}
time: {end: 1, step: {initial: 0.1}}
output:
  fields: false
  probes: {tip: {field: block, at: [1, 0.5], quantity: displacement}}
  formulas: {change: block_volume - 1 + t, speed: "t > 0 ? tip_x/t : 0", push: "tip_x > 0.03 && tip_x < 0.15 ? 1 : 0", swing: sin(5*pi*t)}
  statistics:
    bend: {of: tip.x, what: curvature}
    bend_before: {of: tip.x, what: curvature, to: 0.61}
    kink: {of: tip.x, what: kink}
    at: {of: tip.x, what: kink_time}
    last: {of: change, what: maximum, to: 0.41}
    onset: {of: tip.x, what: onset}
    release: {of: tip.x, what: release}
    fastest: {of: speed, what: maximum, from: 0.05, to: 0.61}
    push_ends: {of: push, what: release}
    swings: {of: swing, what: frequency}
)scene");
  const auto run = seam("run " + scene + " --quiet --no-picture --folder " + (folder.path / "out").string());
  CAPTURE(run.output);
  REQUIRE(run.code == 0);
  const auto results = nlohmann::json::parse(folder.read("out/summary.json"))["results"];
  CHECK(results["bend"].get<double>() == Approx(31).epsilon(1e-8));
  CHECK(results["bend_before"].get<double>() == Approx(1).epsilon(1e-8));
  CHECK(results["kink"].get<double>() == Approx(31).epsilon(1e-8));
  CHECK(results["at"].get<double>() == Approx(0.6));
  CHECK(results["onset"].get<double>() == Approx(0.1));
  CHECK(results["release"].is_null());  // infinite: it lasts to the end
  CHECK(results["fastest"].get<double>() == Approx(0.3));
  CHECK(results["push_ends"].get<double>() == Approx(0.6));
  // At these steps a wave of straight lines; two and a half periods with three crossings.
  CHECK(results["swings"].get<double>() == Approx(2.5).epsilon(1e-9));
  CHECK(results["last"].get<double>() == Approx(0.4));
  CHECK(results["block.volume_rate"].get<double>() == Approx(0).margin(1e-8));
}
