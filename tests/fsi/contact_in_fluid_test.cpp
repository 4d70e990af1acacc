// SPDX-License-Identifier: BSD-3-Clause
// Bodies that come to touch inside a fluid, step by step again: on other numbers of ranks, from a restart
// point, and after steps that failed.
#include <algorithm>
#include <cli/run_command.hpp>

#include "run/series.hpp"

using namespace seam_cli_test;

namespace {

std::string run(const Folder& folder, const std::string& where, const std::string& more) {
  return "run " SEAM_SOURCE_DIR
         "/plugins/nitsche_fsci/conformance/contact_in_fluid.yaml --quiet --no-picture "
         "--set output.fields=false --set output.restart.every=1 --set time.end=0.42 --set "
         "time.step.initial=0.02 "
         "--folder " +
         (folder.path / where).string() + " " + more;
}

std::string again(const Folder& folder, const std::string& where) {
  return "--set time.step.replay=" + (folder.path / where / "series.csv").string() + " ";
}

}  // namespace

TEST_CASE("contact in a fluid is the same on 1, 2 and 3 ranks and after a restart in its middle") {
  const Folder folder;
  REQUIRE(seam(run(folder, "first", "")).code == 0);
  const std::string first = folder.read("first/series.csv"), replay = again(folder, "first");
  REQUIRE(table(first).size() > 20);
  CHECK(column(first, "down.contact_area").front() == 0);
  CHECK(column(first, "down.contact_area").back() > 0.1);
  CHECK(column(first, "down.gap").back() < 0);
  constexpr double zero = 1e-9;
  for (const std::string ranks : {"2", "3"}) {
    INFO(ranks << " ranks");
    REQUIRE(seam(run(folder, "r" + ranks, replay), "mpirun --oversubscribe -np " + ranks).code == 0);
    CHECK(difference(first, folder.read("r" + ranks + "/series.csv"), zero) < 1e-6);
  }
  REQUIRE(seam(run(folder, "one", replay + "--stop-after 15")).code == 0);
  REQUIRE(seam(run(folder, "one", replay + "--resume")).code == 0);
  CHECK(first == folder.read("one/series.csv"));
}

TEST_CASE("runs that choose their own steps touch at the same time on 1 and 2 ranks", "[study]") {
  const Folder folder;
  std::vector<double> onset;
  for (const std::string before : {"", "mpirun --oversubscribe -np 2"}) {
    const Result result =
        seam("run " SEAM_SOURCE_DIR
             "/configs/contact/falling_stamp.yaml --quiet --no-picture --set output.fields=false "
             "--set parameters.n=8 --set parameters.m=10 --set time.end=400 --folder " +
                 folder.path.string(),
             before);
    INFO(result.output);
    const std::string series = folder.read("series.csv");
    const std::vector<double> time = column(series, "time"), area = column(series, "stamp.contact_area");
    const auto first = std::find_if(area.begin(), area.end(), [](double a) { return a > 0; });
    REQUIRE(first != area.end());
    onset.push_back(time[first - area.begin()]);
  }
  CHECK(onset[1] == Approx(onset[0]).epsilon(0.01));
}
