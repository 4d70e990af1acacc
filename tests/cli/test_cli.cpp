// SPDX-License-Identifier: BSD-3-Clause
// The command line as a user calls it: output and exit codes.
#include <nlohmann/json.hpp>

#include "run_command.hpp"

using Catch::Matchers::Contains;
using namespace seam_cli_test;

namespace {

const std::string scene =
    "title: A beam\ndimension: 2\nplugins: [beam]\nparameters: {n: 4}\n"
    "meshes: {box: {grid: {from: [0, 0], to: [1, 1], cells: [n, 2]}}}\nfields: {a: {type: beam}}\n";

}  // namespace

TEST_CASE("seam check sets a scene up, with warnings, and leaves no trace") {
  const Folder folder;
  const std::string file = folder.file("scene.yaml", R"yaml(
title: A block
dimension: 2
plugins: [solid]
parameters: {n: 4}
meshes:
  box: {grid: {from: [0, 0], to: [1, 1], cells: [n, 2]}}
  other: {grid: {from: [0, 0], to: [1, 1], cells: [1, 1]}}
fields:
  block:
    type: solid
    mesh: box
    density: 1
    material: {type: neo_hookean, young: 10, poisson: 0.3}
    boundary: [{on: y_min, displacement: [0, 0]}]
output:
  probes: {tip: {field: block, at: [1, 1], quantity: displacement}}
)yaml");
  for (const std::string before : {"", "mpirun --oversubscribe -np 2"}) {
    const Result result = seam("check " + file + " --set parameters.n=6", before);
    CHECK(result.code == 0);
    CHECK_THAT(result.output, Contains("mesh box of 12 quadrilateral cells") &&
                                  Contains("displacement [m]") && Contains("tip.x [m], tip.y [m]") &&
                                  Contains("42 unknowns") &&
                                  Contains("warning: no field uses the mesh 'other'"));
  }
  CHECK_FALSE(std::filesystem::exists("results/scene"));
  // What only the equations show.
  const Result free = seam("check " + file + " --set fields.block.boundary=[]");
  CHECK(free.code == 2);
  CHECK_THAT(free.output, Contains("is not held"));
  CHECK(seam("check " + file + " --set fields.block.boundary=[] --without-meshes").code == 0);
}

TEST_CASE("exit codes tell broken input from failing plugins") {
  const Folder folder;
  const std::string file = folder.file("scene.yaml", scene + "fieldz: 3\n");
  CHECK(seam("check " + file).code == 2);
  CHECK_THAT(seam("check " + file).output, Contains("Did you mean 'fields'?"));
  CHECK(seam("check /nowhere/scene.yaml").code == 2);
  CHECK(seam("check " + file + " --set nonsense").code == 2);
  CHECK(seam("check").code == 2);
  CHECK(seam("chekc").code == 2);
  CHECK(seam("explain beem").code == 2);
  CHECK(seam("schema --plugins other_abi").code == 3);
  CHECK(seam("check " + file + " --set 'plugins=[beam,throws]'").code == 3);
}

TEST_CASE("seam plugins shows what can be used and what cannot") {
  const Result result = seam("plugins");
  CHECK(result.code == 0);
  CHECK_THAT(result.output, Contains("provides: field beam") && Contains("unusable: found plugin ABI 99.0"));
}

TEST_CASE("seam explain and seam schema know the types of plugins") {
  CHECK_THAT(seam("explain").output, Contains("linear_solver") && Contains("A field for the tests. (beam)"));
  CHECK_THAT(seam("explain linear_solver:direct").output, Contains("(plugin core)"));
  CHECK_THAT(
      seam("explain solid").output,
      Contains("Quantities, for probes and pictures:\n  displacement [m]: ") &&
          Contains(
              "Series, recorded at every step by the name of the field, a dot, and\n  strain_energy [J]: "));
  const Result result = seam("schema --plugins beam");
  REQUIRE(result.code == 0);
  const auto schema = nlohmann::json::parse(result.output);
  CHECK(schema["$schema"] == "http://json-schema.org/draft-07/schema#");
  CHECK(schema["definitions"]["field"]["oneOf"][0]["enum"] == nlohmann::json({"beam"}));
}
