// SPDX-License-Identifier: BSD-3-Clause
// Porous bodies that seal: a plug between two pressures, films that contact encloses.
#include <cmath>
#include <vector>

#include "scene_run.hpp"

using namespace seam_cli_test;

namespace {

/// Half of a plug, pressed on the floor by its upper side. The fluid on its left is under pressure.
const std::string plug_scene = R"scene(
title: A plug between two pressures
dimension: 2
plugins: [solid, cutfem_fluid, poroelasticity, nitsche_fsci]
parameters: {shift: 1.3e-3, down: 0.06, pressure: 20}
meshes:
  box: {grid: {from: ["-0.5 - shift", -0.06], to: ["1.1 - shift", "0.34 - 1e-4"], cells: [16, 4]}}
  plug: {grid: {from: [0, 0], to: [0.6, 0.4], cells: [12, 8]}}
  floor: {grid: {from: [-0.6, -0.1], to: [1.2, 0], cells: [18, 1]}}
fields:
  water:
    type: cutfem_fluid
    mesh: box
    density: 1e-6
    convection: false
    viscosity: 0.01
    fix_pressure: never
    boundary:
      - {on: x_min, traction: ["t < 1 ? 0 : pressure*min(t - 1, 1)", 0]}
      - {on: y_max, slip: true}
  plug:
    type: porous_solid
    mesh: plug
    material: {type: neo_hookean, young: 100, poisson: 0.3}
    viscosity: 0.01
    porosity: {initial: 0.5, bulk: 5000}
    permeability: [1e-4]
    kozeny_carman: true
    boundary:
      - {on: x_max, displacement: [0, null]}
      - {on: y_max, displacement: [null, "-down*min(t, 1)"], seepage: 0}
  floor:
    type: solid
    mesh: floor
    material: {type: neo_hookean, young: 1e4, poisson: 0}
    boundary: [{on: [x_min, x_max, y_min, y_max], displacement: [0, 0]}]
interfaces:
  foot: {type: embedded_contact, field: water, body: plug, to: floor, boundaries: [y_min, x_min, x_max]}
  ground: {type: embedded_contact, field: water, body: floor, to: plug}
coupling:
  - {type: porous_contact_in_fluid, on: foot, extension: pore_pressure}
  - {type: contact_in_fluid, on: ground, stress: other, extension_reach: 0.1}
time: {end: 2.5, step: {initial: 0.05}}
solver: {linear: {type: direct}}
output:
  fields: false
  probes:
    inflow: {field: water, on: x_min, quantity: velocity, component: x}
    outflow: {field: water, on: x_max, quantity: velocity, component: x}
)scene";

}  // namespace

TEST_CASE("porous bodies seal between two pressures") {
  SECTION("a plug leaks as its pores let it") {
    const Run run(plug_scene);
    INFO(run.done.output);
    REQUIRE(run.done.code == 0);
    const std::vector<double> time = run.series("time"), leak = run.series("outflow"),
                              area = run.series("foot.contact_area"), volume = run.series("plug.volume"),
                              fluid_volume = run.series("plug.fluid_volume");
    CHECK(time.size() < 100);
    for (std::size_t k = 0; k < time.size(); ++k)
      if (time[k] > 2.3 && time[k] < 2.5) {
        // Darcy's law for the plug's mean length and porosity, with Kozeny's factor.
        const double reference = 0.6 * 0.4, height = 0.34, length = volume[k] / height,
                     fluid = fluid_volume[k] / reference,
                     opened = std::pow(fluid, 3) / (1 - fluid * fluid) * (1 - 0.25) / 0.125,
                     stretched = std::pow(length / 0.6, 2) / (volume[k] / reference);
        CHECK(leak[k] == Approx(1e-4 / 0.01 * opened * stretched * 20 * height / length).epsilon(0.1));
        CHECK(area[k] > 0.6);
      }
    CHECK(time.back() > 2.4);
  }
  SECTION("films that contact encloses have a level of pressure") {
    const Folder folder;
    const Result run =
        seam("run " SEAM_SOURCE_DIR
             "/configs/poro/confined_cartilage.yaml --no-picture --quiet --set checks=[] --set time.end=100 "
             "--set parameters.load=0.15 --set parameters.gap=1e-3 --set coupling.0.extension=constant --set "
             "coupling.1.extension=constant --set coupling.0.seal.dry=1e-4 --set coupling.1.seal.dry=1e-4 "
             "--folder " +
             (folder.path / "run").string());
    INFO(run.output);
    CHECK(run.code == 0);
  }
}
