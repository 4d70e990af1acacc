// SPDX-License-Identifier: BSD-3-Clause
// A body that moves through the fluid's mesh and deforms, step by step again: on other numbers of ranks, from
// a restart point, and after steps that failed.
#include <cli/run_command.hpp>

#include "run/series.hpp"

using namespace seam_cli_test;

namespace {

std::string run(const Folder& folder, const std::string& where, const std::string& more) {
  return "run " SEAM_SOURCE_DIR
         "/configs/fsi/released_disc.yaml --quiet --no-picture --set output.fields=false "
         "--set parameters.n=12 --set parameters.m=6 --set output.restart.every=1 --folder " +
         (folder.path / where).string() + " " + more;
}

std::string again(const Folder& folder, const std::string& where) {
  return "--set time.step.replay=" + (folder.path / where / "series.csv").string() + " ";
}

}  // namespace

TEST_CASE("recorded steps give the same on 1, 2 and 3 ranks and after a restart") {
  const Folder folder;
  // With few iterations the first steps fail and are halved.
  const std::string steps =
      "--set parameters.step=0.02 --set time.end=0.28 --set solver.newton.maximum_iterations=3 ";
  REQUIRE(seam(run(folder, "first", steps)).code == 0);
  const std::string first = folder.read("first/series.csv"), replay = steps + again(folder, "first");
  const auto rows = table(first);
  REQUIRE(rows.size() > 20);
  CHECK(rows[rows.size() / 2][0] - rows[rows.size() / 2 - 1][0] > 1.5 * rows[1][0]);  // of several lengths
  constexpr double zero = 1e-9;  // the rate of the body's volume is nothing but rounding
  for (const std::string ranks : {"2", "3"}) {
    INFO(ranks << " ranks");
    REQUIRE(seam(run(folder, "r" + ranks, replay), "mpirun --oversubscribe -np " + ranks).code == 0);
    CHECK(difference(first, folder.read("r" + ranks + "/series.csv"), zero) < 1e-6);
  }
  REQUIRE(seam(run(folder, "parts", replay + "--stop-after 10"), "mpirun --oversubscribe -np 3").code == 0);
  REQUIRE(seam(run(folder, "parts", replay + "--resume")).code == 0);
  CHECK(difference(first, folder.read("parts/series.csv"), zero) < 1e-6);
  REQUIRE(seam(run(folder, "one", replay + "--stop-after 10")).code == 0);
  REQUIRE(seam(run(folder, "one", replay + "--resume")).code == 0);
  CHECK(first == folder.read("one/series.csv"));
}

TEST_CASE("steps that failed leave no trace") {
  const Folder folder;
  // Too few iterations for the first steps: they are halved until they do.
  const std::string options =
      "--set solver.newton.maximum_iterations=4 --set time.end=0.15 --set parameters.step=0.02 ";
  REQUIRE(seam(run(folder, "halved", options)).code == 0);
  const std::string summary = folder.read("halved/summary.json");
  CHECK_THAT(summary, !Catch::Contains("\"rejected_steps\": 0"));
  REQUIRE(seam(run(folder, "straight", options + again(folder, "halved"))).code == 0);
  CHECK_THAT(folder.read("straight/summary.json"), Catch::Contains("\"rejected_steps\": 0"));
  CHECK(folder.read("straight/series.csv") == folder.read("halved/series.csv"));
}
