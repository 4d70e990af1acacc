// SPDX-License-Identifier: BSD-3-Clause
// Flows around bodies that are cut out of the mesh, run as scenes: exact ones, and orders of manufactured
// ones.
#include "cut_flow.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "seam/record/checks.hpp"

using namespace seam;
using namespace seam::test;

namespace {

/// Runs a scene of configs/fluid; its checks decide.
void passes(const std::string& name, Overrides overrides) {
  const std::string path = SEAM_SOURCE_DIR "/configs/fluid/" + name + ".yaml";
  FlowRun flow(path, std::move(overrides));
  const Results& results = flow.run();
  for (const CheckResult& check : evaluate_checks(flow.scene().root.list("checks"), results)) {
    INFO(name << ": " << check.that << " = " << check.value << ", expected " << check.expected);
    CHECK(check.passed);
  }
}

}  // namespace

TEST_CASE("the sets of the thesis are numbers that stay whatever defaults become") {
  const auto results = [](const std::string& stabilisation) {
    FlowRun flow(SEAM_SOURCE_DIR "/configs/fluid/shear_2d.yaml",
                 {{"fields.water.stabilisation", stabilisation}, {"parameters.n", "15"}});
    return flow.run().series;
  };
  const std::string jumps = "pressure: 0.05, convective: 0.05, divergence: 5e-5, length: diameter}";
  CHECK(results("thesis") == results("{type: cip, " + jumps));
  CHECK(results("residual_thesis") == results("{type: residual, momentum: 1, volume: 1, " + jumps));
}

TEST_CASE("the default is residual-based of order 1, interior penalty of order 2") {
  const auto results = [](const std::string& order, const std::string& stabilisation) {
    Overrides overrides{{"fields.water.order", order}, {"parameters.n", "15"}};
    if (!stabilisation.empty()) overrides.push_back({"fields.water.stabilisation", stabilisation});
    FlowRun flow(SEAM_SOURCE_DIR "/configs/fluid/shear_2d.yaml", overrides);
    return flow.run().series;
  };
  CHECK(results("1", "") ==
        results("1",
                "{type: residual, momentum: 0.5, volume: 1, pressure: 0.05, convective: 0.005, divergence: "
                "5e-5, length: across}"));
  CHECK(results("2", "") ==
        results("2", "{type: cip, pressure: 0.05, convective: 0.005, divergence: 5e-5, length: across}"));
}

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

TEST_CASE("a manufactured flow around a disc converges with the expected orders", "[study]") {
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
  BodyInFlow flow{.exact = exact, .cell = cell, .cells = cells, .field = more, .time = time};
  const CutErrors coarse = errors_of(flow);
  flow.cells *= 2;
  const CutErrors fine = errors_of(flow);
  INFO(cell << " order " << order << " " << stabilisation << " " << time << ": v " << coarse.velocity
            << " -> " << fine.velocity << ", grad v " << coarse.gradient << " -> " << fine.gradient << ", p "
            << coarse.pressure << " -> " << fine.pressure);
  CHECK(std::log2(coarse.velocity / fine.velocity) > order + 1 - 0.15);
  CHECK(std::log2(coarse.gradient / fine.gradient) > order - 0.1);
  CHECK(std::log2(coarse.pressure / fine.pressure) > order + 0.4);
}

namespace {

void converges_around_sphere(const std::string& cell, const std::string& stabilisation, int cells) {
  BodyInFlow flow{.exact = spirals(),
                  .cell = cell,
                  .cells = cells,
                  .body = "{type: sphere, centre: [0.47, 0.53, 0.5], radius: 0.231}",
                  .field = "stabilisation: " + stabilisation};
  const CutErrors coarse = errors_of(flow);
  flow.cells *= 2;
  const CutErrors fine = errors_of(flow);
  INFO(cell << " " << stabilisation << ": v " << coarse.velocity << " -> " << fine.velocity << ", grad v "
            << coarse.gradient << " -> " << fine.gradient << ", p " << coarse.pressure << " -> "
            << fine.pressure);
  CHECK(std::log2(coarse.velocity / fine.velocity) > 1.8);
  CHECK(std::log2(coarse.gradient / fine.gradient) > 0.9);
  CHECK(std::log2(coarse.pressure / fine.pressure) > 1.4);
}

}  // namespace

TEST_CASE("a manufactured flow around a sphere converges with the expected orders", "[study]") {
  converges_around_sphere(GENERATE("hexahedron", "tetrahedron"), "cip", 5);
}

// The residual-based stabilisation reaches its order later: 1.5 from 4 to 8 cells per direction.
TEST_CASE("so it does with residual-based stabilisation on fine meshes", "[.long]") {
  converges_around_sphere(GENERATE("hexahedron", "tetrahedron"), "residual", 8);
}

TEST_CASE("the error does not depend on how thin the cut cells are", "[study]") {
  const ExactFlow exact = vortices("1", "0");
  const std::string stabilisation = GENERATE("cip", "residual");
  // `part` of the lowest row of active cells is fluid; the row below lies in the wall.
  const auto errors_with = [&](const std::string& part) {
    return errors_of(BodyInFlow{
        .exact = exact,
        .body = "{type: box, from: [-1, -1], to: [2, 0]}",
        .field = "stabilisation: " + stabilisation,
        .grid = fmt::format("from: [0, ({0} - 2)/16], to: [1, 1 + {0}/16], cells: [16, 18]", part)});
  };
  const auto stays_below = [&](double factor, const std::string& part, const CutErrors& other) {
    const CutErrors thin = errors_with(part);
    INFO(stabilisation << ", fluid part " << part << ": " << thin.velocity / other.velocity << " "
                       << thin.gradient / other.gradient << " " << thin.pressure / other.pressure);
    CHECK(thin.velocity < factor * other.velocity);
    CHECK(thin.gradient < factor * other.gradient);
    CHECK(thin.pressure < factor * other.pressure);
    return thin;
  };
  const CutErrors tenth = stays_below(1.1, "0.1", errors_with("0.5"));
  for (const std::string part : {"1e-2", "1e-4", "1e-6", "1e-8", "1e-10"}) stays_below(1.02, part, tenth);
}

TEST_CASE("with theta = 0.5 a scene has order 2 in time, though nobody knows its initial rates", "[study]") {
  // Linear in space, so that only the error in time is left.
  ExactFlow e;
  e.velocity = {"(1 + sin(3*t))*(0.5*x - y)", "(1 + sin(3*t))*(x - 0.5*y)"};
  e.rate = {"3*cos(3*t)*(0.5*x - y)", "3*cos(3*t)*(x - 0.5*y)"};
  e.gradient = {"0.5*(1 + sin(3*t))", "-(1 + sin(3*t))", "1 + sin(3*t)", "-0.5*(1 + sin(3*t))"};
  e.laplacian = {"0", "0"};
  e.pressure = "cos(3*t)*(x + 2*y)";
  e.pressure_gradient = {"cos(3*t)", "2*cos(3*t)"};
  e.viscosity = 20;
  BodyInFlow flow{.exact = e, .cells = 6, .time = "{theta: 0.5, end: 1, step: {initial: 0.0125}}"};
  const CutErrors coarse = errors_of(flow);
  flow.time = "{theta: 0.5, end: 1, step: {initial: 0.00625}}";
  const CutErrors fine = errors_of(flow);
  INFO("v " << coarse.velocity << " -> " << fine.velocity);
  CHECK(std::log2(coarse.velocity / fine.velocity) == Approx(2).margin(0.15));
}
