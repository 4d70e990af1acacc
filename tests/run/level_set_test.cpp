// SPDX-License-Identifier: BSD-3-Clause
// Bodies given by a function in a scene.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "cli/run_command.hpp"
#include "series.hpp"

using namespace seam_cli_test;

namespace {

/// A disc of radius 0.3 that moves to the right, as a function of space and time.
const std::string moving_disc = "{type: level_set, value: (x - 0.7 - 0.2*t)^2 + (y - 0.45)^2 - 0.09}";

std::string scene(const std::string& body, const std::string& more = "") {
  return fmt::format(R"(
title: A disc that moves along a channel
dimension: 2
plugins: [cutfem_fluid]
parameters: {{n: 8}}
meshes:
  channel: {{grid: {{from: [0, 0], to: [2, 1], cells: [2*n, n]}}}}
fields:
  water:
    type: cutfem_fluid
    mesh: channel
    density: 1
    viscosity: 1
    boundary:
      - {{on: [y_min, y_max], velocity: [0, 0]}}
      - {{on: [x_min, x_max], outflow: symmetric}}
interfaces:
  disc: {{type: cut, field: water, body: {}{}}}
coupling:
  - {{type: fluid_wall, on: disc, velocity: [0.2, 0]}}
time: {{end: 0.3, step: {{initial: 0.1}}}}
output: {{fields: false}}
)",
                     body, more);
}

/// The last row of the series of a run.
std::vector<double> end_of_run(const Folder& folder, const std::string& file, const std::string& more,
                               int ranks = 1) {
  const auto run =
      seam("run " + file + " --quiet --no-picture --folder " + (folder.path / "run").string() + more,
           fmt::format("mpirun --oversubscribe -np {}", ranks));
  INFO(run.output);
  REQUIRE(run.code == 0);
  return table(folder.read("run/series.csv")).back();
}

std::size_t column(const Folder& folder, const std::string& name) {
  std::istringstream head(folder.read("run/series.csv"));
  std::string line, cell;
  std::getline(head, line);
  std::istringstream cells(line);
  for (std::size_t k = 0; std::getline(cells, cell, ','); ++k)
    if (cell == name) return k;
  FAIL("series.csv has no column " << name);
  return 0;
}

}  // namespace

TEST_CASE("a level set in a scene cuts out what it says, at second order, on all numbers of ranks",
          "[study]") {
  const Folder folder;
  const std::string file = folder.file("disc.yaml", scene(moving_disc));
  std::vector<double> error;
  for (const int n : {8, 16, 32}) {
    const auto end = end_of_run(folder, file, fmt::format(" --set parameters.n={}", n));
    error.push_back(std::abs(end[column(folder, "water.volume")] - 2 + 0.09 * std::numbers::pi));
  }
  INFO(error[0] << ", " << error[1] << ", " << error[2]);
  CHECK(error[2] < error[0] / 14);  // second order: 16
  CHECK(error[2] < 1e-3);
  const auto one = end_of_run(folder, file, "");
  for (const int ranks : {2, 3}) {
    const auto more = end_of_run(folder, file, "", ranks);
    CHECK(more[column(folder, "water.volume")] == Approx(one[column(folder, "water.volume")]).epsilon(1e-12));
    CHECK(more[column(folder, "water.kinetic_energy")] ==
          Approx(one[column(folder, "water.kinetic_energy")]).epsilon(1e-9));
  }
}

TEST_CASE("a level set without a change of sign, or with a motion, is refused") {
  const Folder folder;
  const auto run = [&](const std::string& text, int ranks) {
    return seam("run " + folder.file("bad.yaml", text) + " --quiet --no-picture --folder " +
                    (folder.path / "run").string(),
                fmt::format("mpirun --oversubscribe -np {}", ranks));
  };
  for (const int ranks : {1, 2}) {
    const auto none = run(scene("{type: level_set, value: 2 + x}"), ranks);
    CHECK(none.code != 0);
    CHECK_THAT(none.output, Catch::Contains("no change of sign on mesh 'channel' at t = 0: its values there "
                                            "lie between 2 and 4"));
    CHECK_THAT(none.output, Catch::Contains("bad.yaml:18"));
  }
  const auto moved = run(scene(moving_disc, ", motion: {translation: [t, 0]}"), 1);
  CHECK(moved.code != 0);
  CHECK_THAT(moved.output, Catch::Contains("takes no motion; write t into its own expression"));
}
