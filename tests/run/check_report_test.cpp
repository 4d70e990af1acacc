// SPDX-License-Identifier: BSD-3-Clause
// What `seam check` says of a scene: units of what will be recorded, costs, all of it as JSON.

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/run_command.hpp"

using namespace seam_cli_test;

namespace {

std::string config(const std::string& name) { return SEAM_SOURCE_DIR "/configs/" + name + ".yaml"; }

/// Units by the names of series; "?" where there is none.
std::map<std::string, std::string> units(const nlohmann::json& report) {
  std::map<std::string, std::string> result;
  for (const auto& series : report["recorded"])
    result[series["name"]] = series["unit"].is_null() ? "?" : series["unit"].get<std::string>();
  return result;
}

nlohmann::json check(const std::string& arguments) {
  return nlohmann::json::parse(seam("check --json " + arguments).output);
}

}  // namespace

TEST_CASE("check tells the units of what will be recorded") {
  const auto stamp = units(check(config("contact/falling_stamp")));
  CHECK(stamp.at("tip") == "m");                   // a probe at a point
  CHECK(stamp.at("left") == "m^2/s");              // one of a velocity over a boundary
  CHECK(stamp.at("stamp.mismatch") == "m^1.5/s");  // of a coupling
  CHECK(stamp.at("water.dissipation") == "W");     // of a field
  CHECK(stamp.at("water.volume") == "m^2");
  CHECK(stamp.at("missing") == "?");  // a formula
  const auto sphere = units(check(config("fluid/sphere")));
  CHECK(sphere.at("drag") == "N");
  CHECK(sphere.at("outflow") == "m^3/s");
  // A probe with the name of its field: what the field records has units of its own.
  const Folder folder;
  const auto named = units(check(
      folder.file("s.yaml",
                  "title: a bar\ndimension: 2\nplugins: [solid]\nmeshes: {one: {grid: {from: [0, 0], to: [1, "
                  "1], cells: [1, "
                  "1]}}}\nfields: {one: {type: rigid_body, mesh: one, density: 1, body_force: [0, -1]}}\n"
                  "time: {end: 1, step: {initial: 0.5}}\noutput: {probes: {one: {field: one, quantity: "
                  "translation}}}\n")));
  CHECK(named.at("one.x") == "m");
  CHECK(named.at("one.y") == "m");
  CHECK(named.at("one.kinetic_energy") == "J");
}

TEST_CASE("check estimates memory and the seconds of a step") {
  const std::string scene = config("fluid/vortices");
  const std::string more = " --set parameters.n=64";
  const nlohmann::json fine = check(scene + more);
  // Of a run in this build: within what a busy machine does to it.
  const Folder folder;
  REQUIRE(seam("run " + scene + " --quiet --no-picture" + more + " --folder " + (folder.path / "r").string())
              .code == 0);
  const auto run = nlohmann::json::parse(folder.read("r/summary.json"));
  const double bytes = run["peak_memory_bytes"];
  CHECK(fine["memory_bytes"].get<double>() == Approx(bytes).epsilon(0.3));
  // Seconds of the least busy of some moments.
  const auto least = [](const std::string& arguments) {
    double seconds = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 5; ++i)
      seconds = std::min(seconds, check(arguments)["seconds_per_step"].get<double>());
    return seconds;
  };
  const double growth = least(scene + more) / least(scene);
  const double unknowns = fine["unknowns"].get<double>() / check(scene)["unknowns"].get<double>();
  CHECK(growth > 0.3 * unknowns);
  CHECK(growth < 10 * unknowns);
  CHECK(fine["includes_linear_solves"] == true);
  CHECK(check(scene + " --set solver.linear=krylov")["includes_linear_solves"] == false);
  // What solves is chosen by that, too.
  CHECK_THAT(fine["linear_solver"].get<std::string>(), Catch::StartsWith("direct: "));
  const nlohmann::json space = check(config("fluid/sphere") + " --set solver.linear=auto");
  CHECK_THAT(space["linear_solver"].get<std::string>(), Catch::StartsWith("krylov: "));
  CHECK(space["includes_linear_solves"] == false);
}

TEST_CASE("what is prescribed is a number, and --set knows the scene's parameters") {
  const Folder folder;
  const std::string text =
      "title: a block\ndimension: 2\nplugins: [solid]\nparameters: {late: 0.2}\n"
      "meshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [2, 2]}}}\n"
      "fields:\n  block:\n    type: solid\n    mesh: block\n"
      "    material: {type: neo_hookean, young: 10, poisson: 0.3}\n"
      "    boundary: [{on: x_min, displacement: [0, \"0.1*sqrt(t - late)\"]}]\n"
      "time: {end: 1, step: {initial: 0.5}}\n";
  const std::string file = folder.file("s.yaml", text);
  const Result undefined = seam("check " + file);
  CHECK(undefined.code == 2);
  CHECK_THAT(undefined.output, Catch::Contains("s.yaml:11:") && Catch::Contains("sqrt(t - late)") &&
                                   Catch::Contains("on boundary 'x_min' of field 'block'"));
  const Result unknown = seam("check " + file + " --set parameters.lat=0");
  CHECK(unknown.code == 2);
  CHECK_THAT(unknown.output, Catch::Contains("the scene has no parameter 'lat'. Did you mean 'late'?"));
  CHECK(seam("check " + file + " --set parameters.late=0").code == 0);
}

TEST_CASE("check --json holds errors and warnings with their places, and the exit code") {
  const Folder folder;
  const std::string file = folder.file("s.yaml",
                                       "title: a block\ndimension: 2\nplugins: [solid]\n"
                                       "meshes: {block: {grid: {from: [0, 0], to: [1, 1], cells: [2, 2]}}}\n"
                                       "fields:\n  block:\n    type: solid\n    mesh: block\n    densty: 1\n"
                                       "    material: {type: neo_hookean, young: -10, poisson: 0.3}\n");
  const Result refused = seam("check --json " + file);
  CHECK(refused.code == 2);
  const auto report = nlohmann::json::parse(refused.output);
  CHECK(report["ok"] == false);
  CHECK(report["exit_code"] == 2);
  REQUIRE(report["diagnostics"].size() == 2);
  const auto& first = report["diagnostics"][0];
  CHECK(first["severity"] == "error");
  CHECK(first["file"] == file);
  CHECK(first["line"] == 9);
  CHECK(first["column"] == 5);
  CHECK_THAT(first["message"].get<std::string>(), Catch::StartsWith("unknown key 'densty'"));
  CHECK(report["diagnostics"][1]["line"] == 10);
}

TEST_CASE("check refuses what a run refuses where it starts, with one exit code, and nothing else") {
  const Folder folder;
  const auto both = [&](const std::string& fields, const std::string& more) {
    const std::string file =
        folder.file("s.yaml",
                    "title: a bar\ndimension: 2\nplugins: [solid]\n"
                    "meshes: {bar: {grid: {from: [0, -1], to: [0.1, 0], cells: [1, 4]}}}\nfields: {bar: {" +
                        fields + ", mesh: bar}}\n" + more + "output: {fields: false}\n");
    return std::pair(
        seam("check " + file),
        seam("run " + file + " --quiet --no-picture --overwrite --folder " + (folder.path / "out").string()));
  };
  using Catch::Contains;
  const auto [check, run] = both(
      "type: solid, material: {type: neo_hookean, young: 10, poisson: 0.3}, body_force: [0, -1], density: 1",
      "time: {static: true, end: 1}\n");
  const std::string words = "field 'bar' is not held: its displacement can change by a rotation about z, a";
  CHECK(check.code == 2);
  CHECK_THAT(check.output, Contains("s.yaml:5:9: error: " + words));
  CHECK(run.code == 2);
  CHECK_THAT(run.output, Contains("s.yaml:5:9: error: the matrix is singular\n" + words));
  const std::string hinge = "constraints: [{type: joint, kind: hinge, body: bar, at: [0, 0]}]\n";
  // A load that grows from nothing holds what hangs, but not at the start; without a load nothing moves.
  for (const std::string time :
       {"time: {static: true, end: 1}\n", "time: {end: 1, step: {initial: 0.5}}\n"}) {
    const auto [hangs, swings] = both("type: rigid_body, force: [0, \"-2*t\"]", hinge + time);
    CAPTURE(hangs.output, swings.output);
    CHECK(hangs.code == 0);
    CHECK_THAT(hangs.output, !Contains("warning"));
    CHECK(swings.code == 0);
    const auto [idle, stays] = both("type: rigid_body", hinge + time);
    CAPTURE(idle.output, stays.output);
    CHECK(idle.code == 0);
    CHECK_THAT(idle.output,
               Contains("s.yaml:5:9: warning: nothing acts in the first step on what is not held, so that it "
                        "goes through: field 'bar' is not held: its rotation can change"));
    CHECK(stays.code == 0);
  }
}
