// SPDX-License-Identifier: BSD-3-Clause
// A run that was interrupted, in any way, continues as if it had not been.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>

#include "cli/run_command.hpp"
#include "series.hpp"

using namespace seam_cli_test;

namespace {

const std::string scene = SEAM_SOURCE_DIR "/configs/solid/swinging_beam.yaml --set output.fields=false";

std::string run(const Folder& folder, const std::string& where, const std::string& more = "") {
  return "run " + scene + " --quiet --no-picture --folder " + (folder.path / where).string() + " " + more;
}

/// Name of the newest restart point in a folder.
std::string newest(const std::filesystem::path& folder) {
  std::string name;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    name = std::max(name, entry.path().filename().string());
  return name;
}

}  // namespace

TEST_CASE("a restarted run equals the uninterrupted one to the bit, on one rank", "[sanitized]") {
  const Folder folder;
  REQUIRE(seam(run(folder, "whole")).code == 0);
  REQUIRE(seam(run(folder, "parts", "--stop-after 12")).code == 0);
  REQUIRE(seam(run(folder, "parts", "--resume --stop-after 13")).code == 0);
  REQUIRE(seam(run(folder, "parts", "--resume")).code == 0);
  CHECK(folder.read("parts/series.csv") == folder.read("whole/series.csv"));
}

TEST_CASE("adaptive steps go on after a restart as they would have, relative to the largest state so far") {
  const Folder folder;
  const std::string adaptive = " --set time.step.adaptive=true time.step.tolerance=0.02 ";
  REQUIRE(seam(run(folder, "whole", adaptive)).code == 0);
  REQUIRE(seam(run(folder, "parts", adaptive + "--stop-after 9")).code == 0);
  REQUIRE(seam(run(folder, "parts", adaptive + "--resume")).code == 0);
  CHECK(folder.read("parts/series.csv") == folder.read("whole/series.csv"));
  CHECK_THAT(folder.read("whole/restart/" + newest(folder.path / "whole/restart")),
             Catch::Contains("\"largest of each unknown\""));
}

TEST_CASE("a run that stops after some steps goes on from there") {
  const Folder folder;
  // Without a restart point of its own within these steps.
  const std::string rare = " --set output.restart.every=0 ";
  REQUIRE(seam(run(folder, "parts", rare + "--stop-after 3")).code == 0);
  const Result more = seam(run(folder, "parts", rare + "--resume --stop-after 3"));
  CHECK(table(folder.read("parts/series.csv")).size() == 7);  // the initial state, too
  for (const std::string count : {"0", "-3"}) {
    const Result result = seam(run(folder, "none", "--stop-after " + count));
    CHECK(result.code == 2);
    CHECK_THAT(result.output, Catch::Contains("--stop-after"));
  }
}

TEST_CASE("a run continues on other numbers of ranks") {
  const Folder folder;
  REQUIRE(seam(run(folder, "whole")).code == 0);
  REQUIRE(seam(run(folder, "parts", "--stop-after 10"), "mpirun --oversubscribe -np 2").code == 0);
  REQUIRE(seam(run(folder, "parts", "--resume --stop-after 15"), "mpirun --oversubscribe -np 3").code == 0);
  REQUIRE(seam(run(folder, "parts", "--resume")).code == 0);
  CHECK(difference(folder.read("parts/series.csv"), folder.read("whole/series.csv")) < 1e-8);
}

TEST_CASE("a run that is killed at any moment loses nothing but the last point", "[study]") {
  const Folder folder;
  // A restart point at every step, so that many a kill strikes while one is written.
  const std::string often = " --set output.restart.every=1 ";
  REQUIRE(seam(run(folder, "whole", often)).code == 0);
  for (int attempt = 1; attempt <= 12; ++attempt) {
    const Result result = seam(run(folder, "killed", often + "--resume"),
                               "timeout -s KILL 0." + std::to_string(attempt % 4 + 2));
    if (result.code == 0) break;
  }
  REQUIRE(seam(run(folder, "killed", often + "--resume")).code == 0);
  CHECK(folder.read("killed/series.csv") == folder.read("whole/series.csv"));
}

TEST_CASE("a damaged restart point is passed over", "[sanitized]") {
  const Folder folder;
  REQUIRE(seam(run(folder, "whole")).code == 0);
  REQUIRE(seam(run(folder, "parts", "--stop-after 22")).code == 0);
  const std::filesystem::path newest = folder.path / "parts/restart/00000022.restart";
  REQUIRE(std::filesystem::exists(newest));
  std::filesystem::resize_file(newest, std::filesystem::file_size(newest) / 2);
  const Result result = seam(run(folder, "parts", "--resume"));
  REQUIRE(result.code == 0);
  CHECK_THAT(result.output, Catch::Contains("00000022.restart") && Catch::Contains("damaged"));
  CHECK(folder.read("parts/series.csv") == folder.read("whole/series.csv"));
}

TEST_CASE("a run continues whose series are infinite so far") {
  const Folder folder;
  const auto ring = [&](const std::string& where, const std::string& more) {
    return "run " SEAM_SOURCE_DIR
           "/configs/contact/pressed_ring.yaml --set output.restart.every=1 --quiet "
           "--no-picture --folder " +
           (folder.path / where).string() + more;
  };
  REQUIRE(seam(ring("whole", " --stop-after 3")).code == 0);
  REQUIRE(seam(ring("parts", " --stop-after 2")).code == 0);
  REQUIRE(folder.read("parts/series.csv").find("inf") != std::string::npos);
  REQUIRE(seam(ring("parts", " --resume --stop-after 1")).code == 0);
  CHECK(folder.read("parts/series.csv") == folder.read("whole/series.csv"));
}
