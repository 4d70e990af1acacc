// SPDX-License-Identifier: BSD-3-Clause
// Flows around bodies that are cut out of the mesh, run as scenes: exact ones, and orders of manufactured
// ones.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "couplings.hpp"
#include "exact_flow.hpp"
#include "fluid.hpp"
#include "seam/cut/body.hpp"
#include "seam/interface/matching.hpp"
#include "seam/run/checks.hpp"
#include "seam/run/simulation.hpp"

using namespace seam;
using namespace seam::test;

namespace {

/// What a scene may name: the core's types and this plugin's, compiled in.
Registry types() {
  Registry registry;
  register_linear_solvers(registry);
  register_interfaces(registry);
  register_bodies(registry);
  fluid::declare_stabilisations(registry);
  fluid::declare_couplings(registry);
  registry.add<Physics>(
      "field", "cutfem_fluid", fluid::Fluid::schema(),
      [](const Parameters& p, const Registry& r) { return std::make_unique<fluid::Fluid>(p, r); });
  return registry;
}

Results run(const Scene& scene, const Registry& registry) {
  Simulation simulation(scene, registry, Communicator());
  RunOptions options;
  options.folder = std::filesystem::temp_directory_path() / "seam_cut_flow_test";
  options.quiet = true;
  return simulation.run(options);
}

/// Runs a scene of configs/fluid; its checks decide.
void passes(const std::string& name, Overrides overrides) {
  const std::string path = SEAM_SOURCE_DIR "/configs/fluid/" + name + ".yaml";
  overrides.emplace_back("plugins", "[]");
  Registry registry = types();
  PluginHost host({});
  const Scene scene = load_scene(path, overrides, host, registry);
  for (const CheckResult& check : evaluate_checks(scene.root.list("checks"), run(scene, registry))) {
    INFO(name << ": " << check.that << " = " << check.value << ", expected " << check.expected);
    CHECK(check.passed);
  }
}

/// A disc with the exact velocity on its boundary, in the flow of `exact` on the unit square.
std::string disc_scene(const ExactFlow& exact, const std::string& cell, int cells, const std::string& more,
                       const std::string& time) {
  std::string field;
  for (const char c : exact.scene(more)) field += c == '\n' ? "\n    " : std::string(1, c);
  return fmt::format(
      "title: A disc in a manufactured flow\ndimension: 2\nplugins: []\n"
      "meshes: {{box: {{grid: {{from: [0, 0], to: [1, 1], cells: [{0}, {0}], cell: {1}}}}}}}\n"
      "fields:\n  water:\n    type: cutfem_fluid\n    mesh: box\n    {2}\n"
      "interfaces:\n  disc: {{type: cut, field: water, body: {{type: circle, centre: [0.47, 0.53], radius: "
      "0.231}}}}\n"
      "coupling: [{{type: fluid_wall, on: disc, velocity: {3}}}]\n"
      "time: {4}\noutput:\n  fields: false\n  errors:\n"
      "    v: {{field: water, unknown: velocity, exact: {3}, gradient: {5}}}\n"
      "    p: {{field: water, unknown: pressure, exact: [\"{6}\"]}}\n",
      cells, cell, field, quoted(exact.velocity), time, quoted(exact.gradient), exact.pressure);
}

struct Errors {
  double velocity, gradient, pressure;
};

Errors disc_errors(const std::string& text) {
  Registry registry = types();
  PluginHost host({});
  const Scene scene = parse_scene_text(text, "disc.yaml", {}, host, registry);
  const Results results = run(scene, registry);
  return {results.once.at("v.l2"), results.once.at("v.h1"), results.once.at("p.l2")};
}

}  // namespace

TEST_CASE("linear shear past a moving block is exact, on any position of the cut") {
  const std::string cell = GENERATE("quadrilateral", "triangle");
  const std::string stabilisation = GENERATE("cip", "residual");
  for (const std::string speed : {"0", "2", "1e-9", "1e-13"})
    passes("shear_2d", {{"meshes.channel.grid.cell", cell},
                        {"fields.water.stabilisation", stabilisation},
                        {"parameters.speed", speed}});
  passes("shear_2d", {{"meshes.channel.grid.cell", cell},
                      {"fields.water.stabilisation", stabilisation},
                      {"time.static", "true"},
                      {"parameters.start", "0"}});
}

TEST_CASE("linear shear past a moving block in space is exact") {
  const std::string cell = GENERATE("hexahedron", "tetrahedron");
  for (const std::string stabilisation : {"cip", "residual"})
    passes("shear_3d", {{"meshes.channel.grid.cell", cell}, {"fields.water.stabilisation", stabilisation}});
}

TEST_CASE("Couette flow on a cut wall is exact for every slip length and wall position") {
  const std::string cell = GENERATE("quadrilateral", "triangle");
  struct Wall {
    std::string slip, speed, traction;
  };
  const auto wall = GENERATE(values<Wall>({{"0", "24", "0"},
                                           {"1e-6", "5", "-2.9 + 0.16/1e-6*19"},
                                           {"1.6", "5", "-1"},
                                           {"1e12", "5", "-2.9"},
                                           {".inf", "5", "-2.9"}}));
  for (const std::string depth : {"0.137", "1e-3", "1e-8", "1e-12"})
    passes("couette_slip", {{"meshes.channel.grid.cell", cell},
                            {"coupling.0.slip_length", wall.slip},
                            {"parameters.wall_speed", wall.speed},
                            {"parameters.wall_traction", wall.traction},
                            {"parameters.depth", depth}});
}

TEST_CASE("a manufactured flow around a disc converges with the expected orders") {
  const auto [cell, order, stabilisation, cells] =
      GENERATE(table<std::string, int, std::string, int>({{"quadrilateral", 1, "cip", 20},
                                                          {"triangle", 1, "cip", 20},
                                                          {"quadrilateral", 1, "residual", 20},
                                                          {"triangle", 1, "residual", 20},
                                                          {"quadrilateral", 2, "cip", 10},
                                                          {"triangle", 2, "cip", 10}}));
  const std::string more = fmt::format("order: {}\nstabilisation: {}", order, stabilisation);
  const std::string time = GENERATE("{static: true, end: 1}", "{end: 0.01, step: {initial: 0.0025}}");
  const bool steady = time.starts_with("{static");
  const ExactFlow exact = steady ? vortices("1", "0") : vortices("cos(t)", "(-sin(t))");
  const Errors coarse = disc_errors(disc_scene(exact, cell, cells, more, time));
  const Errors fine = disc_errors(disc_scene(exact, cell, 2 * cells, more, time));
  INFO(cell << " order " << order << " " << stabilisation << " " << time << ": v " << coarse.velocity
            << " -> " << fine.velocity << ", grad v " << coarse.gradient << " -> " << fine.gradient << ", p "
            << coarse.pressure << " -> " << fine.pressure);
  CHECK(std::log2(coarse.velocity / fine.velocity) > order + 1 - 0.15);
  CHECK(std::log2(coarse.gradient / fine.gradient) > order - 0.1);
  CHECK(std::log2(coarse.pressure / fine.pressure) > order + 0.4);
}

TEST_CASE("the error does not depend on how thin the cut cells are") {
  const ExactFlow exact = vortices("1", "0");
  const std::string stabilisation = GENERATE("cip", "residual");
  std::string field;
  for (const char c : exact.scene("stabilisation: " + stabilisation))
    field += c == '\n' ? "\n    " : std::string(1, c);
  // `part` of the lowest row of active cells is fluid; the row below lies in the wall.
  const auto errors_of = [&](const std::string& part) {
    return disc_errors(fmt::format(
        "title: A wall that leaves a thin layer of cells\ndimension: 2\nplugins: []\n"
        "meshes: {{box: {{grid: {{from: [0, ({0} - 2)/16], to: [1, 1 + {0}/16], cells: [16, 18]}}}}}}\n"
        "fields:\n  water:\n    type: cutfem_fluid\n    mesh: box\n    {1}\n"
        "interfaces:\n  wall: {{type: cut, field: water, body: {{type: box, from: [-1, -1], to: [2, 0]}}}}\n"
        "coupling: [{{type: fluid_wall, on: wall, velocity: {2}}}]\n"
        "time: {{static: true, end: 1}}\noutput:\n  fields: false\n  errors:\n"
        "    v: {{field: water, unknown: velocity, exact: {2}, gradient: {3}}}\n"
        "    p: {{field: water, unknown: pressure, exact: [\"{4}\"]}}\n",
        part, field, quoted(exact.velocity), quoted(exact.gradient), exact.pressure));
  };
  const Errors half = errors_of("0.5");
  for (const std::string part : {"0.1", "1e-2", "1e-4", "1e-6", "1e-8", "1e-10"}) {
    const Errors thin = errors_of(part);
    INFO(stabilisation << ", fluid part " << part << ": " << thin.velocity / half.velocity << " "
                       << thin.gradient / half.gradient << " " << thin.pressure / half.pressure);
    CHECK(thin.velocity < 1.1 * half.velocity);
    CHECK(thin.gradient < 1.1 * half.gradient);
    CHECK(thin.pressure < 1.1 * half.pressure);
  }
}

TEST_CASE("with theta = 0.5 a scene has order 2 in time, though nobody knows its initial rates") {
  // Linear in space, so that only the error in time is left.
  ExactFlow e;
  e.velocity = {"(1 + sin(3*t))*(0.5*x - y)", "(1 + sin(3*t))*(x - 0.5*y)"};
  e.rate = {"3*cos(3*t)*(0.5*x - y)", "3*cos(3*t)*(x - 0.5*y)"};
  e.gradient = {"0.5*(1 + sin(3*t))", "-(1 + sin(3*t))", "1 + sin(3*t)", "-0.5*(1 + sin(3*t))"};
  e.laplacian = {"0", "0"};
  e.pressure = "cos(3*t)*(x + 2*y)";
  e.pressure_gradient = {"cos(3*t)", "2*cos(3*t)"};
  e.viscosity = 20;
  const Errors coarse =
      disc_errors(disc_scene(e, "quadrilateral", 6, "", "{theta: 0.5, end: 1, step: {initial: 0.0125}}"));
  const Errors fine =
      disc_errors(disc_scene(e, "quadrilateral", 6, "", "{theta: 0.5, end: 1, step: {initial: 0.00625}}"));
  INFO("v " << coarse.velocity << " -> " << fine.velocity);
  CHECK(std::log2(coarse.velocity / fine.velocity) == Approx(2).margin(0.15));
}
