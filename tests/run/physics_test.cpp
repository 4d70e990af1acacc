// SPDX-License-Identifier: BSD-3-Clause
// The scenes in configs/ that are quick enough for every test run, in variants.
#include "cli/run_command.hpp"

using namespace seam_cli_test;

namespace {

/// Runs a scene of configs/solid; its checks decide.
void passes(const std::string& scene, const std::string& variant = "", const std::string& before = "") {
  const Folder folder;
  const Result result =
      seam("run " SEAM_SOURCE_DIR "/configs/solid/" + scene + ".yaml --quiet --no-picture --folder " +
               folder.path.string() + " " + variant,
           before);
  INFO(result.output);
  CHECK(result.code == 0);
}

}  // namespace

TEST_CASE("patch tests are exact on every cell type and order") {
  const std::string order = GENERATE("1", "2");
  for (const std::string cell : {"quadrilateral", "triangle"})
    passes("patch_2d", "--set meshes.patch.grid.cell=" + cell + " --set parameters.order=" + order);
  for (const std::string cell : {"hexahedron", "tetrahedron"})
    passes("patch_3d", "--set meshes.patch.grid.cell=" + cell + " --set parameters.order=" + order);
}

TEST_CASE("Cook's membrane, compressible and nearly incompressible", "[study]") {
  passes("cook");
  passes("cook_incompressible");
}

TEST_CASE("the beam of Turek and Hron under gravity, from a Gmsh file", "[study]") {
  passes("csm1");
  passes("csm2");
}

TEST_CASE("a block with the iterative solver, on one rank and several", "[study]") {
  const std::string size = "--set parameters.n=8";
  passes("block", size);
  passes("block", size, "mpirun --oversubscribe -np 2");
  passes("block", size, "mpirun --oversubscribe -np 3");
  passes("block", size + " --set solver.linear.preconditioner=ilu");
}

TEST_CASE("a follower pressure makes a uniform stress") { passes("pressure"); }

TEST_CASE("rigid bodies move as Newton and Euler say") {
  passes("oscillator");
  passes("oscillator", "", "mpirun --oversubscribe -np 3");
  passes("spinning_block");
}

TEST_CASE("what a scene says of the start, and of forces by region, reaches the body") {
  // A free body goes on as it began; a column of two densities weighs what both do.
  const std::string common =
      "dimension: 2\nplugins: [solid]\nmeshes: {block: {grid: {from: [0, 0], to: [1, 2], cells: [2, 4]}, "
      "regions: {lower: {where: y < 1}, upper: {where: y > 1}}}}\n";
  const std::string material = "material: {type: neo_hookean, young: 1e4, poisson: 0.3}";
  const std::string thrown =
      "title: Thrown\n" + common + "fields:\n  block: {type: solid, mesh: block, density: 2, " + material +
      ", initial: {displacement: [0.25, 0], velocity: [1, -0.5]}}\n"
      "time: {theta: 0.5, end: 1, step: {initial: 0.1}}\n"
      "output: {fields: false, probes: {tip: {field: block, at: [1, 2], quantity: displacement}}}\n"
      "checks:\n  - {that: tip.x, kind: exact, is: 1.25, within: 1e-9, source: uniform motion}\n"
      "  - {that: tip.y, kind: exact, is: -0.5, within: 1e-9, source: uniform motion}\n"
      "  - {that: block.kinetic_energy, kind: exact, is: 2.5, within: 1e-9, source: 0.5 m v^2}\n";
  const std::string nodal = GENERATE("false", "true");
  const std::string heavy =
      "title: Heavy\n" + common + "fields:\n  block:\n    type: solid\n    mesh: block\n    " + material +
      "\n    body_force: [0, -10]\n    interpolate_body_force: " + nodal +
      "\n    regions: [{on: lower, density: 1}, {on: upper, density: 3}]\n"
      "    boundary: [{on: y_min, displacement: [0, 0]}]\n"
      "time: {static: true, end: 1, step: {initial: 0.5}}\n"
      "output: {fields: false, probes: {weight: {field: block, quantity: reaction, on: [y_min]}}}\n"
      "checks:\n  - {that: weight.y, kind: exact, is: 40, within: 1e-6, source: what it weighs}\n"
      "  - {that: weight.x, kind: exact, is: 0, within: 1e-6, source: symmetry}\n";
  const Folder folder;
  for (const std::string& scene : {thrown, heavy}) {
    const Result result = seam("run " + folder.file("scene.yaml", scene) +
                               " --quiet --no-picture --overwrite --folder " + (folder.path / "r").string());
    INFO(result.output);
    CHECK(result.code == 0);
  }
}
