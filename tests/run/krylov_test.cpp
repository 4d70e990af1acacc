// SPDX-License-Identifier: BSD-3-Clause
// What the direct solver solves, the iterative one solves as well, or says by name what it cannot.
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "scene_run.hpp"

using namespace seam_cli_test;

namespace {

const std::string tight = "--set 'solver.linear={type: krylov, tolerance: 1e-9}' ";

const std::string unchecked = "--set 'checks=[]' --set 'output.statistics={}' ";

/// Values in the last row of `csv` under these names.
void agree(const std::string& scene, const std::string& options, std::initializer_list<const char*> names) {
  const ShippedRun direct(scene, unchecked + options), iterative(scene, unchecked + tight + options);
  CAPTURE(scene);
  for (const std::string name : names) {
    CAPTURE(name);
    const double expected = direct(name), found = iterative(name);
    CHECK(found != 0);
    CHECK(found == Approx(expected).epsilon(1e-6));
  }
}

}  // namespace

TEST_CASE("a pressure whose level only a body holds is found by the iterative solver") {
  agree("fsi/released_disc", "--set time.end=0.01 --set fields.water.fix_pressure=never",
        {"pole", "disc.strain_energy"});
  agree("fsi/pressed_block", "--set time.end=0.03", {"pressure", "block.volume", "block.strain_energy"});
}

TEST_CASE("at ten thousand unknowns the iterative solver finds what the direct one does", "[study]") {
  agree(
      "fsi/released_disc",
      "--set time.end=0.01 --set fields.water.fix_pressure=never --set parameters.n=60 --set parameters.m=20",
      {"pole", "disc.strain_energy", "water.kinetic_energy"});
  agree("fsi/pressed_block", "--set time.end=0.03 --set parameters.n=13 --set parameters.m=5",
        {"pressure", "block.volume", "block.strain_energy"});
  agree("solid/cook_incompressible", "--set parameters.n=32",
        {"corner.x", "corner.y", "membrane.strain_energy"});
  agree("poro/waves", "--set parameters.n=44", {"block.fluid_volume", "block.volume"});
  agree("poro/waves", "--set parameters.n=24 --set parameters.order=2",
        {"block.fluid_volume", "block.volume"});
  agree("fluid/duct", "--set parameters.n=2", {"drag_coefficient", "lift_coefficient", "pressure_drop"});
  agree("fluid/patch_vortices", "--set parameters.n=50 --set time.end=0.02",
        {"patch.kinetic_energy", "patch.dissipation", "water.kinetic_energy"});
}

TEST_CASE("multigrid knows how a slender beam turns: it takes few iterations") {
  const Run run(
      "title: Beam\ndimension: 2\nplugins: [solid]\n"
      "meshes: {beam: {grid: {from: [0, 0], to: [2, 0.1], cells: [240, 12]}}}\n"
      "fields:\n  beam:\n    type: solid\n    mesh: beam\n"
      "    material: {type: neo_hookean, young: 1e5, poisson: 0.3}\n"
      "    boundary: [{on: x_min, displacement: [0, 0]}, {on: x_max, traction: [0, 0.1]}]\n"
      "time: {static: true, end: 1, step: {initial: 1}}\n"
      "solver: {linear: {type: krylov, preconditioner: multigrid}}\noutput: {fields: false}\n");
  INFO(run.done.output);
  REQUIRE(run.done.code == 0);
  const auto results = nlohmann::json::parse(run.folder.read("out/summary.json")).at("results");
  // 14; with translations alone 58.
  CHECK(results.at("linear.iterations.most").get<double>() < 25);
}

TEST_CASE("each field may have an inverse of its own, and one that is not there is named") {
  const std::string scene = "fsi/released_disc", one_step = unchecked + "--set time.end=0.01 ";
  const ShippedRun expected(scene, one_step),
      mixed(scene, one_step +
                       "--set 'solver.linear={type: krylov, tolerance: 1e-9, fields: {water: {type: ilu, "
                       "fill: 1}, disc: multigrid}}'");
  CHECK(mixed("pole") == Approx(expected("pole")).epsilon(1e-6));

  const Folder folder;
  const Result done =
      seam("run " SEAM_SOURCE_DIR "/configs/" + scene + ".yaml --no-picture --quiet --folder " +
           (folder.path / "out").string() + " --set 'solver.linear={type: krylov, fields: {watre: ilu}}'");
  CAPTURE(done.output);
  CHECK(done.code != 0);
  CHECK_THAT(done.output, Catch::Contains("there is no field 'watre'"));
}

TEST_CASE("parts that only ties hold are solved by the iterative solver as by the direct one") {
  // Of the block, whose equations are enough for multigrid, both ends are tied: to what is held and to what
  // is loose itself.
  const auto run = [](const std::string& time, const std::string& linear, const std::string& ranks = "") {
    Run made(R"yaml(
title: A base, a block on it and a lid that only ties hold
dimension: 2
plugins: [solid]
meshes:
  base: {grid: {from: [0, 0], to: [1, 1], cells: [4, 4]}}
  block: {grid: {from: [0, 1], to: [1, 2], cells: [20, 20]}}
  lid: {grid: {from: [0, 2], to: [1, 3], cells: [4, 4]}}
fields:
  base: {type: solid, mesh: base, density: 1, material: {type: neo_hookean, young: 100, poisson: 0.3}, boundary: [{on: y_min, displacement: [0, 0]}]}
  block: {type: solid, mesh: block, density: 1, material: {type: neo_hookean, young: 1000, poisson: 0.3}}
  lid: {type: solid, mesh: lid, density: 1, material: {type: neo_hookean, young: 20, poisson: 0.3}, boundary: [{on: y_max, traction: ["0.5*t", "-0.2*t"]}]}
constraints:
  - {type: tied, fields: [block, base], boundaries: [y_min, y_max]}
  - {type: tied, fields: [block, lid], boundaries: [y_max, y_min]}
output:
  fields: false
  probes:
    top: {field: lid, at: [1, 3], quantity: displacement}
    seam: {field: block, at: [0.5, 1], quantity: displacement}
    force: {field: base, on: y_min, quantity: reaction}
time: {)yaml" + time +
                 "}\nsolver: {newton: {tolerance: 1e-11}, linear: " + linear + "}\n",
             "--quiet", ranks);
    CAPTURE(time, linear, ranks, made.done.output);
    REQUIRE(made.done.code == 0);
    const auto results = nlohmann::json::parse(made.folder.read("out/summary.json")).at("results");
    // Each linear system is solved to the end: the iterations of Newton's method are those of `direct`.
    return std::tuple(made.folder.read("out/series.csv"), results.at("newton.iterations.most").get<int>(),
                      results.at("linear.iterations.most").get<int>());
  };
  const auto check = [&](const std::string& time, const std::vector<std::array<std::string, 2>>& solved) {
    const auto [direct, newton, none] = run(time, "direct");
    CHECK(std::abs(column(direct, "top.x").back()) > 5e-4);
    CHECK(none == 0);
    CHECK(newton <= 6);
    for (const auto& [inverse, ranks] : solved) {
      const auto [found, iterations, linear] =
          run(time, "{type: krylov, tolerance: 1e-9, preconditioner: " + inverse + "}", ranks);
      CAPTURE(time, inverse, ranks, linear);
      CHECK(difference(direct, found, 1e-3) < 1e-9);
      CHECK(iterations == newton);
      CHECK(linear > 10);
      CHECK(linear < 90);
    }
  };
  check("static: true, end: 1", {{"schur", ""}, {"ilu", ""}, {"schur", "mpirun --oversubscribe -np 2"}});
  check("theta: 0.5, end: 0.1, step: {initial: 0.1}", {{"schur", ""}});
}

TEST_CASE("a preconditioner that was made for the rates at the start is not kept where it does not do") {
  const auto chain = [](int links, const std::string& linear) {
    std::string meshes, fields, joints;
    for (int k = 0; k < links; ++k) {
      const std::string n = std::to_string(k), place = "[" + n + ", 0";
      meshes += "  m" + n + ": {grid: {from: " + place + "], to: [" + std::to_string(k + 1) +
                ", 0.2], cells: [2, 1]}}\n";
      fields += "  b" + n + ": {type: rigid_body, mesh: m" + n + ", density: 1, body_force: [0, -9.81]}\n";
      joints += "  - {type: joint, kind: hinge, body: b" + n + ", at: " + place + "]" +
                (k > 0 ? ", to: b" + std::to_string(k - 1) : "") + "}\n";
    }
    const Run run("title: A chain\ndimension: 2\nplugins: [solid]\nmeshes:\n" + meshes + "fields:\n" +
                      fields + "constraints:\n" + joints +
                      "time: {theta: 0.5, end: 0.1, step: {initial: 0.005}}\n"
                      "solver: {newton: {tolerance: 1e-11}, linear: " +
                      linear + "}\noutput: {fields: false, probes: {end: {field: b" +
                      std::to_string(links - 1) + ", quantity: rotation}}}\n",
                  "--quiet");
    CAPTURE(run.done.output);
    REQUIRE(run.done.code == 0);
    return run.series("end");
  };
  for (const int links : {1, 2, 4}) {
    const std::vector<double> direct = chain(links, "direct");
    REQUIRE(direct.size() > 20);
    for (const std::string inverse : {"ilu", "schur"}) {
      const std::vector<double> krylov = chain(links, "{type: krylov, preconditioner: " + inverse + "}");
      REQUIRE(krylov.size() == direct.size());
      for (std::size_t k = 0; k < direct.size(); ++k)
        CHECK(krylov[k] == Approx(direct[k]).epsilon(0).margin(1e-12));
    }
  }
}
