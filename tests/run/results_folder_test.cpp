// SPDX-License-Identifier: BSD-3-Clause
// What a run finds in its folder: it replaces what it may, keeps what is somebody else's, and goes on with
// its own run only.
#include <cstdint>
#include <nlohmann/json.hpp>

#include "process.hpp"
#include "series.hpp"

using Catch::Matchers::Contains;
using namespace seam_cli_test;

namespace {

namespace fs = std::filesystem;

const std::string beam = SEAM_SOURCE_DIR "/configs/solid/swinging_beam.yaml";

Result run(const Folder& folder, const std::string& where, const std::string& more = "",
           const std::string& scene = beam) {
  return seam("run " + scene + " --quiet --no-picture --folder " + (folder.path / where).string() + " " +
              more);
}

nlohmann::json json(const Folder& folder, const std::string& file) {
  return nlohmann::json::parse(folder.read(file));
}

void check_refused(const Result& result, const std::string& reason) {
  CHECK(result.code == 2);
  CHECK_THAT(result.output, Contains(reason));
}

std::size_t count_files(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("a run replaces what the last one wrote when that has ended, and nothing else") {
  const Folder folder;
  REQUIRE(run(folder, "r").code == 0);
  CHECK(count_files(folder.path / "r/fields") == 5);
  for (const std::string mine : {"r/notes.txt", "r/fields/mine.vtu", "r/restart/backup.restart"})
    static_cast<void>(folder.file(mine, "of mine"));
  const std::string first = json(folder, "r/run.json")["run"];

  REQUIRE(run(folder, "r", "--set output.every=20").code == 0);
  CHECK(json(folder, "r/run.json")["run"] != first);
  CHECK_FALSE(fs::exists(folder.path / "r/fields/beam-000010.vtu"));
  CHECK(fs::exists(folder.path / "r/fields/beam-000020.vtu"));
  for (const std::string mine : {"r/notes.txt", "r/fields/mine.vtu", "r/restart/backup.restart"})
    CHECK(folder.read(mine) == "of mine");
}

TEST_CASE("fields are written at their interval and at the end, and where a run is stopped") {
  const Folder folder;
  const std::string rare = "--set output.every=15 ";
  REQUIRE(run(folder, "whole", rare).code == 0);  // of 40 steps
  CHECK(count_files(folder.path / "whole/fields") == 4);
  CHECK(fs::exists(folder.path / "whole/fields/beam-000040.vtu"));
  REQUIRE(run(folder, "part", rare + "--stop-after 4").code == 0);
  CHECK(count_files(folder.path / "part/fields") == 2);
  CHECK(fs::exists(folder.path / "part/fields/beam-000004.vtu"));
  CHECK(fs::exists(folder.path / "part/restart/00000004.restart"));
}

TEST_CASE("a run that did not reach its end is kept unless one says otherwise") {
  const Folder folder;
  REQUIRE(run(folder, "r", "--stop-after 12").code == 0);
  const std::string series = folder.read("r/series.csv");
  check_refused(run(folder, "r"), "did not reach its end (stopped). Go on with it by --resume");
  CHECK(folder.read("r/series.csv") == series);
  REQUIRE(run(folder, "r", "--overwrite").code == 0);
  CHECK(json(folder, "r/run.json")["status"] == "finished");
}

TEST_CASE("a folder of another scene is left alone") {
  const Folder folder;
  REQUIRE(run(folder, "r").code == 0);
  const std::string other = SEAM_SOURCE_DIR "/configs/solid/patch_2d.yaml";
  for (const std::string how : {"", "--resume"})
    check_refused(run(folder, "r", how, other), "results of another scene, 'A beam that swings");
  CHECK(json(folder, "r/run.json")["status"] == "finished");
  CHECK(run(folder, "r", "--overwrite", other).code == 0);
}

TEST_CASE("results that no run lists are neither replaced nor resumed") {
  const Folder folder;
  REQUIRE(run(folder, "r").code == 0);
  fs::remove(folder.path / "r/run.json");
  for (const std::string how : {"", "--resume"})
    check_refused(run(folder, "r", how), "series.csv, summary.json) but no 'run.json'");
  static_cast<void>(folder.file("r/run.json", "{\"run\": \"12"));
  check_refused(run(folder, "r"), "'run.json' is damaged");
  CHECK(run(folder, "r", "--overwrite").code == 0);

  // One file is in the way that the scene did not write before.
  static_cast<void>(folder.file("r/interfaces", "of mine"));
  fs::create_directory(folder.path / "q");
  static_cast<void>(folder.file("q/summary.json", "of mine"));
  check_refused(run(folder, "q"), "summary.json");
  CHECK(folder.read("q/summary.json") == "of mine");
}

TEST_CASE("a resumed run goes on with its own run, of the same scene") {
  const Folder folder;
  const std::string heavy = "--set fields.beam.density=4000 ";
  REQUIRE(run(folder, "whole", heavy).code == 0);
  REQUIRE(run(folder, "r").code == 0);  // 40 steps, points 30 to 40
  REQUIRE(run(folder, "r", heavy + "--stop-after 12").code == 0);
  CHECK(count_files(folder.path / "r/restart") == 3);  // 5, 10 and 12

  const Result changed = run(folder, "r", "--resume");
  check_refused(changed, "fields.beam.density: 4000, now 1000");
  CHECK_THAT(changed.output, Contains("--resume --changed"));
  CHECK(json(folder, "r/run.json")["status"] == "stopped");

  const Result resumed = run(folder, "r", heavy + "--resume");
  CHECK(resumed.code == 0);
  CHECK_THAT(resumed.output, Contains("continues from t = 0.12, step 12"));
  CHECK(folder.read("r/series.csv") == folder.read("whole/series.csv"));
}

TEST_CASE("what a killed run had removed, but not noted yet, is not listed after it is resumed") {
  const Folder folder;
  REQUIRE(run(folder, "r", "--stop-after 12").code == 0);
  const std::string list = folder.read("r/manifest.txt");
  static_cast<void>(folder.file("r/manifest.txt", list + "2 restart/00000002.restart\n"));
  REQUIRE(run(folder, "r", "--resume --stop-after 14").code == 0);
  CHECK_THAT(folder.read("r/manifest.txt"), !Contains("00000002.restart"));
}

TEST_CASE("a run whose list of files is lost is not taken for one that wrote nothing") {
  const Folder folder;
  for (const bool removed : {true, false}) {
    REQUIRE(run(folder, "r", "--overwrite --stop-after 12").code == 0);
    const std::string series = folder.read("r/series.csv"), record = folder.read("r/run.json");
    if (removed)
      fs::remove(folder.path / "r/manifest.txt");
    else
      static_cast<void>(folder.file("r/manifest.txt", "garbage"));
    check_refused(run(folder, "r", "--resume"), "manifest.txt', the list of what this run wrote, is missing");
    CHECK(folder.read("r/series.csv") == series);
    CHECK(folder.read("r/run.json") == record);
    CHECK(count_files(folder.path / "r/restart") == 3);
  }
}

TEST_CASE("a changed scene goes on when told so, and what was changed is kept") {
  const Folder folder;
  REQUIRE(run(folder, "r", "--stop-after 10").code == 0);
  // What is drawn, checked or written more often is no change of the run.
  REQUIRE(run(folder, "r", "--resume --stop-after 5 --set output.every=5 checks=[] title=Other").code == 0);
  REQUIRE(run(folder, "r", "--resume --changed --set time.end=0.3 output.formulas.twice=2*tip_y").code == 0);
  CHECK(json(folder, "r/run.json")["changes"].dump().find("time.end: 0.4, now 0.3") != std::string::npos);
  // The new column has no values up to the change.
  const std::string series = folder.read("r/series.csv");
  const auto twice = column(series, "twice"), y = column(series, "tip.y");
  REQUIRE(twice.size() == 31);
  CHECK(std::isnan(twice[15]));
  CHECK(twice[16] == 2 * y[16]);
}

TEST_CASE("a mesh file with another content is a change") {
  const Folder folder;
  const std::string grid =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"left\"\n2 2 "
      "\"all\"\n$EndPhysicalNames\n"
      "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n2\n1 1 2 1 1 4 1\n2 3 2 2 1 1 2 "
      "3 4\n"
      "$EndElements\n";
  static_cast<void>(folder.file("one.msh", grid));
  const std::string scene = folder.file(
      "s.yaml",
      "title: One cell\ndimension: 2\nplugins: [solid]\nmeshes: {block: {file: one.msh}}\nfields:\n  block:\n"
      "    type: solid\n    mesh: block\n    density: 1\n"
      "    material: {type: neo_hookean, young: 10, poisson: 0.3}\n"
      "    boundary: [{on: left, displacement: [0, 0]}]\n    body_force: [0, -1]\n"
      "time: {end: 1, step: {initial: 0.1}}\noutput: {restart: {every: 1}}\n");
  const Result stopped = run(folder, "r", "--stop-after 3", scene);
  INFO(stopped.output);
  REQUIRE(stopped.code == 0);
  std::string moved = grid;
  moved.replace(moved.find("3 1 1 0"), 7, "3 1 2 0");
  static_cast<void>(folder.file("one.msh", moved));
  check_refused(run(folder, "r", "--resume", scene), "meshes.block.file (content)");
  static_cast<void>(folder.file("one.msh", grid));
  CHECK(run(folder, "r", "--resume", scene).code == 0);
}

TEST_CASE("a finished run is not solved again by --resume") {
  const Folder folder;
  const std::string without = "--set 'output.restart={every: 0, minutes: 0}' ";
  REQUIRE(run(folder, "r", without).code == 0);
  REQUIRE(json(folder, "r/run.json")["status"] == "finished");
  const std::string first = json(folder, "r/run.json")["run"];
  const Result again = run(folder, "r", without + "--resume");
  INFO(again.output);
  CHECK(again.code == 0);
  CHECK_THAT(again.output, Contains("is finished, there is nothing to resume"));
  CHECK(json(folder, "r/run.json")["run"] == first);
}

TEST_CASE("--resume says when there is nothing to go on from") {
  const Folder folder;
  const Result fresh = run(folder, "r", "--resume --stop-after 2");
  CHECK(fresh.code == 0);
  CHECK_THAT(fresh.output, Contains("no restart point: starts at t = 0"));
  const Result again = run(folder, "r", "--resume");
  CHECK(again.code == 0);
  CHECK_THAT(again.output, Contains("continues from t = 0.02, step 2"));
}

TEST_CASE(
    "restart points of other runs are not taken, and a run whose points are all damaged is not replaced") {
  const Folder folder;
  REQUIRE(run(folder, "other").code == 0);
  REQUIRE(run(folder, "r", "--stop-after 12").code == 0);
  const fs::path points = folder.path / "r/restart", others = folder.path / "other/restart";
  // One that is not listed, and one in place of a listed one.
  fs::copy_file(others / "00000040.restart", points / "00000040.restart");
  fs::copy_file(others / "00000030.restart", points / "00000012.restart",
                fs::copy_options::overwrite_existing);
  const Result resumed = run(folder, "r", "--resume --stop-after 2");
  CHECK(resumed.code == 0);
  CHECK_THAT(resumed.output, Contains("00000012.restart' was written by another run; an older one is used") &&
                                 Contains("continues from t = 0.1, step 10"));
  CHECK(fs::exists(points / "00000040.restart"));

  const std::string series = folder.read("r/series.csv");
  for (const auto& entry : fs::directory_iterator(points)) fs::resize_file(entry.path(), 100);
  check_refused(run(folder, "r", "--resume"), "no restart point can be used:");
  CHECK(folder.read("r/series.csv") == series);
}

TEST_CASE("a restart point is refused whose checksum is right and whose header says what cannot be") {
  const Folder folder;
  REQUIRE(run(folder, "r", "--stop-after 5").code == 0);
  const fs::path point = folder.path / "r/restart/00000005.restart";
  const std::string whole = folder.read("r/restart/00000005.restart");
  // A mark, the length of a JSON text, that text, numbers, a checksum.
  const auto with = [&](const std::string& key, const nlohmann::json& value) {
    std::uint64_t length = 0;
    std::copy_n(whole.begin() + 8, 8, reinterpret_cast<char*>(&length));
    nlohmann::json header = nlohmann::json::parse(whole.substr(16, length));
    REQUIRE(header.contains(key));
    header[key] = value;
    std::string text = header.dump();
    text.resize((text.size() + 7) / 8 * 8, ' ');
    std::string bytes = whole.substr(0, 16) + text + whole.substr(16 + length);
    length = text.size();
    std::copy_n(reinterpret_cast<const char*>(&length), 8, bytes.begin() + 8);
    std::uint64_t sum = 14695981039346656037ull;
    for (std::size_t k = 0; k + 8 < bytes.size(); ++k)
      sum = (sum ^ static_cast<unsigned char>(bytes[k])) * 1099511628211ull;
    std::copy_n(reinterpret_cast<const char*>(&sum), 8, bytes.end() - 8);
    std::ofstream(point, std::ios::binary) << bytes;
    return run(folder, "r", "--resume");
  };
  const std::string damaged = "00000005.restart' is damaged or incomplete";
  for (const double step : {0.0, -1.0}) check_refused(with("step", step), "expected a step above 0");
  check_refused(with("step_number", -1), "a number from 0 on");
  for (const char* key : {"time", "step", "step_number", "rejected_steps", "times", "iterations", "series"}) {
    check_refused(with(key, "a"), damaged);
    check_refused(with(key, nullptr), damaged);
  }
  for (const int times : {5, -1, 7, 1000000}) check_refused(with("times", times), damaged);
  check_refused(with("series", {{{"name", "a"}, {"size", 1}}}), damaged);
  for (const nlohmann::json& states : {nlohmann::json(1), nlohmann::json::array(), nlohmann::json({1, 2})})
    check_refused(with("states", states), "does not fit this scene");
  // Of a version that wrote other things.
  std::string older = whole;
  older[7] = '3';
  std::ofstream(point, std::ios::binary) << older;
  check_refused(run(folder, "r", "--resume"), "was written by another version of Seam: found format 3");
}

TEST_CASE("a record of a run that is JSON but none of a run is refused") {
  const Folder folder;
  REQUIRE(run(folder, "r", "--stop-after 5").code == 0);
  const nlohmann::json whole = json(folder, "r/run.json");
  for (const std::string key : {"run", "values", "resumed", "changes"}) {
    nlohmann::json record = whole;
    record[key] = 3;
    static_cast<void>(folder.file("r/run.json", record.dump()));
    check_refused(run(folder, "r", "--resume"), "'run.json' is damaged");
  }
  // What a step says of itself may be damaged: it is left out.
  static_cast<void>(folder.file("r/run.json", whole.dump()));
  static_cast<void>(
      folder.file("r/events.jsonl", "{\"event\":3,\"number\":1}\n{\"event\":\"step\",\"number\":\"a\"}\n"));
  CHECK(run(folder, "r", "--resume").code == 0);
}

TEST_CASE("a folder in which a run is at work is refused; one that was killed holds nothing up") {
  const Folder folder;
  const std::string scene =
      folder.file("slow.yaml", pulled_by("{type: slow, seconds: 1000, load: 1}", "slow"));
  Process process("run " + scene + " --folder " + (folder.path / "r").string(), "",
                  (folder.path / "log").string());
  process.wait_for([&] { return fs::exists(folder.path / "r/events.jsonl"); });
  for (const std::string how : {"", "--resume", "--overwrite"}) {
    const Result refused = run(folder, "r", how, scene);
    check_refused(refused, "another run is at work in this folder");
    CHECK_THAT(refused.output, Contains("process " + std::to_string(process.id())));
  }
  process.send(SIGKILL);
  process.wait();
  CHECK(fs::exists(folder.path / "r/run.lock"));
  CHECK(run(folder, "r", "--resume --changed --set functions.slow.seconds=0", scene).code == 0);
  CHECK_FALSE(fs::exists(folder.path / "r/run.lock"));
}

TEST_CASE("scenes of one name have folders of their own") {
  const Folder folder;
  const std::string at = "env -C " + folder.path.string();
  for (const std::string family : {"solid", "contact", "solid"}) {
    const Result result = seam("run " SEAM_SOURCE_DIR "/configs/" + family + "/patch_2d.yaml --quiet", at);
    INFO(result.output);
    CHECK(result.code == 0);
    CHECK_THAT(result.output, Contains(family == "solid" ? "results: results/patch_2d\n"
                                                         : "results: results/patch_2d-contact\n"));
  }
}

TEST_CASE("links in a folder of results are not followed") {
  const Folder folder;
  const std::string victim = folder.file("victim", "of mine");
  fs::create_directories(folder.path / "r");
  for (const std::string name : {"series.csv.tmp", "summary.json.tmp", "run.json.tmp", "manifest.txt.tmp"})
    fs::create_symlink(victim, folder.path / "r" / name);
  REQUIRE(run(folder, "r").code == 0);
  CHECK(folder.read("victim") == "of mine");

  fs::create_directories(folder.path / "elsewhere");
  for (const std::string name : {"run.lock", "fields", "series.csv"}) {
    fs::create_directories(folder.path / name / "r");
    fs::create_symlink(name == "fields" ? (folder.path / "elsewhere").string() : victim,
                       folder.path / name / "r" / name);
    const Result refused = run(folder, name + "/r");
    CHECK(refused.code != 0);
    CHECK(folder.read("victim") == "of mine");
  }
  CHECK(fs::is_empty(folder.path / "elsewhere"));

  // A list that somebody forged leads nowhere else.
  const std::string list = folder.read("r/manifest.txt");
  static_cast<void>(
      folder.file("r/manifest.txt", list + "0 ../victim\n0 " + victim + "\n0 fields/../../victim\n"));
  REQUIRE(run(folder, "r").code == 0);
  CHECK(folder.read("victim") == "of mine");
}

TEST_CASE("a study leaves what is not its own") {
  const Folder folder;
  const std::string scene = folder.file("s.yaml", R"yaml(
title: Pulled
dimension: 2
plugins: [solid]
parameters: {load: 1}
meshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [1, 1]}}}
fields:
  block:
    type: solid
    mesh: block
    material: {type: neo_hookean, young: 100, poisson: 0.3}
    boundary: [{on: x_min, displacement: [0, 0]}, {on: x_max, traction: [0, load]}]
output: {probes: {tip: {field: block, at: [1, 1], quantity: displacement, component: y}}}
study: {vary: {load: [1, 2]}, measure: tip}
)yaml");
  const std::string command = "study " + scene + " --folder " + (folder.path / "x").string();
  fs::create_directories(folder.path / "x/case001/mine");
  static_cast<void>(folder.file("x/case001/mine/thesis.tex", "of mine"));
  REQUIRE(seam(command).code == 0);
  CHECK(folder.read("x/case001/mine/thesis.tex") == "of mine");
  CHECK(seam(command).code == 0);  // once more, as before

  fs::create_directories(folder.path / "y");
  static_cast<void>(folder.file("y/study.csv", "of mine"));
  const std::string other = "study " + scene + " --folder " + (folder.path / "y").string();
  check_refused(seam(other), "that `seam study` did not write");
  CHECK(folder.read("y/study.csv") == "of mine");
  CHECK(seam(other + " --overwrite").code == 0);
}
