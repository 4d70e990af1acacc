// SPDX-License-Identifier: BSD-3-Clause
// A body that moves through the mesh of a fluid: nothing may depend on how the run was cut into pieces, on
// the number of ranks, or on factorisations that were kept.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scene_run.hpp"

using Catch::Matchers::Contains;
using namespace seam_cli_test;

namespace {

std::string run(const Folder& folder, const std::string& where, const std::string& more = "") {
  return "run " SEAM_SOURCE_DIR "/tests/run/moving_disc.yaml --quiet --no-picture --folder " +
         (folder.path / where).string() + " " + more;
}

std::string series(const Folder& folder, const std::string& where) {
  return folder.read(where + "/series.csv");
}

}  // namespace

TEST_CASE("a run with a moving cut continues to the bit, also on other numbers of ranks") {
  const Folder folder;
  REQUIRE(seam(run(folder, "whole")).code == 0);
  REQUIRE(seam(run(folder, "parts", "--stop-after 5")).code == 0);
  REQUIRE(seam(run(folder, "parts", "--resume")).code == 0);
  CHECK(series(folder, "whole") == series(folder, "parts"));
  REQUIRE(seam(run(folder, "ranks", "--stop-after 7"), "mpirun --oversubscribe -np 2").code == 0);
  REQUIRE(seam(run(folder, "ranks", "--resume"), "mpirun --oversubscribe -np 3").code == 0);
  CHECK(difference(series(folder, "whole"), series(folder, "ranks")) < 1e-8);
}

TEST_CASE("factorisations kept over changing spaces lead to the same flow", "[study]") {
  const Folder folder;
  REQUIRE(seam(run(folder, "fresh")).code == 0);
  REQUIRE(seam(run(folder, "kept", "--set solver.linear.keep=15")).code == 0);
  CHECK(difference(series(folder, "fresh"), series(folder, "kept")) < 1e-6);
}

TEST_CASE("a step that uncovers more than a layer of cells is halved", "[sanitized]") {
  const Folder folder;
  REQUIRE(
      seam(run(folder, "long", "--set time.step.initial=0.6 --set meshes.channel.grid.cells=[60,30]")).code ==
      0);
  const auto rows = table(series(folder, "long"));
  CHECK(rows.size() > 3);
  CHECK(rows.back()[0] == 0.6);
}

TEST_CASE("a body that cannot be cut out in the middle of a run refuses the step, on all ranks") {
  const Folder folder;
  std::ofstream(folder.path / "rim.yaml") << R"yaml(
title: A body that is open below rises until its rim is in the water
dimension: 2
plugins: [solid, cutfem_fluid, nitsche_fsci]
meshes:
  box: {grid: {from: [0, 0], to: [1, 1], cells: [8, 8]}}
  stick: {grid: {from: [0.31, -0.52], to: [0.72, 0.21], cells: [2, 4]}}
fields:
  water: {type: cutfem_fluid, mesh: box, density: 1, viscosity: 1, boundary: [{on: [x_min, x_max], velocity: [0, 0]}]}
  stick:
    type: solid
    mesh: stick
    material: {type: neo_hookean, young: 1, poisson: 0}
    boundary: [{on: [x_min, x_max, y_min, y_max], displacement: [0, "1.2*t"]}]
interfaces: {skin: {type: embedded, field: water, body: stick, boundaries: [x_min, x_max, y_max]}}
coupling: [{type: fsi, on: skin}]
time: {theta: 1, end: 1, step: {initial: 0.05, minimum: 0.02}}
)yaml";
  for (const std::string& before :
       {std::string(), std::string("timeout 1000 mpirun --oversubscribe -np 2 ")}) {
    CAPTURE(before);
    const Result result = seam("run " + (folder.path / "rim.yaml").string() + " --quiet --folder " +
                                   (folder.path / (before.empty() ? "one" : "two")).string(),
                               before);
    CHECK(result.code != 0);
    CHECK_THAT(result.output, Contains("the step from t = 0.425 fails down to a length of 0.025"));
    CHECK_THAT(result.output, Contains("not closed inside of it"));
    CHECK_THAT(result.output, Contains("last good state (t = 0.425"));
  }
  // Such a body at the start is a mistake.
  const Result wrong = seam("run " + (folder.path / "rim.yaml").string() + " --quiet --folder " +
                            (folder.path / "wrong").string() + " --set meshes.stick.grid.from=[0.31,0.12]");
  CHECK_THAT(wrong.output, Contains("not closed inside of it") && !Contains("the step from"));
}

TEST_CASE("a flow that a moving cut reproduces is solved to a tolerance that rounding alone keeps it from") {
  const Run shear(R"yaml(
title: Couette flow with slip at a weak wall, a body moves through the mesh with the flow's own velocity on it
source: "u = 24 + 18.125 y, p = 10 (x - 1.6) + 4"
dimension: 2
plugins: [cutfem_fluid]
parameters: {n: 8, theta: 1, start: 0.01, step: 0.2}
meshes:
  box: {grid: {from: [0, 0], to: [1.6, 1.6], cells: [n, n]}}
fields:
  water:
    type: cutfem_fluid
    mesh: box
    density: 0.1
    viscosity: 0.16
    body_force: [100, 0]
    boundary:
      - {on: y_min, velocity: [24, 0], weak: true}
      - {on: y_max, velocity: [53, 0], weak: true}
      - {on: x_max, traction: [-4, 2.9]}
    initial: {velocity: ["24 + 18.125*y", 0], pressure: "10*(x - 1.6) + 4"}
interfaces:
  left: {type: cut, field: water, body: {type: box, from: ["-3 + start", -1], to: ["${start}", 3]}, motion: {translation: [t, 0]}}
coupling:
  - {type: fluid_wall, on: left, velocity: ["24 + 18.125*y", 0]}
time: {theta: "${theta}", end: 1, step: {initial: "${step}"}}
solver: {newton: {tolerance: 1e-12}}
output:
  errors:
    v: {field: water, unknown: velocity, exact: ["24 + 18.125*y", 0]}
    p: {field: water, unknown: pressure, exact: ["10*(x - 1.6) + 4"]}
checks:
  - {that: v.l2, kind: exact, is: 0, within: 1e-12, source: the flow itself}
  - {that: p.l2, kind: exact, is: 0, within: 1e-11, source: the flow itself}
)yaml",
                  "--quiet");
  CAPTURE(shear.done.output);
  CHECK(shear.done.code == 0);
}

TEST_CASE("iterations that cycle end with the cut as it was only where bodies hardly move on") {
  const Run run(R"yaml(
title: A rigid block that a jump of the traction drives back and forth across the line on which its front is
dimension: 2
plugins: [cutfem_fluid, solid, nitsche_fsci]
meshes:
  box: {grid: {from: [0, 0], to: [2, 1], cells: [16, 8]}}
  block: {grid: {from: [0.6, 0.3], to: [1.02, 0.7], cells: [2, 2]}}
fields:
  water:
    type: cutfem_fluid
    mesh: box
    density: 1e-3
    viscosity: 1e-3
    boundary:
      - {on: [x_min, y_min, y_max], velocity: [0, 0]}
      - {on: x_max, outflow: do_nothing}
  block: {type: rigid_body, mesh: block, density: 1}
  skin: {type: rigid_surface, mesh: block}
constraints: [{type: rigid, field: skin, body: block}]
interfaces:
  gamma: {type: embedded, field: water, body: skin}
coupling:
  - {type: fsi, on: gamma, jump: {stress: {fluid: ["x > 0.81 ? (x > 1.02 ? 0.5 : -0.5) : 0", 0, 0, 0]}}}
time: {end: 0.1, step: {initial: 0.1}}
output: {fields: false}
)yaml",
                "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  const auto summary = nlohmann::json::parse(run.folder.read("out/summary.json"));
  // 0.4 times 0.5 N/m on 0.168 kg/m: one side pushes by 0.012 m in 0.1 s, to and fro by twice as much.
  const nlohmann::json& first = summary.at("newton").front();
  CHECK(first.at("frozen") == true);
  CHECK(first.at("converged") == false);
  CHECK(first.at("reason").get<std::string>().find(
            "iterations cycle, and without an update of the cut bodies go on by 0.02") == 0);
  int frozen = 0;
  for (const nlohmann::json& step : summary.at("newton")) frozen += step.at("frozen") && step.at("converged");
  CHECK(frozen > 0);
}

TEST_CASE("joints and points of a body hold exactly in a step whose cut is not updated") {
  for (const std::string ranks : {"", "mpirun --oversubscribe -np 2"}) {
    const Run run(R"yaml(
title: A bar on a hinge that a jump of the traction turns back and forth across the line along its upper side
dimension: 2
plugins: [cutfem_fluid, solid, nitsche_fsci]
meshes:
  box: {grid: {from: [0, 0], to: [2, 1], cells: [16, 8]}}
  bar: {grid: {from: [0.6, 0.4], to: [1.4, 0.6], cells: [4, 1]}}
fields:
  water:
    type: cutfem_fluid
    mesh: box
    density: 1e-3
    viscosity: 1e-3
    boundary:
      - {on: [x_min, y_min, y_max], velocity: [0, 0]}
      - {on: x_max, outflow: do_nothing}
  bar: {type: rigid_body, mesh: bar, density: 1}
  skin: {type: rigid_surface, mesh: bar}
constraints:
  - {type: rigid, field: skin, body: bar}
  - {type: joint, kind: hinge, body: bar, at: [0.6, 0.5]}
interfaces:
  gamma: {type: embedded, field: water, body: skin}
coupling:
  - {type: fsi, on: gamma, jump: {stress: {fluid: [0, 0, 0, "y > 0.5 ? (y > 0.6 ? 0.5 : -0.5) : 0"]}}}
time: {end: 0.0125, step: {initial: 0.0125}}
output:
  fields: false
  probes:
    angle: {field: bar, quantity: rotation}
    middle: {field: bar, quantity: translation}
    tip: {field: skin, at: [1.4, 0.6], quantity: displacement}
    below: {field: skin, at: [1, 0.4], quantity: displacement}
)yaml",
                  "--quiet", ranks);
    CAPTURE(ranks, run.done.output);
    REQUIRE(run.done.code == 0);
    const nlohmann::json step =
        nlohmann::json::parse(run.folder.read("out/summary.json")).at("newton").front();
    REQUIRE(step.at("frozen") == true);
    REQUIRE(step.at("converged") == true);
    // About the hinge. Relations as they were when the cut was kept would leave 8e-7 m at the tip.
    const double angle = run.series("angle").back(), cosine = std::cos(angle) - 1, sine = std::sin(angle);
    CHECK(angle > 5e-4);
    const auto check = [&](const std::string& point, double x, double y) {
      CAPTURE(point, angle);
      CHECK(run.series(point + ".x").back() == Approx(cosine * x - sine * y).epsilon(0).margin(1e-14));
      CHECK(run.series(point + ".y").back() == Approx(sine * x + cosine * y).epsilon(0).margin(1e-14));
    };
    check("middle", 0.4, 0);
    check("tip", 0.8, 0.1);
    check("below", 0.4, -0.1);
  }
}

TEST_CASE("points of an interface that fail on one rank end the run on all of them, with their message",
          "[mpi]") {
  const Folder folder;
  std::ifstream in(SEAM_SOURCE_DIR "/tests/run/moving_disc.yaml");
  const std::string disc{std::istreambuf_iterator<char>(in), {}};
  const auto with = [](std::string text, const std::string& before, const std::string& what) {
    return text.insert(text.find(before), what);
  };
  struct Failure {
    std::string in, call, rank;
  };
  // At the start, and in the middle of a step.
  for (const auto& [where, call, rank] : std::vector<Failure>{
           {"follow", "1", "1"}, {"follow", "9", "0"}, {"update", "1", "0"}, {"update", "9", "1"}}) {
    std::string text = with(disc, "meshes:", "plugin_folders: [\"" SEAM_TROUBLE_PLUGIN "\"]\n");
    text = with(text, "cutfem_fluid]", "trouble, ");
    text = with(text, "coupling:",
                "  wall: {type: trouble, field: water, boundary: y_max, in: " + where + ", call: " + call +
                    ", rank: \"" + rank + "\"}\n");
    text = with(text, "time:", "  - {type: trouble, on: wall}\n");
    const Result result =
        seam("run " + folder.file("points.yaml", text) + " --quiet --no-picture --overwrite --folder " +
                 (folder.path / "r").string(),
             "timeout 100 mpirun --oversubscribe -np 2 ");
    CAPTURE(where, call, rank, result.output);
    CHECK(result.code == 3);
    CHECK_THAT(result.output, Contains("the points went astray") && Contains("boundary 'y_max'") &&
                                  Contains("of plugin 'trouble'"));
  }
}
