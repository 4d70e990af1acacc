// SPDX-License-Identifier: BSD-3-Clause
// What nothing acts on converges, and what is no number does not.
#include <cmath>

#include "cli/run_command.hpp"
#include "series.hpp"

using namespace seam_cli_test;

namespace {

/// A block whose stiffness is no round number, so that its stress at rest is rounding noise, not zero.
std::string block(const std::string& field, const std::string& rest) {
  return R"yaml(
title: A block
dimension: 2
plugins: [solid, nitsche_fsci]
meshes:
  block: {grid: {from: [0, 0], to: [1, 1], cells: [6, 6]}}
fields:
  block:
    type: solid
    mesh: block
    material: {type: neo_hookean, young: 30, poisson: 0.2}
)yaml" + field +
         rest;
}

Result run(const Folder& folder, const std::string& text) {
  return seam("run " + folder.file("scene.yaml", text) + " --quiet --no-picture --folder " +
              (folder.path / "out").string());
}

}  // namespace

TEST_CASE("a body that nothing acts on, or nothing yet, is at rest") {
  const std::string held = "    boundary: [{on: x_min, displacement: [0, 0]}";
  const std::string output =
      "output: {fields: false, probes: {tip: {field: block, at: [1, 1], quantity: displacement}}}\n";
  const Folder folder;
  const std::string field =
      GENERATE_COPY(held + "]\n", held + ", {on: x_max, traction: [\"t < 0.5 ? 0 : -1\", 0]}]\n",
                    held + "]\n    density: 3\ntime: {end: 1, step: {initial: 0.1}}\n",
                    held + "]\ntime: {static: true, end: 1, step: {initial: 0.25}}\n");
  CAPTURE(field);
  const auto outcome = run(folder, block(field, output));
  CAPTURE(outcome.output);
  CHECK(outcome.code == 0);
  for (const auto& row : table(folder.read("out/series.csv"))) CHECK(std::abs(row[1]) < 0.2);
}

TEST_CASE("two bodies that do not touch yet are at rest") {
  const Folder folder;
  std::string text = block("    boundary: [{on: x_min, displacement: [0, 0]}]\n", R"yaml(
  other:
    type: solid
    mesh: other
    material: {type: neo_hookean, young: 70, poisson: 0.3}
    boundary: [{on: x_max, displacement: [0, 0]}]
interfaces:
  look: {type: contact, from: block, to: other, reach: 1}
  back: {type: contact, from: other, to: block, reach: 1}
coupling: [{type: contact, on: look}, {type: contact, on: back}]
time: {static: true, end: 1, step: {initial: 0.25}}
output: {fields: false}
)yaml");
  text.replace(text.find("fields:\n"), 0, "  other: {grid: {from: [1.1, 0], to: [2.1, 1], cells: [5, 5]}}\n");
  const auto outcome = run(folder, text);
  CAPTURE(outcome.output);
  CHECK(outcome.code == 0);
}

TEST_CASE("a load that is no number ends the run with the term and the place") {
  const Folder folder;
  const auto outcome = run(folder, block(R"yaml(
    boundary: [{on: x_min, displacement: [0, 0]}, {on: x_max, traction: ["t > 0.5 ? sqrt(0 - 1) : 0", 0]}]
)yaml",
                                         R"yaml(
time: {static: true, end: 1, step: {initial: 0.25}}
output: {fields: false}
)yaml"));
  CAPTURE(outcome.output);
  CHECK(outcome.code == 1);
  CHECK_THAT(outcome.output, Catch::Contains("no finite number") && Catch::Contains("block.displacement") &&
                                 Catch::Contains("at (1,"));
}

TEST_CASE("what is no number at the start is named before rates are solved for") {
  const Folder folder;
  const auto outcome =
      run(folder, block(R"yaml(
    density: 1e308
    body_force: [0, -100]
    boundary: [{on: x_min, displacement: [0, 0]}]
)yaml",
                        "time: {theta: 0.5, end: 1, step: {initial: 0.25}}\noutput: {fields: false}\n"));
  CAPTURE(outcome.output);
  CHECK(outcome.code != 0);
  CHECK_THAT(outcome.output, Catch::Contains("error: something is not finite at the start:") &&
                                 Catch::Contains("block.displacement") && Catch::Contains("in cell 0 at"));
}

TEST_CASE("a Poisson's ratio that is next to nothing is as good as none") {
  const Folder folder;
  std::string text =
      block("    boundary: [{on: x_min, displacement: [0, 0]}, {on: x_max, traction: [1, 0]}]\n",
            "output: {fields: false}\n");
  text.replace(text.find("poisson: 0.2"), 12,
               "poisson: " + std::string(GENERATE("4.9e-324", "1e-300", "1e-19")));
  const auto outcome = run(folder, text);
  CAPTURE(outcome.output);
  CHECK(outcome.code == 0);
}
