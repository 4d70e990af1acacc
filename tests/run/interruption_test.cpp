// SPDX-License-Identifier: BSD-3-Clause
// A run that a signal or the clock ends has finished its step and left all that is needed to go on.
#include <nlohmann/json.hpp>
#include <sstream>

#include "process.hpp"
#include "series.hpp"

using Catch::Matchers::Contains;
using namespace seam_cli_test;

namespace {

/// Each step takes so many seconds.
std::string slow(double seconds) {
  return pulled_by("{type: slow, seconds: " + std::to_string(seconds) + ", load: 1}", "slow");
}

std::string run(const std::string& scene, const std::filesystem::path& results,
                const std::string& more = "") {
  return "run " + scene + " --quiet --no-picture --folder " + results.string() + " " + more;
}

nlohmann::json summary(const Folder& folder, const std::string& where) {
  return nlohmann::json::parse(folder.read(where + "/summary.json"));
}

/// Until the first step has begun.
void wait_for_step(const Folder& folder, const std::string& where) {
  wait_for([&] { return std::filesystem::exists(folder.path / where / "events.jsonl"); });
  pause(0.3);
}

/// Some steps were taken, the last one to its end, and all of it is on disk; from there the run goes on to
/// the end as one that nobody interrupted.
void check_interrupted(const Folder& folder, const std::string& scene, std::size_t most = 1) {
  const auto s = summary(folder, "r");
  CHECK(s["status"] == "interrupted");
  const auto steps = s["steps"].get<std::size_t>();
  CHECK(steps >= 1);
  CHECK(steps <= most);
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

constexpr double step_seconds = 5;
const std::string two_ranks = "mpirun --oversubscribe -np 2 ";

}  // namespace

TEST_CASE("SIGUSR1 to mpirun lets all ranks finish the step", "[mpi]") {
  const Folder folder;
  const std::string scene = folder.file("slow.yaml", slow(step_seconds));
  Process process(run(scene, folder.path / "r"), two_ranks, (folder.path / "log").string());
  wait_for_step(folder, "r");
  process.send(SIGUSR1);
  CHECK(process.wait() == 128 + SIGUSR1);
  CHECK_THAT(process.output(), Contains("SIGUSR1 was caught") && Contains("t = 0.1, step 1"));
  check_interrupted(folder, scene);
}

TEST_CASE("SIGTERM to mpirun does when it leaves the ranks time", "[mpi]") {
  const Folder folder;
  const std::string scene = folder.file("slow.yaml", slow(step_seconds));
  Process process(run(scene, folder.path / "r"), two_ranks + "--mca odls_base_sigkill_timeout 8",
                  (folder.path / "log").string());
  wait_for_step(folder, "r");
  process.send(SIGTERM);
  CHECK(process.wait() != 0);
  // mpirun waits so long before it sends SIGTERM, and as long before it kills.
  check_interrupted(folder, scene, 3);
}

TEST_CASE("SIGTERM to a single rank ends all of them", "[mpi]") {
  const Folder folder;
  const std::string scene = folder.file("slow.yaml", slow(step_seconds));
  Process process(run(scene, folder.path / "r"), two_ranks, (folder.path / "log").string());
  wait_for_step(folder, "r");
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
  const std::string scene = folder.file("slow.yaml", slow(step_seconds));
  const Result result = seam(run(scene, folder.path / "r", "--time-limit 3s"), two_ranks);
  CHECK(result.code == 124);
  CHECK_THAT(result.output, Contains("the time limit of 3 s is over"));
  check_interrupted(folder, scene);
}

TEST_CASE("a second signal ends the run at once") {
  const Folder folder;
  const std::string scene = folder.file("slow.yaml", slow(60));
  Process process(run(scene, folder.path / "r"), "", (folder.path / "log").string());
  wait_for_step(folder, "r");
  process.send(SIGINT);
  process.send(SIGINT);  // of the same moment: launchers do so
  pause(1);
  REQUIRE(waitpid(process.id(), nullptr, WNOHANG) == 0);
  const auto begin = std::chrono::steady_clock::now();
  process.send(SIGINT);
  CHECK(process.wait() == -SIGINT);
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(5));
  // Nothing was written since the start, so that there is nothing to go on from but that.
  const Result refused = seam(run(scene, folder.path / "r"));
  CHECK(refused.code == 2);
  CHECK_THAT(refused.output, Contains("its process was killed") && Contains("--resume"));
}

TEST_CASE("verify and a study stop with the run that a signal interrupts") {
  const Folder folder;
  const std::string scene =
      folder.file("slow.yaml", slow(1) + "study: {vary: {functions.slow.load: [1, 2]}, measure: tip.x}\n");
  for (const std::string& command :
       {"verify " + scene + " " + scene, "run " + scene + " --folder results/slow"}) {
    Process process(command, "env -C " + folder.path.string(), (folder.path / "log").string());
    wait_for([&] { return std::filesystem::exists(folder.path / "results/slow/events.jsonl"); });
    process.send(SIGTERM);
    CHECK(process.wait() == 128 + SIGTERM);
    CHECK_THAT(process.output(), Contains("interrupted: SIGTERM was caught"));
    std::filesystem::remove_all(folder.path / "results");
  }
  // Ctrl-C reaches all processes of a terminal; here the one of the case alone.
  const std::filesystem::path one = folder.path / "study/case001";
  Process process("study " + scene + " --folder " + (folder.path / "study").string(), "",
                  (folder.path / "log").string());
  wait_for([&] { return std::filesystem::exists(one / "events.jsonl"); });
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
  CHECK(points <= 5);
}
