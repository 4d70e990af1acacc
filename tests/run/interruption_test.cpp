// SPDX-License-Identifier: BSD-3-Clause
// A run that a signal or the clock ends has finished its step and left all that is needed to go on.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "process.hpp"
#include "series.hpp"

using Catch::Matchers::Contains;
using namespace seam_cli_test;

namespace {

/// Each step takes so many seconds. @param more keys of the load, ", key: value"
std::string slow(double seconds, const std::string& more = "") {
  return pulled_by("{type: slow, seconds: " + std::to_string(seconds) + more + ", load: 1}", "slow");
}

/// The first step lasts until a signal is caught, however long that takes to arrive.
std::string held(const Folder& folder) {
  return slow(
      1000, ", begun: " + (folder.path / "begun").string() + ", until: " + (folder.path / "until").string());
}

std::string run(const std::string& scene, const std::filesystem::path& results,
                const std::string& more = "") {
  return "run " + scene + " --quiet --no-picture --folder " + results.string() + " " + more;
}

nlohmann::json summary(const Folder& folder, const std::string& where) {
  return nlohmann::json::parse(folder.read(where + "/summary.json"));
}

void wait_for_step(const Process& process, const Folder& folder) {
  process.wait_for([&] { return std::filesystem::exists(folder.path / "begun"); });
}

/// One step was taken, to its end, and all of it is on disk; from there the run goes on to the end as one
/// that nobody interrupted.
void check_interrupted(const Folder& folder, const std::string& scene) {
  const auto s = summary(folder, "r");
  CHECK(s["status"] == "interrupted");
  const auto steps = s["steps"].get<std::size_t>();
  CHECK(steps == 1);
  CHECK(std::filesystem::exists(folder.path / ("r/restart/0000000" + std::to_string(steps) + ".restart")));
  CHECK(table(folder.read("r/series.csv")).size() == steps + 1);
  CHECK_THAT(folder.read("r/block.pvd"), Contains("block-00000" + std::to_string(steps)));
  CHECK_THAT(folder.read("r/events.jsonl"), Contains("\"status\":\"interrupted\""));

  const std::string fast = " --set functions.slow.seconds=0";
  const Result resumed = seam(run(scene, folder.path / "r", "--resume --changed" + fast));
  INFO(resumed.output);
  CHECK(resumed.code == 0);
  CHECK_THAT(resumed.output, Contains("step " + std::to_string(steps) + "\n"));
  REQUIRE(seam(run(scene, folder.path / "whole", fast)).code == 0);
  CHECK(difference(folder.read("r/series.csv"), folder.read("whole/series.csv"), 1) < 1e-9);
  CHECK(summary(folder, "r")["status"] == "finished");
}

const std::string two_ranks = "mpirun --oversubscribe -np 2 ";

}  // namespace

TEST_CASE("SIGUSR1 to mpirun lets all ranks finish the step", "[mpi]") {
  const Folder folder;
  const std::string scene = folder.file("slow.yaml", held(folder));
  Process process(run(scene, folder.path / "r"), two_ranks, (folder.path / "log").string());
  wait_for_step(process, folder);
  process.send(SIGUSR1);
  CHECK(process.wait() == 128 + SIGUSR1);
  CHECK_THAT(process.output(), Contains("SIGUSR1 was caught") && Contains("t = 0.1, step 1"));
  check_interrupted(folder, scene);
}

TEST_CASE("SIGTERM to mpirun does when it leaves the ranks time", "[mpi]") {
  const Folder folder;
  const std::string scene = folder.file("slow.yaml", held(folder));
  Process process(run(scene, folder.path / "r"), two_ranks + "--mca odls_base_sigkill_timeout 8",
                  (folder.path / "log").string());
  wait_for_step(process, folder);
  process.send(SIGTERM);
  CHECK(process.wait() != 0);
  // mpirun waits so long before it sends SIGTERM, and as long before it kills: what remains of the step, and
  // writing it, takes less than a tenth of that.
  check_interrupted(folder, scene);
}

TEST_CASE("SIGTERM to a single rank ends all of them", "[mpi]") {
  const Folder folder;
  const std::string scene = folder.file("slow.yaml", held(folder));
  Process process(run(scene, folder.path / "r"), two_ranks, (folder.path / "log").string());
  wait_for_step(process, folder);
  const std::string id = std::to_string(process.id());
  std::ifstream children("/proc/" + id + "/task/" + id + "/children");
  pid_t first = 0, second = 0;
  children >> first >> second;
  REQUIRE(second != 0);
  REQUIRE(::kill(second, SIGTERM) == 0);
  CHECK(process.wait() == 128 + SIGTERM);
  check_interrupted(folder, scene);
}

TEST_CASE("no step is begun when the time limit is over", "[mpi]") {
  const Folder folder;
  // The set-up counts: the limit is ten times what a whole run takes that does not wait. A step takes longer.
  const auto begin = std::chrono::steady_clock::now();
  REQUIRE(seam(run(folder.file("fast.yaml", slow(0)), folder.path / "fast"), two_ranks).code == 0);
  const std::chrono::duration<double> needed = std::chrono::steady_clock::now() - begin;
  const long limit = std::max(3L, std::lround(10 * needed.count()));
  const std::string scene = folder.file("slow.yaml", slow(static_cast<double>(limit) + 1));
  const Result result =
      seam(run(scene, folder.path / "r", "--time-limit " + std::to_string(limit) + "s"), two_ranks);
  CHECK(result.code == 124);
  CHECK_THAT(result.output, Contains("the time limit of " + std::to_string(limit) + " s is over"));
  check_interrupted(folder, scene);
}

TEST_CASE("a second signal ends the run at once") {
  const Folder folder;
  const std::string scene =
      folder.file("slow.yaml", slow(1000, ", begun: " + (folder.path / "begun").string()));
  Process process(run(scene, folder.path / "r"), "", (folder.path / "log").string());
  wait_for_step(process, folder);
  process.send(SIGINT);
  process.send(SIGINT);  // of the same moment: launchers do so
  pause(1);
  REQUIRE(waitpid(process.id(), nullptr, WNOHANG) == 0);
  process.send(SIGINT);
  CHECK(process.wait() == -SIGINT);  // at the end of the step it would have ended by itself
  // Nothing was written since the start, so that there is nothing to go on from but that.
  const Result refused = seam(run(scene, folder.path / "r"));
  CHECK(refused.code == 2);
  CHECK_THAT(refused.output, Contains("its process was killed") && Contains("--resume"));
}

TEST_CASE("verify and a study stop with the run that a signal interrupts") {
  const Folder folder;
  const std::string scene = folder.file(
      "slow.yaml", held(folder) + "study: {vary: {functions.slow.load: [1, 2]}, measure: tip.x}\n");
  for (const std::string& command :
       {"verify " + scene + " " + scene, "run " + scene + " --folder results/slow"}) {
    Process process(command, "env -C " + folder.path.string(), (folder.path / "log").string());
    wait_for_step(process, folder);
    process.send(SIGTERM);
    CHECK(process.wait() == 128 + SIGTERM);
    CHECK_THAT(process.output(), Contains("interrupted: SIGTERM was caught"));
    for (const std::string what : {"results", "begun", "until"})
      std::filesystem::remove_all(folder.path / what);
  }
  // Ctrl-C reaches all processes of a terminal; here the one of the case alone.
  Process process("study " + scene + " --folder " + (folder.path / "study").string(), "",
                  (folder.path / "log").string());
  wait_for_step(process, folder);
  const auto record = nlohmann::json::parse(folder.read("study/case001/run.json"));
  REQUIRE(::kill(record["process"].get<pid_t>(), SIGINT) == 0);
  CHECK(process.wait() == 128 + SIGINT);
  CHECK_THAT(process.output(), Contains("the study is interrupted"));
  CHECK_FALSE(std::filesystem::exists(folder.path / "study/case002"));
}

TEST_CASE("durations are read in words, and nothing else is") {
  const Folder folder;
  const std::string scene = folder.file("slow.yaml", slow(0));
  for (const std::string good : {"1h30m", "90m", "2d", "5400", "0.5h"})
    CHECK(seam(run(scene, folder.path / "r", "--time-limit " + good)).code == 0);
  for (const std::string bad : {"1h30", "soon", "-5", "0", "5x", "nan"}) {
    const Result result = seam(run(scene, folder.path / "r", "--time-limit=" + bad));
    CHECK(result.code == 2);
    CHECK_THAT(result.output, Contains("expected one like 90m"));
  }
}

TEST_CASE("restart points are written by the clock") {
  const Folder folder;
  const std::string scene = folder.file("slow.yaml", slow(0.3));
  REQUIRE(seam(run(scene, folder.path / "r", "--set output.restart.minutes=0.01 output.restart.keep=100"),
               two_ranks)
              .code == 0);
  std::size_t points = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path / "r/restart")) {
    CHECK(entry.path().extension() == ".restart");
    ++points;
  }
  CHECK(points >= 2);
  // None earlier than 0.6 s after the one before, however long the run took.
  CHECK(static_cast<double>(points) <= summary(folder, "r")["seconds"]["total"].get<double>() / 0.6 + 1);
}
