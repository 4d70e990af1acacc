// SPDX-License-Identifier: BSD-3-Clause
// Fluid that two bodies enclose between them: a small pocket is left out, a large one solved for.
#include <fmt/format.h>

#include <algorithm>

#include "cli/run_command.hpp"
#include "series.hpp"

using namespace seam_cli_test;

namespace {

/// Cells are 0.05 wide.
std::string channel(const std::string& rest) {
  return R"yaml(
title: Fluid between bodies
dimension: 2
plugins: [cutfem_fluid]
meshes:
  channel: {grid: {from: [0, 0], to: [1, 1], cells: [20, 20]}}
time: {theta: 1, end: 0.25, step: {initial: 0.05}}
solver: {newton: {tolerance: 1e-10, increment_tolerance: 1e-8}, linear: {type: direct, keep: 0}}
output: {fields: false, probes: {force: {interface: lid, quantity: force}}}
)yaml" + rest;
}

/// A block with a notch on its right, and a lid that moves away from it. It reaches 0.01 into the block.
std::string notch(double depth, double height, const std::string& distance, const std::string& speed) {
  return channel(fmt::format(R"yaml(
fields:
  water:
    type: cutfem_fluid
    mesh: channel
    density: 1
    viscosity: 0.1
    boundary:
      - {{on: [x_min, y_min, y_max], velocity: ["y", 0]}}
      - {{on: x_max, outflow: symmetric}}
interfaces:
  block:
    type: cut
    field: water
    body:
      type: outline
      corners:
        - {{at: [0.2, 0.3]}}
        - {{at: [0.5, 0.3]}}
        - {{at: [0.5, 0.4]}}
        - {{at: [{0}, 0.4]}}
        - {{at: [{0}, {1}]}}
        - {{at: [0.5, {1}]}}
        - {{at: [0.5, 0.7]}}
        - {{at: [0.2, 0.7]}}
  lid:
    type: cut
    field: water
    body: {{type: box, from: [0.49, 0.39], to: [0.8, {4}]}}
    motion: {{translation: ["{2}", 0]}}
coupling:
  - {{type: fluid_wall, on: block, velocity: [0, 0]}}
  - {{type: fluid_wall, on: lid, velocity: ["{3}", 0]}}
)yaml",
                             0.49 - depth, 0.4 + height, distance, speed, 0.41 + height));
}

/// The lid cuts a corner of one cell off the channel, at its outlet or beside it.
std::string corner(const std::string& outlet) {
  const std::string wall = outlet == "x_max" ? "x_min" : "x_max";
  return channel(fmt::format(R"yaml(
fields:
  water:
    type: cutfem_fluid
    mesh: channel
    density: 1
    viscosity: 0.1
    boundary:
      - {{on: [{}, y_max], velocity: [0, 0]}}
      - {{on: y_min, velocity: [1, 0]}}
      - {{on: {}, outflow: symmetric}}
interfaces:
  lid:
    type: cut
    field: water
    body:
      type: outline
      corners:
        - {{at: [0.85, 1.1]}}
        - {{at: [0.85, 0.85]}}
        - {{at: [1.1, 0.85]}}
        - {{at: [1.1, 0.95]}}
        - {{at: [0.95, 0.95]}}
        - {{at: [0.95, 1.1]}}
coupling:
  - {{type: fluid_wall, on: lid, velocity: [0, 0]}}
)yaml",
                             wall, outlet));
}

/// A lid lies on a block, or at a gap of it, and is lifted.
std::string lid(const std::string& gap, const std::string& speed) {
  return channel(fmt::format(R"yaml(
fields:
  water:
    type: cutfem_fluid
    mesh: channel
    density: 1
    viscosity: 0.1
    boundary:
      - {{on: [x_min, y_min, x_max], velocity: [0, 0]}}
      - {{on: y_max, outflow: symmetric}}
interfaces:
  block: {{type: cut, field: water, body: {{type: box, from: [0.22, 0.2], to: [0.82, 0.51]}}}}
  lid:
    type: cut
    field: water
    body: {{type: box, from: [0.22, "0.51 + {0}"], to: [0.82, "0.8 + {0}"]}}
    motion: {{translation: [0, "{1}*t"]}}
coupling:
  - {{type: fluid_wall, on: block, velocity: [0, 0]}}
  - {{type: fluid_wall, on: lid, velocity: [0, "{1}"]}}
)yaml",
                             gap, speed));
}

/// The volume dropped at each time, the same on all numbers of ranks.
std::vector<double> dropped(const std::string& text) {
  const Folder folder;
  const std::string scene = folder.file("scene.yaml", text);
  std::string first;
  for (const int ranks : {1, 2, 3}) {
    const std::string where = std::to_string(ranks);
    const auto run = seam("run " + scene + " --quiet --no-picture --folder " + (folder.path / where).string(),
                          "mpirun --oversubscribe -np " + where);
    CAPTURE(ranks, run.output);
    REQUIRE(run.code == 0);
    if (ranks == 1) first = folder.read("1/series.csv");
    CHECK(difference(first, folder.read(where + "/series.csv")) < 1e-7);
  }
  const std::string names = first.substr(0, first.find(",water.dropped_volume"));
  REQUIRE(names.size() < first.size());
  std::vector<double> result;
  for (const auto& row : table(first)) result.push_back(row[std::count(names.begin(), names.end(), ',') + 1]);
  REQUIRE(result.size() == 6);
  return result;
}

}  // namespace

TEST_CASE("a pocket of half a cell is no part of the fluid until it opens") {
  // The lid leaves the block at t = 0.2; up to then the pocket grows with it.
  const auto volume = dropped(notch(0.025, 0.05, "max(0, 0.1*(t - 0.1))", "t > 0.1 ? 0.1 : 0"));
  for (int k = 0; k < 3; ++k) CHECK(volume[k] == Approx(0.025 * 0.05).epsilon(1e-10));
  CHECK(volume[3] == Approx(0.03 * 0.05).epsilon(1e-10));
  CHECK(volume[5] == 0);
}

TEST_CASE("a pocket of twenty cells is kept and solved for", "[study]") {
  for (const double volume : dropped(notch(0.25, 0.2, "0", "0"))) CHECK(volume == 0);
}

TEST_CASE("a small part of the fluid is kept where it reaches an open boundary") {
  for (const double volume : dropped(corner("x_max"))) CHECK(volume == 0);
  for (const double volume : dropped(corner("x_min"))) CHECK(volume == Approx(0.05 * 0.05).epsilon(1e-10));
}

TEST_CASE("a film that opens over many cells at once goes on from what is around it") {
  const Folder folder;
  const auto series = [&](const std::string& where, const std::string& gap, const std::string& speed,
                          const std::string& before = "") {
    const auto run = seam("run " + folder.file("scene.yaml", lid(gap, speed)) +
                              " --quiet --no-picture --folder " + (folder.path / where).string(),
                          before);
    CAPTURE(where, run.output);
    REQUIRE(run.code == 0);
    return folder.read(where + "/series.csv");
  };
  // Where the lid lies on the block at first, twelve cells come alive in a step. It is as if a film had been
  // there from the start, but for that instant.
  const std::string flush = series("flush", "0", "0.02"), apart = series("apart", "1e-9", "0.02");
  const std::vector<double> force = column(flush, "force.y"), same = column(apart, "force.y");
  REQUIRE(force.size() == 6);
  for (std::size_t k = 1; k < force.size(); ++k) CHECK(force[k] == Approx(same[k]).epsilon(1e-5));
  CHECK(force[1] < -20);
  for (const std::string ranks : {"2", "3"})
    CHECK(difference(flush, series(ranks, "0", "0.02", "mpirun --oversubscribe -np " + ranks)) < 1e-7);
  // A film of a third of a cell is more than may be made up.
  CHECK(column(series("fast", "0", "0.3"), "time").size() > 6);
}

TEST_CASE("a run that is resumed leaves out the pocket that it had left out", "[sanitized]") {
  // It grows beyond two cells while it is closed: without a memory it would be kept then, with no state.
  const Folder folder;
  const std::string scene = folder.file("scene.yaml", notch(0.02, 0.2, "0.03*t", "0.03"));
  const auto go = [&](const std::string& where, const std::string& rest) {
    const auto run = seam("run " + scene + " --quiet --no-picture --set output.restart.every=1 --folder " +
                          (folder.path / where).string() + rest);
    CAPTURE(run.output);
    REQUIRE(run.code == 0);
  };
  go("whole", "");
  go("parts", " --stop-after 4");
  go("parts", " --resume");
  const auto dropped = column(folder.read("whole/series.csv"), "water.dropped_volume");
  CHECK(dropped.back() == Approx(0.0275 * 0.2).epsilon(1e-9));
  CHECK(folder.read("parts/series.csv") == folder.read("whole/series.csv"));
}
