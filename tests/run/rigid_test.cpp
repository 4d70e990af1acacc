// SPDX-License-Identifier: BSD-3-Clause
// Rigid bodies whose surface is cut out of a fluid, free to move and turn.
#include <cmath>

#include "scene_run.hpp"

using namespace seam_cli_test;

namespace {

/// The series of a scene of configs/fsi.
std::string series(const std::string& scene, const std::string& options, const std::string& before = "") {
  const Folder folder;
  const Result done =
      seam("run " SEAM_SOURCE_DIR "/configs/fsi/" + scene + ".yaml --no-picture --quiet --folder " +
               (folder.path / "out").string() + " " + options,
           before);
  INFO(done.output);
  REQUIRE(done.code == 0);
  return folder.read("out/series.csv");
}

const std::string unchecked = "--set 'checks=[]' --set output.fields=false ";

}  // namespace

TEST_CASE("a free disc in a shear flow turns with half its rate") { series("turning_disc", ""); }

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

TEST_CASE("so does a ball", "[study]") { series("turning_ball", "--set output.fields=false"); }

TEST_CASE("a disc between walls takes Faxen's force", "[study]") {
  series("towed_disc", "");
  // At order 1 the error falls with the cells.
  const auto speed = [](const std::string& options) {
    return column(series("towed_disc", unchecked + "--set parameters.order=1 " + options), "speed").back();
  };
  const double coarse = std::abs(speed("--set parameters.n=20") - 1),
               fine = std::abs(speed("--set parameters.n=40") - 1);
  CAPTURE(coarse, fine);
  CHECK(fine < 0.01);
  CHECK(fine < 0.6 * coarse);
}

TEST_CASE("a disc that settles does so alike on all numbers of ranks") {
  series("settling_disc", "--set output.fields=false");
  const std::string two_steps = unchecked + "--set time.end=0.06 ", one = series("settling_disc", two_steps);
  CHECK(std::abs(column(one, "angle").back()) > 1e-6);
  for (const char* ranks : {"2", "3"})
    CHECK(difference(one,
                     series("settling_disc", two_steps, std::string("mpirun --oversubscribe -np ") + ranks),
                     1e-6) < 1e-8);
}

TEST_CASE("a disc of a hundredth of the fluid's density rises without instability at any step", "[study]") {
  double last = 0;
  for (const char* step : {"0.03", "0.01", "0.005"}) {
    const std::string run = series(
        "settling_disc", unchecked +
                             "--set parameters.n=40 --set parameters.ratio=0.01 --set parameters.end=0.12 "
                             "--set parameters.step=" +
                             step);
    const std::vector<double> height = column(run, "centre.y"), time = column(run, "time");
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
