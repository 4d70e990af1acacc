// SPDX-License-Identifier: BSD-3-Clause
// A body that moves through the mesh of a fluid: nothing may depend on how the run was cut into pieces, on
// the number of ranks, or on factorisations that were kept.
#include "cli/run_command.hpp"
#include "series.hpp"

using namespace seam_cli_test;

namespace {

std::string run(const Folder& folder, const std::string& where, const std::string& more = "") {
  return "run " SEAM_SOURCE_DIR "/tests/run/moving_disc.yaml --quiet --no-picture --folder " +
         (folder.path / where).string() + " " + more;
}

std::string series(const Folder& folder, const std::string& where) {
  return folder.read(where + "/series.csv");
}

}  // namespace

TEST_CASE("a run with a moving cut continues to the bit, also on other numbers of ranks") {
  const Folder folder;
  REQUIRE(seam(run(folder, "whole")).code == 0);
  REQUIRE(seam(run(folder, "parts", "--stop-after 5")).code == 0);
  REQUIRE(seam(run(folder, "parts", "--resume")).code == 0);
  CHECK(series(folder, "whole") == series(folder, "parts"));
  REQUIRE(seam(run(folder, "ranks", "--stop-after 7"), "mpirun --oversubscribe -np 2").code == 0);
  REQUIRE(seam(run(folder, "ranks", "--resume"), "mpirun --oversubscribe -np 3").code == 0);
  CHECK(difference(series(folder, "whole"), series(folder, "ranks")) < 1e-8);
}

TEST_CASE("factorisations kept over changing spaces lead to the same flow", "[study]") {
  const Folder folder;
  REQUIRE(seam(run(folder, "fresh")).code == 0);
  REQUIRE(seam(run(folder, "kept", "--set solver.linear.keep=15")).code == 0);
  CHECK(difference(series(folder, "fresh"), series(folder, "kept")) < 1e-6);
}

TEST_CASE("a step that uncovers more than a layer of cells is halved", "[sanitized]") {
  const Folder folder;
  REQUIRE(
      seam(run(folder, "long", "--set time.step.initial=0.6 --set meshes.channel.grid.cells=[60,30]")).code ==
      0);
  const auto rows = table(series(folder, "long"));
  CHECK(rows.size() > 3);
  CHECK(rows.back()[0] == 0.6);
}
