// SPDX-License-Identifier: BSD-3-Clause
// Numbers computed from series.
#include <nlohmann/json.hpp>

#include "cli/run_command.hpp"

using namespace seam_cli_test;

TEST_CASE("formulas use balances by name; statistics say what a series does over time", "[sanitized]") {
  const Folder folder;
  // The end goes out by steps of 0.02 to t = 0.5 and back by as much.
  const std::string file = folder.file(
      "block.yaml",
      "title: a block\ndimension: 2\nplugins: [solid]\n"
      "meshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [2, 2]}}}\n"
      "fields:\n  block:\n    type: solid\n    mesh: block\n"
      "    material: {type: neo_hookean, young: 10, poisson: 0.3}\n"
      "    boundary:\n      - {on: x_min, displacement: [0, 0]}\n"
      "      - {on: x_max, displacement: [\"0.2*min(t, 1 - t)\", 0]}\n"
      "time: {static: true, end: 0.9, step: {initial: 0.1}}\n"
      "output:\n  fields: false\n"
      "  probes: {end: {field: block, at: [1, 0.5], quantity: displacement, component: x}}\n"
      "  formulas: {both: 2.5*block_strain_energy + end}\n"
      "  statistics:\n    rise: {of: end, what: rise}\n    late_rise: {of: end, what: rise, from: 0.5}\n"
      "    integral: {of: end, what: integral}\n    mean: {of: end, what: mean, from: 0.5}\n");
  const Result run = seam("run " + file + " --quiet --folder " + (folder.path / "r").string());
  INFO(run.output);
  REQUIRE(run.code == 0);
  const auto results = nlohmann::json::parse(folder.read("r/summary.json")).at("results");
  const auto value = [&](const char* name) { return results.at(name).get<double>(); };
  CHECK(value("rise") == Approx(0.02).epsilon(1e-12));
  CHECK(value("late_rise") == 0);
  CHECK(value("integral") == Approx(0.2 * (0.125 + 0.12)).epsilon(1e-12));
  CHECK(value("mean") == Approx(0.2 * 0.3).epsilon(1e-12));
  CHECK(value("both") == Approx(2.5 * value("block.strain_energy") + 0.02).epsilon(1e-12));
  CHECK(value("block.strain_energy") > 1e-4);
}
