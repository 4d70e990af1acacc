// SPDX-License-Identifier: BSD-3-Clause
// Manufactured flows on fitted meshes: orders in space for every cell type and stabilisation, orders in time.
#include <catch2/catch.hpp>
#include <cmath>

#include "flow_problem.hpp"

using namespace seam;
using namespace seam::test;

namespace {

std::string keys(int order, const std::string& stabilisation) {
  return "order: " + std::to_string(order) + "\nstabilisation: " + stabilisation;
}

FlowErrors solve(const ExactFlow& exact, Box box, const std::string& more, double end, int steps,
                 double theta = 1) {
  const auto problem = make_flow(box, exact.scene(more));
  march(*problem, end, steps, theta);
  return errors(*problem, exact, end);
}

/// Orders between two meshes of which the second has twice as many cells per direction.
FlowErrors observed(const ExactFlow& exact, Box box, const std::string& more, double end, int steps) {
  const FlowErrors coarse = solve(exact, box, more, end, steps);
  box.cells *= 2;
  const FlowErrors fine = solve(exact, box, more, end, steps);
  return {std::log2(coarse.velocity / fine.velocity), std::log2(coarse.gradient / fine.gradient),
          std::log2(coarse.pressure / fine.pressure)};
}

}  // namespace

TEST_CASE("steady flows in the plane converge with the expected orders", "[study]") {
  const auto [cell, order, cells, stabilisation] =
      GENERATE(table<CellType, int, int, std::string>({{CellType::quadrilateral, 1, 16, "cip"},
                                                       {CellType::triangle, 1, 16, "cip"},
                                                       {CellType::quadrilateral, 2, 8, "cip"},
                                                       {CellType::triangle, 2, 8, "cip"},
                                                       {CellType::quadrilateral, 1, 16, "residual"},
                                                       {CellType::triangle, 1, 16, "residual"}}));
  const FlowErrors orders =
      observed(vortices("1", "0"), {cell, cells, true}, keys(order, stabilisation), 1, 0);
  INFO(name(cell) << " of order " << order << ", " << stabilisation << ": " << orders.velocity << " "
                  << orders.gradient << " " << orders.pressure);
  CHECK(orders.velocity > order + 1 - 0.15);
  CHECK(orders.gradient > order - 0.1);
  CHECK(orders.pressure > order + 0.5);
}

TEST_CASE("steady flows in space converge with the expected orders", "[study]") {
  const auto [cell, cells, stabilisation] =
      GENERATE(table<CellType, int, std::string>({{CellType::hexahedron, 4, "cip"},
                                                  {CellType::tetrahedron, 4, "cip"},
                                                  {CellType::hexahedron, 6, "residual"},
                                                  {CellType::tetrahedron, 6, "residual"}}));
  const FlowErrors orders = observed(spirals(), {cell, cells, true}, keys(1, stabilisation), 1, 0);
  INFO(name(cell) << ", " << stabilisation << ": " << orders.velocity << " " << orders.gradient << " "
                  << orders.pressure);
  CHECK(orders.velocity > 1.8);
  CHECK(orders.gradient > 0.9);
  CHECK(orders.pressure > 1.4);
}

TEST_CASE("an unsteady flow converges in space", "[study]") {
  const std::string stabilisation = GENERATE("cip", "residual");
  const FlowErrors orders = observed(vortices("cos(t)", "(-sin(t))"), {CellType::quadrilateral, 12, true},
                                     keys(1, stabilisation), 0.01, 4);
  INFO(stabilisation << ": " << orders.velocity << " " << orders.gradient << " " << orders.pressure);
  CHECK(orders.velocity > 1.85);
  CHECK(orders.gradient > 0.9);
  CHECK(orders.pressure > 1.4);
}

TEST_CASE("the velocity has order 1 in time for theta = 1 and order 2 for theta = 0.5", "[study]") {
  // Linear in space, so that only the error in time is left; it turns, so that no pressure can take it up.
  ExactFlow e;
  e.velocity = {"cos(3*t)*(0.5*x - y)", "cos(3*t)*(x - 0.5*y)"};
  e.rate = {"-3*sin(3*t)*(0.5*x - y)", "-3*sin(3*t)*(x - 0.5*y)"};
  e.gradient = {"0.5*cos(3*t)", "-cos(3*t)", "cos(3*t)", "-0.5*cos(3*t)"};
  e.laplacian = {"0", "0"};
  e.pressure = "cos(3*t)*(x + 2*y)";
  e.pressure_gradient = {"cos(3*t)", "2*cos(3*t)"};
  // So viscous that the stabilisation hardly depends on the step.
  e.viscosity = 20;
  const std::string stabilisation = GENERATE("cip", "residual");
  for (const double theta : {1.0, 0.5}) {
    const Box box{CellType::quadrilateral, 3, true};
    const FlowErrors coarse = solve(e, box, keys(1, stabilisation), 1, 40, theta);
    const FlowErrors fine = solve(e, box, keys(1, stabilisation), 1, 80, theta);
    INFO(stabilisation << ", theta " << theta << ": v " << coarse.velocity << " -> " << fine.velocity
                       << ", p " << coarse.pressure << " -> " << fine.pressure);
    CHECK(std::log2(coarse.velocity / fine.velocity) == Approx(theta == 1.0 ? 1 : 2).margin(0.1));
  }
}
