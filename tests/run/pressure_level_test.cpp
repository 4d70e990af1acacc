// SPDX-License-Identifier: BSD-3-Clause
// The level of a pressure in fluid that is closed in, also where nothing flows.
#include <nlohmann/json.hpp>

#include "scene_run.hpp"

using Catch::Matchers::Contains;
using namespace seam_cli_test;

namespace {

/// Water at rest under gravity around a box, in a tank whose walls it slips along.
const std::string tank = R"yaml(
title: A tank
dimension: 2
plugins: [cutfem_fluid]
parameters: {order: 1, left: 0.25, right: 0.75, bottom: 0.25, top: 0.5, lid: 0}
meshes: {tank: {grid: {from: [0, 0], to: [1, 1], cells: [8, 8]}}}
fields:
  water:
    type: cutfem_fluid
    mesh: tank
    density: 2
    viscosity: 0.1
    order: ${order}
    body_force: [0, -10]
    boundary:
      - {on: [y_min, x_min, x_max], velocity: [0, 0]}
      - {on: y_max, velocity: ["lid*x*(1-x)*(t > 0.5)", 0]}
interfaces: {box: {type: cut, field: water, body: {type: box, from: [left, bottom], to: [right, top]}}}
coupling: [{type: fluid_wall, on: box, velocity: [0, 0]}]
time: {end: 1, step: {initial: 0.25}}
output:
  fields: false
  probes:
    bottom: {field: water, at: [0, 0], quantity: pressure}
    top: {field: water, at: [0, 1], quantity: pressure}
    speed: {field: water, at: [0.5, 0.875], quantity: velocity, component: magnitude}
    lift: {interface: box, quantity: force, component: y}
)yaml";

/// A fluid between a disc that turns and a circle that touches the four sides of the mesh's square.
const std::string ring = R"yaml(
title: A ring of fluid
dimension: 2
plugins: [cutfem_fluid]
parameters: {n: 8}
meshes: {box: {grid: {from: [-1, -1], to: [1, 1], cells: [2*n, 2*n]}}}
fields: {water: {type: cutfem_fluid, mesh: box, density: 1, viscosity: 0.3, order: 2}}
interfaces:
  inner: {type: cut, field: water, body: {type: circle, centre: [0, 0], radius: 0.5, facets: 200}}
  outer: {type: cut, field: water, body: {type: level_set, value: "1 - x^2 - y^2"}}
coupling:
  - {type: fluid_wall, on: inner, velocity: ["-2*y", "2*x"]}
  - {type: fluid_wall, on: outer, velocity: [0, 0]}
time: {static: true, end: 1}
output:
  fields: false
  probes: {at: {field: water, at: [0.75, 0], quantity: velocity, component: y}}
)yaml";

}  // namespace

TEST_CASE("water at rest under gravity is held where it is closed in") {
  for (const std::string order : {"1", "2"}) {
    const Run run(tank, "--set parameters.order=" + order);
    CAPTURE(run.done.output);
    REQUIRE(run.done.code == 0);
    CHECK(run.series("bottom").back() - run.series("top").back() == Approx(20).epsilon(1e-9));
    CHECK(run.series("speed").back() < 1e-9);
    // Its weight is not the body's: rho g times its area.
    CHECK(run.series("lift").back() == Approx(20 * 0.125).epsilon(1e-9));
  }
  // Before anything is solved there is neither a flow nor a pressure to compare with.
  const Folder folder;
  const Result checked =
      seam("check " + folder.file("scene.yaml", tank) + " --set fields.water.stabilisation=residual");
  CAPTURE(checked.output);
  CHECK(checked.code == 0);
  const Run later(tank, "--set parameters.lid=1");
  CAPTURE(later.done.output);
  CHECK(later.done.code == 0);
  CHECK(later.series("speed").back() > 1e-3);
}

TEST_CASE("a pressure that nothing holds is found where nothing flows", "[sanitized]") {
  for (const std::string ranks : {"", "mpirun --oversubscribe -np 2", "mpirun --oversubscribe -np 3"}) {
    const Run run(tank, "--set fields.water.fix_pressure=never parameters.bottom=0", ranks);
    CAPTURE(run.done.output);
    CHECK(run.done.code == 2);
    CHECK_THAT(run.done.output, Contains("field 'water' is not held: its pressure can change by a constant"));
  }
  // Each part for itself: the fluid below a body from wall to wall, while that above it can get out.
  const std::string below =
      "--set parameters.left=-0.1 parameters.right=1.1 parameters.bottom=0.3 parameters.top=0.6 "
      "'fields.water.boundary=[{on: [y_min, x_min, x_max], velocity: [0, 0]}]' fields.water.fix_pressure=";
  const Run run(tank, below + "never");
  CAPTURE(run.done.output);
  CHECK(run.done.code == 2);
  CHECK_THAT(run.done.output, Contains("its pressure can change by a constant"));
  CHECK(Run(tank, below + "auto").done.code == 0);
}

TEST_CASE("a boundary that the fluid touches in points only is not open") {
  for (const std::string n : {"7", "8"}) {
    const Run run(ring, "--set parameters.n=" + n);
    CAPTURE(run.done.output);
    REQUIRE(run.done.code == 0);
    // Taylor and Couette: A r + B/r.
    CHECK(run.series("at").back() == Approx(-2 * 0.25 / 0.75 * 0.75 + 2 * 0.25 / 0.75 / 0.75).epsilon(0.005));
  }
}

TEST_CASE(
    "a lid that swings costs one iteration a step, as a linear problem does, and is the same on all ranks") {
  const std::string scene = R"yaml(
title: Stokes flow under a lid that swings
dimension: 2
plugins: [cutfem_fluid]
meshes: {box: {grid: {from: [0, 0], to: [1, 1], cells: [6, 6]}}}
fields:
  water:
    type: cutfem_fluid
    mesh: box
    density: 1
    viscosity: 0.1
    convection: false
    boundary: [{on: y_max, velocity: ["sin(3*t)*x*(1 - x)", 0]}, {on: [x_min, x_max, y_min], velocity: [0, 0]}]
output: {fields: false, probes: {v: {field: water, at: [0.4, 0.7], quantity: velocity}}}
time: {theta: 0.5, end: 0.5, step: {initial: 0.05}}
)yaml";
  const Run run(scene, "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  const auto summary = nlohmann::json::parse(run.folder.read("out/summary.json"));
  for (const nlohmann::json& step : summary.at("newton")) CHECK(step["iterations"].size() <= 2);
  for (const std::string ranks : {"2", "3"}) {
    const Run shared(scene, "--quiet", "mpirun --oversubscribe -np " + ranks);
    CAPTURE(ranks, shared.done.output);
    REQUIRE(shared.done.code == 0);
    const auto alone = run.series("v.x"), together = shared.series("v.x");
    REQUIRE(together.size() == alone.size());
    for (std::size_t k = 0; k < alone.size(); ++k)
      CHECK(together[k] == Approx(alone[k]).epsilon(0).margin(1e-13));
  }
}

TEST_CASE("boundaries of a fluid move it as given, and bring its mass to their acceleration") {
  // Both ends of its one cell, so all of it: 2 kg.
  for (const std::string scheme : {"theta: 0.5", "theta: 1", "scheme: bdf2"})
    for (const double end : {10.0, 100.0}) {
      const Run run(R"yaml(
title: A box of fluid that is shaken
dimension: 2
plugins: [cutfem_fluid]
meshes: {box: {grid: {from: [0, 0], to: [2, 1], cells: [1, 1]}}}
fields: {water: {type: cutfem_fluid, mesh: box, density: 1, viscosity: 0.1, boundary: [{on: [x_min, x_max, y_min, y_max], velocity: ["0.3*cos(t)", "0.1*t^2"]}]}}
output:
  fields: false
  probes:
    v: {field: water, at: [2, 1], quantity: velocity}
    left: {field: water, on: x_min, quantity: reaction}
    right: {field: water, on: x_max, quantity: reaction}
  formulas: {x: left_x + right_x, y: left_y + right_y}
)yaml" + std::string("time: {") +
                        scheme + ", end: " + std::to_string(end) +
                        ", step: {initial: " + std::to_string(end / 50) + "}}\n",
                    "--quiet");
      CAPTURE(scheme, end, run.done.output);
      REQUIRE(run.done.code == 0);
      const std::vector<double> time = run.series("time"), v = run.series("v.x"), x = run.series("x"),
                                y = run.series("y");
      for (std::size_t k = 1; k < time.size(); ++k) {
        CHECK(v[k] == Approx(0.3 * std::cos(time[k])).epsilon(0).margin(1e-12));
        CHECK(x[k] == Approx(-0.6 * std::sin(time[k])).epsilon(0).margin(1e-12));
        CHECK(y[k] == Approx(0.4 * time[k]).epsilon(0).margin(1e-12 * end));
      }
    }
}
