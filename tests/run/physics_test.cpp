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
