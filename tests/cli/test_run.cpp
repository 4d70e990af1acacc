// SPDX-License-Identifier: BSD-3-Clause
// seam run and seam study with a real physics.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "run_command.hpp"

using Catch::Matchers::Contains;
using namespace seam_cli_test;

namespace {

/// A block that is pushed; from t = 0.6 on through its own support, which no step survives.
const std::string pushed =
    "title: Pushed through\ndimension: 2\nplugins: [solid]\nparameters: {n: 2, E: 100}\n"
    "meshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [n, n]}}}\n"
    "fields:\n  block:\n    type: solid\n    mesh: block\n"
    "    material: {type: neo_hookean, young: E, poisson: 0.3}\n    boundary:\n"
    "      - {on: x_min, displacement: [0, 0]}\n"
    "      - {on: x_max, displacement: [\"t < 0.6 ? -0.2*t : -3\", 0]}\n"
    "time: {static: true, end: 1, step: {initial: 0.25, minimum: 0.1}}\n"
    "output: {every: 100, probes: {right: {field: block, at: [1, 0.5], quantity: displacement, component: "
    "x}}}\n";

/// A block under traction; the probe has a check.
const std::string pulled =
    "title: Pulled\ndimension: 2\nplugins: [solid]\nparameters: {n: 2, order: 1, load: 1}\n"
    "meshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [n, n]}}}\n"
    "fields:\n  block:\n    type: solid\n    mesh: block\n    order: ${order}\n"
    "    material: {type: neo_hookean, young: 100, poisson: 0.3}\n    boundary:\n"
    "      - {on: x_min, displacement: [0, 0]}\n      - {on: x_max, traction: [0, load]}\n"
    "output: {probes: {tip: {field: block, at: [1, 1], quantity: displacement, component: y}}}\n"
    "checks: [{that: tip, is: 0.06, within: 50%, source: order of magnitude}]\n";

nlohmann::json summary(const Folder& folder, const std::string& where) {
  return nlohmann::json::parse(folder.read(where + "/summary.json"));
}

std::string run(const Folder& folder, const std::string& scene, const std::string& where) {
  return "run " + scene + " --quiet --no-picture --folder " + (folder.path / where).string();
}

std::string line(const std::string& text, std::size_t number) {
  std::istringstream in(text);
  std::string result;
  for (std::size_t k = 0; k <= number; ++k) std::getline(in, result);
  return result;
}

}  // namespace

TEST_CASE("what only iterative solvers need is not loaded at the start") {
  // The dynamic linker lists what it would load.
  const std::string libraries = seam("", "LD_TRACE_LOADED_OBJECTS=1").output;
  CHECK_THAT(libraries, Contains("libseam_core") && Contains("libdmumps"));
  CHECK_THAT(libraries, !Contains("muelu") && !Contains("ifpack2"));
}

TEST_CASE("a run that fails leaves its reason and the last good state") {
  const Folder folder;
  const std::string scene = folder.file("pushed.yaml", pushed);
  const Result result = seam(run(folder, scene, "out"));
  CHECK(result.code == 1);
  CHECK_THAT(result.output,
             Contains("the step from t = 0.5 fails") && Contains("last good state (t = 0.5, step 2)"));

  const auto s = summary(folder, "out");
  CHECK(s["status"] == "failed");
  CHECK(s["time"] == 0.5);
  CHECK_THAT(s["reason"].get<std::string>(), Contains("the step from t = 0.5 fails"));
  CHECK(s["results"]["right"].get<double>() == Approx(-0.1));
  CHECK(std::filesystem::exists(folder.path / "out/restart/00000002.restart"));
  CHECK_THAT(folder.read("out/block.pvd"), Contains("timestep=\"0.5\""));

  // The obstacle gone, the run goes on from there.
  const Result resumed = seam(run(folder, scene, "out") +
                              " --resume --changed --set 'fields.block.boundary.1.displacement=[-0.2*t, 0]'");
  CHECK(resumed.code == 0);
  CHECK(summary(folder, "out")["status"] == "finished");
  CHECK(summary(folder, "out")["steps"] == 4);
}

TEST_CASE("seam verify counts checks by what they say of the program") {
  const Folder folder;
  std::string text = pulled;
  text.replace(text.find("checks: ["), 9,
               "checks: [{that: unknowns, kind: exact, at_least: 1, source: there are some}, "
               "{that: tip, kind: trend, at_least: 0, source: pulled upwards}, "
               "{that: tip, kind: trend, at_most: 0, source: wrong}, "
               "{that: tip, kind: reference, at_least: 0, source: none}, ");
  const std::string good = folder.file("good.yaml", pulled), mixed = folder.file("mixed.yaml", text);
  const Result result = seam("verify " + good + " " + mixed + " --quiet", "env -C " + folder.path.string());
  INFO(result.output);
  CHECK(result.code == 1);
  CHECK_THAT(result.output,
             Contains("checks that hold: exact 1 of 1, reference 1 of 1, trend 1 of 2, regression 2 of 2\n"));
}

TEST_CASE("the scene hash tells overrides apart") {
  const Folder folder;
  const std::string scene = folder.file("pulled.yaml", pulled);
  REQUIRE(seam(run(folder, scene, "a")).code == 0);
  REQUIRE(seam(run(folder, scene, "b") + " --set parameters.load=1.1").code == 0);
  REQUIRE(seam(run(folder, scene, "c")).code == 0);
  const auto hash = [&](const std::string& where) { return summary(folder, where)["scene_hash"]; };
  CHECK(hash("a") == hash("c"));
  CHECK(hash("a") != hash("b"));
  CHECK(summary(folder, "b")["overrides"][0] == "parameters.load=1.1");
}

TEST_CASE("an error of all ranks is printed once, one of a single rank stops all", "[mpi]") {
  const Folder folder;
  const std::string scene = folder.file("pushed.yaml", pushed);
  const std::string two = "timeout 1000 mpirun --oversubscribe -np 2";
  const Result all = seam(run(folder, scene, "out"), two);
  CHECK(all.code == 1);
  const std::string message = "the step from t = 0.5 fails";
  CHECK_THAT(all.output, Contains(message));
  CHECK(all.output.find(message) == all.output.rfind(message));
  CHECK(summary(folder, "out")["ranks"] == 2);

  // The second rank is given another scene, which it cannot read.
  const Result one = seam(run(folder, scene, "out") + " : -np 1 " SEAM_COMMAND " run /nowhere/scene.yaml",
                          "timeout 1000 mpirun --oversubscribe -np 1");
  CHECK(one.code == 2);
  CHECK_THAT(one.output, Contains("there is no such file") && Contains("on rank 1 of 2 only"));
}

TEST_CASE("seam study runs all combinations and reports measures, costs and orders") {
  const Folder folder;
  const std::string scene = folder.file("pulled.yaml", pulled +
                                                           "study:\n  vary: {order: [1, 2], n: [2, 4, 8]}\n"
                                                           "  leave_out: order == 2 && n > 4\n"
                                                           "  measure: [tip, error(tip)]\n");
  const Result result = seam("study " + scene + " --folder " + (folder.path / "study").string());
  INFO(result.output);
  REQUIRE(result.code == 0);
  const std::string csv = folder.read("study/study.csv");
  const std::size_t head = csv.find("\norder,n,tip,error(tip),unknowns,seconds.total");
  REQUIRE(head != std::string::npos);
  CHECK_THAT(csv, Contains("# machine: ") && Contains("# commit: ") && Contains("# command: seam study "));
  const std::string table = csv.substr(head + 1);
  CHECK(std::count(table.begin(), table.end(), '\n') == 6);
  CHECK_THAT(line(table, 1), Catch::StartsWith("1,2,"));
  CHECK_THAT(line(table, 5), Catch::StartsWith("2,4,"));
  CHECK_THAT(folder.read("study/study.md"), Contains("observed order"));
  CHECK(std::filesystem::file_size(folder.path / "study/study.png") > 10000);
}

TEST_CASE("seam study lets keys change together and survives a case that fails") {
  const Folder folder;
  const std::string study =
      "study:\n  vary: {parameters.n: [1, 2], E: [50, 100], time.end: [0.5, 1]}\n"
      "  together: [parameters.n, E]\n  against: E\n  measure: right\n";
  const Result result = seam("study " + folder.file("pushed.yaml", pushed + study) + " --folder " +
                             (folder.path / "s").string());
  INFO(result.output);
  CHECK(result.code == 1);
  const std::string csv = folder.read("s/study.csv");
  CHECK_THAT(csv, Contains("\n1,50,0.5,-0.1") && Contains("\n2,100,0.5,-0.1") &&
                      Contains("the step from t = 0.5 fails"));
}

TEST_CASE("mistakes in a study are found before the first run") {
  const Folder folder;
  const auto output = [&](const std::string& study) {
    const Result result =
        seam("study " + folder.file("s.yaml", pulled + study) + " --folder " + folder.path.string());
    CHECK(result.code == 2);
    return result.output;
  };
  CHECK_THAT(output(""), Contains("has no `study` block"));
  CHECK_THAT(output("study: {vary: {lod: [1, 2]}, measure: tip}\n"), Contains("Did you mean 'load'?"));
  CHECK_THAT(output("study: {vary: {n: [1, 2]}, measure: tip, against: load}\n"),
             Contains("is no key of `vary`"));
  CHECK_THAT(output("study: {vary: {n: [1, 2], load: [1]}, together: [n, load], measure: tip}\n"),
             Contains("expected as many of each"));
  CHECK_THAT(output("study: {vary: {n: [1, 2]}, measure: tip, leave_out: m > 1}\n"),
             Contains("study.leave_out"));
  CHECK_THAT(output("study: {vary: {fields.block.mash: [block]}, measure: tip}\n"), Contains("mash"));
  CHECK_THAT(output("study: {vary: {n: [1]}, measure: tap}\n"), Contains("Did you mean 'tip'?"));
}
