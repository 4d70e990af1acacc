// SPDX-License-Identifier: BSD-3-Clause
// A porous block in a fluid: its state of rest, and the sum of all forces.
#include <array>
#include <cmath>
#include <vector>

#include "scene_run.hpp"

using namespace seam_cli_test;

namespace {

/// One half of a block that stands in a fluid under pressure, its foot held; (lx - 1) x, (ly - 1) y is where
/// it rests: the equations P_xx = -p0 ly, P_yy = -p0 lx - q of its homogeneous strain, solved by themselves.
const std::string block_scene = R"(
title: A porous block in a fluid under pressure
dimension: 2
plugins: [solid, cutfem_fluid, poroelasticity, nitsche_fsci]
parameters: {n: 8, p0: 3, q: 1, permeability: 1e-3, end: 3, step: 1, tolerance: 1e-8}
meshes:
  tank: {grid: {from: [0, 0], to: [1, 2.5], cells: ["2*n", "5*n"]}}
  block: {grid: {from: [0, 0], to: [0.25, 1.85], cells: ["n/2", "2*n"]}}
fields:
  water:
    type: cutfem_fluid
    mesh: tank
    density: 1
    convection: false
    viscosity: 1
    boundary:
      - {on: [x_min, x_max, y_min], velocity: [0, 0]}
      - {on: y_max, traction: [0, -p0]}
  block:
    type: porous_solid
    mesh: block
    material: {type: neo_hookean, young: 50, poisson: 0}
    viscosity: 1
    porosity: {initial: 0.5, bulk: 100, opening: 1}
    permeability: ["${permeability}"]
    boundary:
      - {on: x_min, displacement: [0, null], velocity: [0, null]}
      - {on: y_min, displacement: [null, 0], velocity: [null, 0]}
      - {on: y_max, traction: [0, -q]}
interfaces:
  face: {type: embedded, field: water, body: block, boundaries: [x_max, y_max]}
coupling:
  - {type: fpi, on: face}
time: {end: "${end}", step: {initial: "${step}"}}
solver: {newton: {tolerance: "${tolerance}"}, linear: {type: direct}}
output:
  fields: false
  probes:
    side: {field: block, at: [0.25, 1.85], quantity: displacement}
    base: {field: block, at: [0.1, 0.3], quantity: pressure}
    pores: {field: block, at: [0.1, 1.6], quantity: velocity, component: magnitude}
    water: {field: water, at: [0.7, 0.7], quantity: pressure}
    flow: {field: water, at: [0.5, 1.2], quantity: velocity, component: magnitude}
    foot: {field: block, on: y_min, quantity: reaction, component: y}
    push: {interface: face, quantity: force, component: y}
)";
std::string with(std::string scene, const std::vector<std::array<std::string, 2>>& changes) {
  for (const auto& [from, to] : changes) {
    const std::size_t at = scene.find(from);
    REQUIRE(at != std::string::npos);
    scene.replace(at, from.size(), to);
  }
  return scene;
}

/// The same block on a solid ground, under loads that grow for a while.
std::string standing() {
  std::string scene = block_scene;
  const auto change = [&](const std::string& from, const std::string& to) {
    scene = with(scene, {{from, to}});
  };
  change("end: 3,", "end: 3, grow: 1e-9,");
  change("from: [0, 0], to: [1, 2.5]", "from: [0, -0.1], to: [1, 2.4]");
  change("fields:\n",
         "  ground: {grid: {from: [-0.1, -0.2], to: [1.1, 0], cells: [3, 1]}}\n"
         "fields:\n"
         "  ground:\n    type: solid\n    mesh: ground\n"
         "    material: {type: neo_hookean, young: 100, poisson: 0}\n"
         "    boundary: [{on: [x_min, x_max, y_min, y_max], displacement: [0, 0]}]\n");
  change("[x_min, x_max, y_min], velocity", "[x_min, x_max], velocity");
  change("traction: [0, -p0]", "traction: [0, \"-p0*min(t/grow, 1)\"]");
  change("      - {on: y_min, displacement: [null, 0], velocity: [null, 0]}\n", "");
  change("traction: [0, -q]", "traction: [0, \"-q*min(t/grow, 1)\"]");
  change(
      "{type: embedded, field: water, body: block, boundaries: [x_max, y_max]}\n",
      "{type: embedded_contact, field: water, body: block, to: ground, boundaries: [y_min, x_max, y_max]}\n"
      "  floor: {type: embedded_contact, field: water, body: ground, to: block}\n");
  change("  - {type: fpi, on: face}\n",
         "  - {type: porous_contact_in_fluid, on: face}\n"
         "  - {type: contact_in_fluid, on: floor, stress: other}\n");
  change(
      "    foot: {field: block, on: y_min, quantity: reaction, component: y}\n"
      "    push: {interface: face, quantity: force, component: y}\n",
      "  formulas: {foot: face_contact_force_y}\n");
  return scene;
}

/// On a porous ground.
std::string standing_on_pores() {
  return with(standing(),
              {{"    type: solid\n    mesh: ground\n",
                "    type: porous_solid\n    mesh: ground\n    viscosity: 1\n    porosity: {initial: 0.4}\n"
                "    permeability: [1e-3]\n"},
               {"displacement: [0, 0]}]\n",
                "displacement: [0, 0]}, {on: [x_min, x_max, y_min], velocity: [0, 0]}]\n"},
               {"body: ground, to: block}", "body: ground, to: block, boundaries: y_max}"},
               {"porous_contact_in_fluid, on: face}", "porous_contact_in_fluid, on: face, stress: own}"},
               {"{type: contact_in_fluid, on: floor", "{type: porous_contact_in_fluid, on: floor"}});
}

const std::string at_rest =
    " --set fields.water.initial.pressure=3 --set fields.block.initial.pressure=3 "
    "--set 'fields.block.initial.displacement=[\"0.0008518097369087929*x\", \"-0.018948380425042544*y\"]'";
constexpr double rest_x = 0.0008518097369087929, rest_y = -0.018948380425042544;

}  // namespace

TEST_CASE("a porous block rests in a fluid under pressure, and gets its load and what the fluid exerts",
          "[sanitized]") {
  SECTION("as its homogeneous state tells, held or standing on the ground") {
    const auto check_rest = [](const Run& run, double bound) {
      INFO(run.done.output);
      REQUIRE(run.done.code == 0);
      const auto last = [&](const std::string& name) { return run.series(name).back(); };
      CHECK(std::abs(last("side.x") - 0.25 * rest_x) < bound);
      CHECK(std::abs(last("side.y") - 1.85 * rest_y) < bound);
      CHECK(std::abs(last("base") - 3) < bound);
      CHECK(std::abs(last("water") - 3) < bound);
      CHECK(std::abs(last("pores")) < bound);
      CHECK(std::abs(last("flow")) < bound);
      CHECK(std::abs(last("foot") - (3 * (1 + rest_x) + 1) * 0.25) < bound);
    };
    for (const std::string momentum : {"total", "printed"}) {
      const std::string options = "--set fields.block.momentum=" + momentum;
      check_rest(Run(block_scene, options + at_rest), 1e-12);
      // From no load at all, in steps that are long beside what pores take to drain.
      const std::string march = " --set parameters.end=6e4 --set parameters.step=2e3";
      check_rest(Run(block_scene, options + march), 1e-9);
      check_rest(Run(standing(), options + at_rest), 1e-12);
      check_rest(Run(standing_on_pores(), options + at_rest + " --set fields.ground.initial.pressure=3"),
                 1e-12);
      check_rest(Run(standing(), options + march + " --set parameters.grow=1e4"), 1e-9);
    }
  }
  SECTION("at every permeability, from the first step on") {
    for (const std::string permeability : {"1e-2", "1e-4", "1e-6", "1e-8", "1e-10"}) {
      INFO(permeability);
      const Run run(block_scene,
                    "--set parameters.end=0.03 --set parameters.step=0.01 --set parameters.tolerance=1e-11 "
                    "--set parameters.permeability=" +
                        permeability);
      INFO(run.done.output);
      REQUIRE(run.done.code == 0);
      const std::vector<double> foot = run.series("foot"), push = run.series("push");
      REQUIRE(foot.size() == 4);
      for (std::size_t k = 1; k < foot.size(); ++k) CHECK(std::abs(foot[k] + push[k] - 0.25) < 1e-8 * 0.25);
    }
    const Run run(standing(),
                  "--set parameters.end=0.03 --set parameters.step=0.01 --set parameters.tolerance=1e-11 "
                  "--set parameters.grow=1 --set parameters.permeability=1e-2");
    INFO(run.done.output);
    REQUIRE(run.done.code == 0);
    const std::vector<double> force = run.series("face.force.y"), time = run.series("time");
    for (std::size_t k = 1; k < time.size(); ++k)
      CHECK(std::abs(force[k] - 0.25 * time[k]) < 1e-8 * 0.25 * time[k]);
  }
  SECTION("on the ground, too, which films of fluid part it from, under a load that comes at once") {
    // The pores carry all of it at first: nothing but their own pressure tells how hard the faces touch.
    const auto check_sudden = [](const std::string& extension, const std::string& permeability) {
      INFO(extension << ", " << permeability);
      const Run run(standing(),
                    "--set parameters.end=0.03 --set parameters.step=0.01 --set parameters.tolerance=1e-11 "
                    "--set 'fields.water.boundary.1.traction=[0, -3]' "
                    "--set 'fields.block.boundary.1.traction=[0, -1]' --set coupling.0.extension=" +
                        extension + " --set parameters.permeability=" + permeability);
      INFO(run.done.output);
      REQUIRE(run.done.code == 0);
      const std::vector<double> force = run.series("face.force.y");
      for (std::size_t k = 1; k < force.size(); ++k) CHECK(std::abs(force[k] - 0.25) < 1e-8 * 0.25);
      return force.size();
    };
    for (const std::string permeability : {"1e-2", "1e-6", "1e-8"})
      CHECK(check_sudden("constant", permeability) == 4);
    for (const std::string permeability : {"1e-2", "1e-4", "1e-6", "1e-8", "1e-10"})
      CHECK(check_sudden("pore_pressure", permeability) <= 10);
  }
  SECTION("on the ground, or next to it, its facets flush with those of the ground") {
    for (const std::string gap : {"0", "1e-9", "1e-7"}) {
      const Run run(standing(), "--set parameters.end=1 --set 'meshes.block.grid.from=[0, " + gap +
                                    "]' --set 'meshes.block.grid.to=[0.25, \"1.85 + " + gap + "\"]'");
      INFO(gap << run.done.output);
      REQUIRE(run.done.code == 0);
      CHECK(run.series("face.force.y").back() == Approx(0.25).epsilon(1e-8));
    }
  }
}
