// SPDX-License-Identifier: BSD-3-Clause
// A run that something around it ends says what, leaves its last good state, and does not take others with
// it.
#include <nlohmann/json.hpp>
#include <sstream>

#include "process.hpp"
#include "series.hpp"

using Catch::Matchers::Contains;
using namespace seam_cli_test;

namespace {

namespace fs = std::filesystem;

const std::string beam = SEAM_SOURCE_DIR "/configs/solid/swinging_beam.yaml";
const std::string two_ranks = "timeout 1000 mpirun --oversubscribe -np 2 ";

Result run(const Folder& folder, const std::string& where, const std::string& more = "",
           const std::string& scene = beam, const std::string& before = "") {
  return seam(
      "run " + scene + " --quiet --no-picture --folder " + (folder.path / where).string() + " " + more,
      before);
}

nlohmann::json json(const Folder& folder, const std::string& file) {
  return nlohmann::json::parse(folder.read(file));
}

std::string trouble(const std::string& what, const std::string& rank = "0") {
  return pulled_by("{type: trouble, at: 0.45, load: 1, what: " + what + ", rank: \"" + rank + "\"}",
                   "trouble");
}

/// All rows have as many numbers as the header has names.
void check_table(const std::string& csv, std::size_t rows) {
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  const auto commas = std::count(line.begin(), line.end(), ',');
  std::size_t count = 0;
  for (; std::getline(in, line); ++count) CHECK(std::count(line.begin(), line.end(), ',') == commas);
  CHECK(count == rows);
}

}  // namespace

TEST_CASE("a mistake in a formula is told, and costs no number", "[sanitized]") {
  const Folder folder;
  for (const std::string& before : {std::string(), two_ranks}) {
    const Result result = run(folder, "r", "--set output.formulas.f=corner_z*2", beam, before);
    CHECK(result.code == 2);
    CHECK_THAT(result.output, Contains("corner_z"));
    CHECK_THAT(result.output, !Contains("last good state"));  // there was none
  }
  // One that is found in the middle of the run: tip_y is no name after the change.
  REQUIRE(run(folder, "q", "--stop-after 10").code == 0);
  const Result later =
      run(folder, "q", "--resume --changed --set output.formulas.f=corner_z*2 output.restart.every=1");
  CHECK(later.code == 1);
  CHECK_THAT(later.output, Contains("corner_z") && Contains("last good state (t = 0.1, step 10)"));
  check_table(folder.read("q/series.csv"), 11);
  CHECK(run(folder, "q", "--resume --changed").code == 0);
  check_table(folder.read("q/series.csv"), 41);
}

TEST_CASE("a misspelt check does not cost the summary") {
  const Folder folder;
  REQUIRE(run(folder, "r").code == 0);
  const Result result = run(folder, "r", "--resume --set checks.0.that=tipp.y");
  CHECK(result.code == 2);
  CHECK_THAT(result.output, Contains("'tipp.y'"));
  CHECK(json(folder, "r/summary.json")["status"] == "finished");
  CHECK(json(folder, "r/summary.json")["results"].contains("tip.y"));
  CHECK(json(folder, "r/run.json")["status"] == "finished");
}

TEST_CASE("what cannot be written is told, and the run goes on from its last restart point") {
  const Folder folder;
  REQUIRE(run(folder, "whole").code == 0);
  for (const std::string& before : {std::string(), two_ranks}) {
    const std::string where = before.empty() ? "one" : "two";
    REQUIRE(run(folder, where, "--stop-after 12").code == 0);
    // A folder in the way stands for the full disk.
    fs::create_directories(folder.path / where / "restart/00000035.restart.tmp/x");
    const Result result = run(folder, where, "--resume", beam, before);
    INFO(result.output);
    CHECK(result.code == 1);
    CHECK_THAT(result.output, Contains("00000035.restart: error: cannot write the file") &&
                                  Contains("The newest restart point is") &&
                                  Contains("00000030.restart'; `seam run --resume` starts from it"));
    const std::string message = "The newest restart point is";
    CHECK(result.output.find(message) == result.output.rfind(message));
    check_table(folder.read(where + "/series.csv"), 36);
    CHECK(run(folder, where).code == 2);  // what it has is kept
    fs::remove_all(folder.path / where / "restart/00000035.restart.tmp");
    const Result resumed = run(folder, where, "--resume");
    CHECK(resumed.code == 0);
    CHECK_THAT(resumed.output, Contains("continues from t = 0.3, step 30"));
    CHECK(difference(folder.read(where + "/series.csv"), folder.read("whole/series.csv"), 1e-6) < 1e-8);
  }
  CHECK(folder.read("one/series.csv") == folder.read("whole/series.csv"));
}

TEST_CASE("a folder that cannot be written to is told before anything is computed") {
  const Folder folder;
  static_cast<void>(folder.file("file", ""));
  for (const auto& [where, reason] :
       std::map<std::string, std::string>{{folder.path / "file/r", "what should be its folder is a file"},
                                          {"/proc/r", "its folder is not there"},
                                          {folder.path / "file", "is a file"}}) {
    const Result result = seam("run " + beam + " --quiet --folder " + where);
    CHECK(result.code == 1);
    CHECK_THAT(result.output, Contains(reason));
  }
}

TEST_CASE("a folder that vanishes during the run is told") {
  const Folder folder;
  const std::string begun = (folder.path / "begun").string(), until = (folder.path / "until").string();
  const std::string scene = folder.file(
      "slow.yaml",
      pulled_by("{type: slow, seconds: 1000, begun: " + begun + ", until: " + until + ", load: 1}", "slow"));
  Process process(
      "run " + scene + " --quiet --set output.fields=false --folder " + (folder.path / "r").string(), "",
      (folder.path / "log").string());
  process.wait_for([&] { return fs::exists(begun); });
  fs::remove_all(folder.path / "r");
  std::ofstream made(until);
  CHECK(process.wait() == 1);
  CHECK_THAT(process.output(), Contains("somebody has deleted the file, or its folder"));
}

TEST_CASE("what memory is lacking for is named, and other scenes are verified all the same") {
  const Folder folder;
  const std::string block = SEAM_SOURCE_DIR "/configs/solid/patch_2d.yaml";
  const std::string huge = folder.file(
      "huge.yaml",
      "title: Huge\ndimension: 2\nplugins: [solid]\nmeshes: {sheet: {grid: {from: [0, 0], to: [1, 1], cells: "
      "[20000, 20000]}}}\nfields:\n  sheet: {type: solid, mesh: sheet, material: {type: neo_hookean, young: "
      "1, "
      "poisson: 0.3}, boundary: [{on: x_min, displacement: [0, 0]}]}\n");
  const Result result = seam("verify --limit cells=1e9 " + huge + " " + block + " --quiet",
                             "env -C " + folder.path.string() + " prlimit --as=3000000000 ");
  INFO(result.output);
  CHECK(result.code == 1);
  CHECK_THAT(result.output, Contains("huge.yaml:4:") && Contains("out of memory for the mesh 'sheet'") &&
                                Contains("it may take no more than 3000 MB") &&
                                Contains("1 passed, 1 failed"));
}

TEST_CASE("whatever a step throws, its run is recorded", "[sanitized]") {
  const Folder folder;
  for (const auto& [what, reason] :
       std::map<std::string, std::string>{{"exception", "the library below is out of sorts"},
                                          {"memory", "out of memory for the step from t = 0.4 to 0.5"}}) {
    const std::string scene = folder.file(what + ".yaml", trouble(what));
    const Result result = run(folder, what, "", scene);
    CHECK(result.code == (what == "exception" ? 3 : 1));  // of a plugin, which is to blame
    CHECK_THAT(result.output, Contains(reason) && Contains("last good state (t = 0.4, step 4)"));
    const auto s = json(folder, what + "/summary.json");
    CHECK(s["status"] == "failed");
    CHECK_THAT(s["reason"].get<std::string>(), Contains(reason));
    check_table(folder.read(what + "/series.csv"), 5);
    CHECK_THAT(folder.read(what + "/events.jsonl"), Contains("\"status\":\"failed\""));
    // It is not the scene that is to blame.
    CHECK(run(folder, what, "", scene).code == 2);
    const Result resumed = run(folder, what, "--resume --changed --set functions.trouble.at=9", scene);
    CHECK(resumed.code == 0);
    CHECK_THAT(resumed.output, Contains("continues from t = 0.4, step 4"));
  }
}

TEST_CASE(
    "iterations of the first step that go astray shorten it; a matrix singular from the start ends the run",
    "[sanitized]") {
  const Folder folder;
  const auto failing = [&](const std::string& at) {
    const std::string scene =
        folder.file("failing.yaml", pulled_by("{type: slow, seconds: 0, load: 1}", "slow"));
    return run(folder, "r", "--overwrite --set solver.linear='{type: failing, at: " + at + "}'", scene);
  };
  const Result astray = failing("2");
  INFO(astray.output);
  CHECK(astray.code == 0);
  const auto events = folder.read("r/events.jsonl");
  CHECK_THAT(events, Contains("the matrix of this solve is singular"));
  CHECK(json(folder, "r/summary.json")["rejected_steps"] == 1);
  check_table(folder.read("r/series.csv"), 12);  // the first step in two halves
  const Result at_once = failing("1");
  CHECK(at_once.code == 1);
  CHECK_THAT(at_once.output, Contains("error: the matrix of this solve is singular"));
}

TEST_CASE("a rank that dies takes the others with it, and the run goes on from its last restart point",
          "[mpi]") {
  const Folder folder;
  const std::string scene = folder.file("death.yaml", trouble("death", "1"));
  const Result result = run(folder, "r", "--set output.restart.every=1", scene, two_ranks);
  CHECK(result.code == 128 + SIGKILL);
  CHECK_THAT(result.output, Contains("signal 9"));
  const Result refused = run(folder, "r", "", scene);
  CHECK(refused.code == 2);
  CHECK_THAT(refused.output, Contains("its process was killed"));
  const Result resumed =
      run(folder, "r", "--resume --changed --set functions.trouble.at=9", scene, two_ranks);
  CHECK(resumed.code == 0);
  CHECK_THAT(resumed.output, Contains("continues from t = 0.4, step 4"));
  check_table(folder.read("r/series.csv"), 11);
}

TEST_CASE("events tell each step, and why some were refused", "[sanitized]") {
  const Folder folder;
  // From t = 0.6 on it is pushed through its own support, which no step survives.
  const std::string scene = folder.file(
      "pushed.yaml",
      "title: Pushed through\ndimension: 2\nplugins: [solid]\n"
      "meshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [2, 2]}}}\nfields:\n  block:\n    type: "
      "solid\n"
      "    mesh: block\n    material: {type: neo_hookean, young: 100, poisson: 0.3}\n    boundary:\n"
      "      - {on: x_min, displacement: [0, 0]}\n"
      "      - {on: x_max, displacement: [\"t < 0.6 ? -0.2*t : -3\", 0]}\n"
      "time: {static: true, end: 1, step: {initial: 0.25, minimum: 0.1}}\n");
  REQUIRE(run(folder, "r", "", scene).code == 1);
  std::istringstream in(folder.read("r/events.jsonl"));
  std::vector<nlohmann::json> events;
  for (std::string line; std::getline(in, line);) events.push_back(nlohmann::json::parse(line));
  REQUIRE(events.size() == 3);
  for (int k = 0; k < 2; ++k) {
    CHECK(events[k]["event"] == "step");
    CHECK(events[k]["number"] == k + 1);
    CHECK(events[k]["time"] == 0.25 * (k + 1));
    CHECK(events[k]["residuals"].size() == events[k]["iterations"].get<std::size_t>() + 1);
    CHECK(events[k]["refused"].empty());
    CHECK(events[k]["seconds"].get<double>() > 0);
  }
  CHECK(events[2]["event"] == "end");
  CHECK(events[2]["status"] == "failed");
  REQUIRE(!events[2]["refused"].empty());
  CHECK(events[2]["refused"][0]["length"].get<double>() == Approx(0.1));
  CHECK_FALSE(events[2]["refused"][0]["reason"].get<std::string>().empty());
  // A scene that fails is mended and tried again.
  CHECK(run(folder, "r", "--set time.end=0.5", scene).code == 0);
}

TEST_CASE("series and events grow with each step") {
  const Folder folder;
  // The ninth step is at work until we have seen what the eight before it left.
  const std::string begun = (folder.path / "begun").string(), until = (folder.path / "until").string();
  const std::string scene =
      folder.file("slow.yaml", pulled_by("{type: slow, seconds: 1000, from: 0.85, begun: " + begun +
                                             ", until: " + until + ", load: 1}",
                                         "slow"));
  Process process("run " + scene + " --quiet --folder " + (folder.path / "r").string(), "",
                  (folder.path / "log").string());
  const auto lines = [&](const std::string& file) {
    const std::string text = folder.read(file);
    return std::count(text.begin(), text.end(), '\n');
  };
  process.wait_for([&] { return fs::exists(begun); });
  CHECK(lines("r/series.csv") == 10);  // names, the initial state, eight steps
  CHECK(lines("r/events.jsonl") == 8);
  std::ofstream made(until);
  CHECK(process.wait() == 0);
  CHECK(lines("r/series.csv") == 12);
}

TEST_CASE("steps that do not advance the clock, and times that do not ascend, are refused in words",
          "[sanitized]") {
  const Folder folder;
  const std::string stuck = "--set time.start=1e10 time.end=1e10+1 time.step.initial=1e-8 ";
  const Result clock = run(folder, "r", stuck, beam, "timeout 1000");
  CHECK(clock.code == 1);
  CHECK_THAT(clock.output, Contains("does not advance the clock"));

  for (const auto& [text, reason] : std::map<std::string, std::string>{
           {"time,a\n0,1\n\n0.1,1\n", "line 3 of"},
           {"time,a\n0,1\nsoon,1\n", "begins with 'soon'"},
           {"time,a\n0,1\nnan,1\n", "begins with 'nan'"},
           {"time,a\n0,1\ninf,1\n", "begins with 'inf'"},
           {"time,a\n0,1\n0.2,1\n0.1,1\n", "line 4 of"},
           {"time,a\n0,1\n0.2,1\n0.2,1\n", "after that of the line before, 0.2"},
           {"time,a\n", "holds 0 times"},
           {"0,1\n", "holds no series"}}) {
    const std::string file = folder.file("replay.csv", text);
    const Result result = run(folder, "q", "--set time.step.replay=" + file);
    INFO(text);
    CHECK(result.code == 2);
    CHECK_THAT(result.output, Contains(reason));
  }
}

TEST_CASE("whole numbers that no int holds are refused") {
  const Folder folder;
  const std::string number = "4294967300";
  for (const std::string key : {"meshes.beam.grid.cells.0", "output.restart.keep", "output.every"}) {
    const Result result = seam("check " + beam + " --set " + key + "=" + number);
    CHECK(result.code == 2);
    CHECK_THAT(result.output, Contains(number) || Contains("found 17179869200 cells"));
  }
  const std::string segments =
      "{segments: {from: [0, 0], x: [{to: 1, cells: 4294967300}], y: [{to: 1, cells: 2}]}}";
  const std::string none = "{segments: {from: [0, 0], x: [], y: [{to: 1, cells: 2}]}}";
  CHECK_THAT(seam("check " + beam + " --set 'meshes.beam.grid=" + none + "'").output,
             Contains("error: no stretch along x; expected at least one"));
  const Result result = seam("check " + beam + " --set 'meshes.beam.grid=" + segments + "'");
  CHECK(result.code == 2);
  CHECK_THAT(result.output, Contains("expected a whole number of no more than 2147483647"));
}

TEST_CASE("a constraint that fails on one rank ends the run on all of them, with its message", "[mpi]") {
  const Folder folder;
  for (const char* rank : {"0", "1"})
    for (const char* at : {"0", "0.45"}) {
      const std::string scene = folder.file(
          "ties.yaml", pulled_by("{type: slow, seconds: 0, load: 1}", "slow") +
                           "constraints: [{type: trouble, at: " + at + ", rank: \"" + rank + "\"}]\n");
      const Result result =
          run(folder, "r", "--overwrite", scene, "timeout 100 mpirun --oversubscribe -np 2 ");
      CAPTURE(rank, at, result.output);
      CHECK(result.code == 3);
      CHECK_THAT(result.output, Contains("ties.yaml:17:15") && Contains("the knot came undone") &&
                                    Contains("a constraint of plugin 'trouble'"));
    }
}
