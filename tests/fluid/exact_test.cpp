// SPDX-License-Identifier: BSD-3-Clause
// Flows that the discrete spaces hold exactly: every consistent term must leave them alone.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <limits>

#include "flow_problem.hpp"

using namespace seam;
using namespace seam::test;

namespace {

/// Couette flow u = 24 + 18.125 y, p = 10 (x - 1.6) + 4 with a wall at y = 0 on which the fluid slips, as in
/// [0, 1.6]^2 with viscosity 0.16: there the shear stress on the wall's outward side is -2.9.
ExactFlow couette() {
  ExactFlow e;
  e.velocity = {"24 + 18.125*y", "0"};
  e.rate = {"0", "0"};
  e.gradient = {"0", "18.125", "0", "0"};
  e.laplacian = {"0", "0"};
  e.pressure = "10*(x - 1.6) + 4";
  e.pressure_gradient = {"10", "0"};
  e.density = 1;
  e.viscosity = 0.16;
  return e;
}

/// The same flow with the wall as a weak condition. @param wall keys of the wall's condition
std::string couette_scene(const std::string& wall, const std::string& more) {
  const ExactFlow e = couette();
  return fmt::format(
      "density: {}\nviscosity: {}\nbody_force: [10, 0]\nboundary:\n"
      "  - {{on: y_min, weak: true, {}}}\n"
      "  - {{on: [x_min, y_max], velocity: {}}}\n"
      "  - {{on: x_max, traction: [\"-({})\", 2.9]}}\n{}",
      e.density, e.viscosity, wall, quoted(e.velocity), e.pressure, more);
}

void check_exact(const Problem& problem, const ExactFlow& exact, double tolerance) {
  const FlowErrors found = errors(problem, exact, 1);
  INFO("v " << found.velocity << ", grad v " << found.gradient << ", p " << found.pressure);
  CHECK(found.velocity < tolerance);
  CHECK(found.gradient < 100 * tolerance);
  CHECK(found.pressure < tolerance);
}

}  // namespace

TEST_CASE("Couette flow with Navier slip is exact for every slip length") {
  const CellType cell = GENERATE(CellType::quadrilateral, CellType::triangle);
  const std::string adjoint = GENERATE("skew", "symmetric", "none");
  for (const double slip : {0.0, 1e-6, 0.1, 1.6, 1e3, 1e12, std::numeric_limits<double>::infinity()}) {
    // The wall moves at 5 (at 24 where nothing slips); its traction makes up for the rest.
    const double speed = slip == 0 ? 24 : 5;
    const double traction = slip == 0 ? 0 : -2.9 + 0.16 / slip * 19;
    const std::string wall =
        fmt::format("velocity: [{}, 0], slip_length: {}, wall_traction: [{}, 7], adjoint: {}", speed,
                    std::isinf(slip) ? ".inf" : fmt::format("{:.17g}", slip), traction, adjoint);
    INFO(name(cell) << ", slip length " << slip << ", " << adjoint);
    const auto problem = make_flow({cell, 5, true}, couette_scene(wall, ""));
    march(*problem, 1, 0);
    check_exact(*problem, couette(), 1e-9);
  }
}

TEST_CASE("the published Couette case with slip: length 1.6, wall speed 5, wall traction -1") {
  const std::string stabilisation = GENERATE("cip", "residual");
  const auto problem = make_flow({CellType::quadrilateral, 6, true},
                                 couette_scene("velocity: [5, 0], slip_length: 1.6, wall_traction: [-1, 0]",
                                               "stabilisation: " + stabilisation));
  march(*problem, 1, 0);
  check_exact(*problem, couette(), 1e-9);
}

TEST_CASE("a steady flow stays what it is") {
  const std::string stabilisation = GENERATE("cip", "residual");
  const ExactFlow e = couette();
  const auto problem =
      make_flow({CellType::quadrilateral, 5, true},
                couette_scene("velocity: [5, 0], slip_length: 1.6, wall_traction: [-1, 0]",
                              fmt::format("initial: {{velocity: {}, pressure: \"{}\"}}\nstabilisation: {}",
                                          quoted(e.velocity), e.pressure, stabilisation)));
  march(*problem, 1, 4);
  check_exact(*problem, e, 1e-9);
}

TEST_CASE("a flow that grows linearly in time is exact with the implicit Euler method") {
  ExactFlow e;
  e.velocity = {"(1 + 2*t)*(2*x - y)", "(1 + 2*t)*(x - 2*y)"};
  e.rate = {"2*(2*x - y)", "2*(x - 2*y)"};
  e.gradient = {"2*(1 + 2*t)", "-(1 + 2*t)", "1 + 2*t", "-2*(1 + 2*t)"};
  e.laplacian = {"0", "0"};
  e.pressure = "(1 - t)*(3*x - y) + 2";
  e.pressure_gradient = {"3*(1 - t)", "-(1 - t)"};
  const std::string stabilisation = GENERATE("cip", "residual");
  const CellType cell = GENERATE(CellType::quadrilateral, CellType::triangle);
  const auto problem = make_flow({cell, 5, true}, e.scene("stabilisation: " + stabilisation));
  march(*problem, 1, 3);
  check_exact(*problem, e, 1e-9);
}

TEST_CASE("linear shear in space, imposed weakly on four sides") {
  ExactFlow e;
  e.velocity = {"5 + 30*y + 60*z", "0", "0"};
  e.rate = {"0", "0", "0"};
  e.gradient = {"0", "30", "60", "0", "0", "0", "0", "0", "0"};
  e.laplacian = {"0", "0", "0"};
  e.pressure = "10*(x - 0.5) + 4";
  e.pressure_gradient = {"10", "0", "0"};
  const CellType cell = GENERATE(CellType::hexahedron, CellType::tetrahedron);
  const std::string adjoint = GENERATE("skew", "symmetric");
  const auto problem = make_flow(
      {cell, 3, true},
      fmt::format("density: 1\nviscosity: 0.1\nbody_force: [10, 0, 0]\nboundary:\n"
                  "  - {{on: [y_min, y_max, z_min, z_max], weak: true, velocity: {}, adjoint: {}}}\n"
                  "  - {{on: x_min, velocity: {}}}\n"
                  "  - {{on: x_max, traction: [\"-({})\", 3, 6]}}\n",
                  quoted(e.velocity), adjoint, quoted(e.velocity), e.pressure));
  march(*problem, 1, 0);
  check_exact(*problem, e, 1e-9);
}

TEST_CASE("Poiseuille flow with order 2 is exact between every kind of ends") {
  ExactFlow e;
  e.velocity = {"4*y*(1 - y)", "0"};
  e.rate = {"0", "0"};
  e.gradient = {"0", "4 - 8*y", "0", "0"};
  e.laplacian = {"-8", "0"};
  e.density = 1;
  e.viscosity = 0.05;
  e.pressure = "0.4*(1 - x)";
  e.pressure_gradient = {"-0.4", "0"};
  const CellType cell = GENERATE(CellType::quadrilateral, CellType::triangle);
  // No traction at the end: u' is the shear stress there, so only `do_nothing` has the parabola.
  const std::string end =
      GENERATE("outflow: do_nothing", "outflow: do_nothing, backflow: 0.5", "velocity: [null, 0]");
  const auto problem =
      make_flow({cell, 4, false},
                fmt::format("density: 1\nviscosity: 0.05\norder: 2\nboundary:\n"
                            "  - {{on: x_min, velocity: {}}}\n  - {{on: [y_min, y_max], velocity: [0, 0]}}\n"
                            "  - {{on: x_max, {}}}\n",
                            quoted(e.velocity), end));
  INFO(name(cell) << ", " << end);
  march(*problem, 1, 0);
  check_exact(*problem, e, 1e-10);
}

TEST_CASE("plug flow between slipping walls is exact, strongly and on oblique sides weakly") {
  ExactFlow e;
  e.velocity = {"3", "0"};
  e.rate = e.laplacian = {"0", "0"};
  e.gradient = {"0", "0", "0", "0"};
  e.pressure = "0";
  e.pressure_gradient = {"0", "0"};
  const auto problem = make_flow({CellType::quadrilateral, 4, true},
                                 "density: 2\nviscosity: 0.3\nboundary:\n"
                                 "  - {on: x_min, velocity: [3, 0]}\n  - {on: [y_min, y_max], slip: true}\n"
                                 "  - {on: x_max, outflow: symmetric}\n");
  march(*problem, 1, 0);
  check_exact(*problem, e, 1e-11);
}

TEST_CASE("a closed cavity gets its pressure level, an open one does not") {
  ExactFlow e;
  e.velocity = {"y", "-x"};
  e.rate = e.laplacian = {"0", "0"};
  e.gradient = {"0", "1", "-1", "0"};
  e.pressure = "2*x + 3*y + 7";
  e.pressure_gradient = {"2", "3"};
  e.density = 1;
  const std::string flow = fmt::format("density: 1\nviscosity: {}\nbody_force: {}\npressure_level: 7\n",
                                       e.viscosity, quoted(e.body_force()));
  const auto closed =
      make_flow({CellType::triangle, 4, true},
                flow + fmt::format("boundary:\n  - {{on: [x_min, x_max, y_min, y_max], velocity: {}}}\n",
                                   quoted(e.velocity)));
  march(*closed, 1, 0);
  // The node that holds the level is the one with the lowest number: the corner at the origin.
  check_exact(*closed, e, 1e-9);

  // Here the side x_max is free of traction, so the level 7 at the origin would be wrong: p + 2 x + ...
  // follows.
  ExactFlow open = e;
  open.pressure = "2*(x - 1)";
  open.pressure_gradient = {"2", "0"};
  open.velocity = {"0", "0"};
  open.gradient = {"0", "0", "0", "0"};
  const auto tank = make_flow({CellType::triangle, 4, true},
                              "density: 1\nviscosity: 0.1\nbody_force: [2, 0]\nboundary:\n"
                              "  - {on: [x_min, y_min, y_max], velocity: [0, 0]}\n");
  march(*tank, 1, 0);
  check_exact(*tank, open, 1e-10);
}
