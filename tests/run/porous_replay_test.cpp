// SPDX-License-Identifier: BSD-3-Clause
// Porous bodies, alone and in a flow, step by step again: on other numbers of ranks and from a restart point.
#include <algorithm>

#include "cli/run_command.hpp"
#include "series.hpp"

using namespace seam_cli_test;

namespace {

/// Runs configs/poro/<scene>.yaml on 1, 2 and 3 ranks and with a restart after `stop` steps, from 3 ranks
/// to 1.
void replay_everywhere(const std::string& scene, const std::string& steps, int stop) {
  const Folder folder;
  const auto run = [&](const std::string& where, const std::string& more, const std::string& ranks = "") {
    const Result result =
        seam("run " SEAM_SOURCE_DIR "/configs/poro/" + scene +
                 ".yaml --quiet --no-picture --set output.fields=false --set checks=[] --set "
                 "output.restart.every=1 --folder " +
                 (folder.path / where).string() + " " + steps + more,
             ranks.empty() ? "" : "mpirun --oversubscribe -np " + ranks);
    INFO(result.output);
    REQUIRE(result.code == 0);
  };
  const auto series = [&](const std::string& where) { return folder.read(where + "/series.csv"); };
  run("first", "");
  const auto rows = table(series("first"));
  double shortest = rows[1][0], longest = shortest;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    shortest = std::min(shortest, rows[k][0] - rows[k - 1][0]);
    longest = std::max(longest, rows[k][0] - rows[k - 1][0]);
  }
  CHECK(longest > 1.5 * shortest);  // steps of several lengths, or replaying them shows nothing
  REQUIRE(static_cast<int>(rows.size()) > stop + 3);

  const std::string replay =
                        " --set time.step.replay=" + (folder.path / "first" / "series.csv").string() + " ",
                    half = replay + "--stop-after " + std::to_string(stop), rest = replay + "--resume";
  constexpr double zero = 1e-8;  // what is missing from a balance is nothing but rounding
  for (const std::string ranks : {"2", "3"}) {
    INFO(ranks << " ranks");
    run("r" + ranks, replay, ranks);
    CHECK(difference(series("first"), series("r" + ranks), zero) < 1e-6);
  }
  run("parts", half, "3");
  run("parts", rest);
  CHECK(difference(series("first"), series("parts"), zero) < 1e-6);
  run("one", half);
  run("one", rest);
  CHECK(series("first") == series("one"));
}

}  // namespace

TEST_CASE("a porous body gives the same on 1, 2 and 3 ranks and after a restart") {
  replay_everywhere("squeezed_column",
                    "--set time.end=0.2 --set time.step='{initial: 0.02, adaptive: true, tolerance: 3e-2}'",
                    7);
}

TEST_CASE("a filter in a flow gives the same on 1, 2 and 3 ranks and after a restart") {
  replay_everywhere(
      "filter",
      "--set parameters.n=0.5 --set time.end=0.15 --set time.step='{initial: 0.05, adaptive: true, "
      "tolerance: 3e-2}'",
      5);
}
