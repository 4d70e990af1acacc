// SPDX-License-Identifier: BSD-3-Clause
// The surface of one body with two interfaces.
#include <fmt/format.h>

#include "cli/run_command.hpp"
#include "series.hpp"

using namespace seam_cli_test;

namespace {

/// A soft disc that falls in a closed box. @param sides of the disc's mesh: those of each of its interfaces
std::string falling_disc(const std::vector<std::string>& sides) {
  std::string interfaces, couplings;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    interfaces +=
        fmt::format("  s{}: {{type: embedded, field: water, body: disc, boundaries: {}}}\n", k, sides[k]);
    couplings += fmt::format("  - {{type: fsi, on: s{}}}\n", k);
  }
  return fmt::format(R"yaml(
title: A soft disc that falls in a closed box
dimension: 2
plugins: [cutfem_fluid, solid, nitsche_fsci]
meshes:
  box: {{grid: {{from: [0, 0], to: [1, 1], cells: [8, 8]}}}}
  disc:
    grid: {{from: [-1, -1], to: [1, 1], cells: [4, 4], map: ["0.5 + 0.2*x*sqrt(1 - y^2/2)", "0.5 + 0.2*y*sqrt(1 - x^2/2)"]}}
fields:
  water:
    type: cutfem_fluid
    mesh: box
    density: 1
    viscosity: 0.05
    fix_pressure: never
    boundary:
      - {{on: [x_min, x_max, y_min, y_max], velocity: [0, 0]}}
  disc:
    type: solid
    mesh: disc
    material: {{type: neo_hookean, young: 100, poisson: 0.3}}
    density: 1
    body_force: [1, -2]
interfaces:
{}coupling:
{}time: {{theta: 1, end: 0.03, step: {{initial: 0.01}}}}
solver: {{newton: {{tolerance: 1e-11, increment_tolerance: 1e-9}}}}
output:
  fields: false
  probes:
    pole: {{field: disc, at: [0.7, 0.5], quantity: displacement}}
)yaml",
                     interfaces, couplings);
}

std::string series_of(const std::string& text) {
  const Folder folder;
  const Result run = seam("run " + folder.file("scene.yaml", text) + " --quiet --no-picture --folder " +
                          (folder.path / "results").string());
  INFO(run.output);
  REQUIRE(run.code == 0);
  return folder.read("results/series.csv");
}

}  // namespace

TEST_CASE("the sides of a body may have interfaces of their own") {
  const std::string whole = series_of(falling_disc({"[]"})),
                    parts = series_of(falling_disc({"[x_min, x_max]", "[y_min, y_max]"}));
  CHECK(column(parts, "water.volume").back() < 0.9);
  for (const std::string name :
       {"water.volume", "pole.x", "pole.y", "water.kinetic_energy", "disc.strain_energy"})
    CHECK(column(parts, name).back() == Approx(column(whole, name).back()).epsilon(1e-8));
}
