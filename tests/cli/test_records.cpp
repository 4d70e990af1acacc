// SPDX-License-Identifier: BSD-3-Clause
// Resolved scenes and records by the command line. What the stage `records` notices is in tests/records.
#include <nlohmann/json.hpp>

#include "run_command.hpp"

using Catch::Matchers::Contains;
using namespace seam_cli_test;

namespace {

std::string scene(const std::string& title, const std::string& young) {
  return "title: " + title + R"yaml(
dimension: 2
plugins: [solid]
parameters: {E: 10}
meshes: {box: {grid: {from: [0, 0], to: [1, 1], cells: [1, 1]}}}
fields:
  block:
    type: solid
    mesh: box
    material: {type: neo_hookean, young: )yaml" +
         young + R"yaml(, poisson: 0.3}
    boundary: [{on: y_min, displacement: [0, 0]}]
output: {fields: false}
)yaml";
}

/// The last word of the first line.
std::string printed_checksum(const std::string& output) {
  const std::string line = output.substr(0, output.find('\n'));
  return line.substr(line.rfind(' ') + 1);
}

}  // namespace

TEST_CASE("seam check --resolved prints every value; summary.json holds the checksum") {
  const Folder folder;
  const std::string file = folder.file("scene.yaml", scene("A block", "E"));
  for (const std::string before : {"", "mpirun --oversubscribe -np 2"}) {
    const Result result = seam("check --resolved " + file, before);
    CHECK(result.code == 0);
    CHECK_THAT(result.output, Contains("# decide what is computed, checksum ") &&
                                  Contains("\nfields.block.material.young: 10\n") &&
                                  Contains("\nsolver.newton.maximum_iterations: 25\n") &&
                                  Contains("\n# the others\n") && Contains("\ntitle: A block\n"));
  }
  const std::string checksum = printed_checksum(seam("check --resolved " + file).output);
  const std::string other = folder.file("other.yaml", scene("Another", "1e1"));
  CHECK(printed_checksum(seam("check --resolved " + other).output) == checksum);
  const std::string set = " --set parameters.E=11";
  CHECK(printed_checksum(seam("check --resolved " + file + set).output) != checksum);
  const std::string results = (folder.path / "results").string();
  CHECK(seam("run " + file + " --quiet --folder " + results).code == 0);
  CHECK(nlohmann::json::parse(folder.read("results/summary.json")).at("resolved_checksum") == checksum);
}

TEST_CASE("what is no record is said to be none") {
  const Folder folder;
  const std::string file = folder.file("scene.yaml", scene("A block", "E"));
  const std::string judge = "judge " + file + " " + folder.path.string();
  const Result none = seam(judge);
  CHECK(none.code == 2);
  CHECK_THAT(none.output,
             Contains("record.json: error: there is no such record") && Contains("record_run.py"));
  const std::string record = R"({"overrides": [OVERRIDES], "status": "finished", "time": 1, "numbers": {},
    "resolved_checksum": "0", "resolved": {}})";
  const auto write = [&](const std::string& overrides) {
    std::string text = record;
    return folder.file("record.json", text.replace(text.find("OVERRIDES"), 9, overrides));
  };
  for (const std::string text : {"", "{", "[]", "{\"overrides\": 1}"}) {
    (void)folder.file("record.json", text);
    const Result broken = seam(judge);
    CHECK(broken.code == 2);
    CHECK_THAT(broken.output, Contains("record.json: error: this is no record of a run"));
  }
  (void)write("\"no key\"");
  CHECK_THAT(seam(judge).output, Contains("'no key'"));
  (void)write("");
  CHECK_THAT(seam(judge).output, Contains("series.csv"));
  for (const std::string text : {"", "a,b\n", "time,a\n", "time,a\n1\n", "time,a\n1,x\n", "time,a\n1,2e\n"}) {
    (void)folder.file("series.csv", text);
    const Result broken = seam(judge);
    CHECK(broken.code == 2);
    CHECK_THAT(broken.output, Contains("series.csv:") && Contains("expected"));
  }
}
