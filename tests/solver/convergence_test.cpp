// SPDX-License-Identifier: BSD-3-Clause
// Manufactured solutions: every cell type and order, static and dynamic.
#include <catch2/catch.hpp>
#include <cmath>
#include <tuple>

#include "manufactured.hpp"

namespace {

using namespace seam;
using test::Body;

struct Orders {
  double l2, h1;
};

/// Observed between two meshes of which the second has twice as many cells per direction.
Orders observed(Body body, double theta, double end, int steps) {
  const ErrorNorms coarse = test::solve(body, theta, end, steps);
  body.cells *= 2;
  const ErrorNorms fine = test::solve(body, theta, end, steps);
  INFO("L2 " << coarse.l2 << " -> " << fine.l2 << ", H1 " << *coarse.h1 << " -> " << *fine.h1);
  return {std::log2(coarse.l2 / fine.l2), std::log2(*coarse.h1 / *fine.h1)};
}

}  // namespace

TEST_CASE("a static manufactured solution converges with the expected orders", "[study]") {
  const auto [cell, order, cells] = GENERATE(table<CellType, int, int>({{CellType::quadrilateral, 1, 16},
                                                                        {CellType::quadrilateral, 2, 8},
                                                                        {CellType::triangle, 1, 16},
                                                                        {CellType::triangle, 2, 8},
                                                                        {CellType::hexahedron, 1, 6},
                                                                        {CellType::hexahedron, 2, 3},
                                                                        {CellType::tetrahedron, 1, 6},
                                                                        {CellType::tetrahedron, 2, 3}}));
  Body body;
  body.cell = cell;
  body.order = order;
  body.cells = cells;
  const Orders orders = observed(body, 1, 1, 1);
  INFO(name(cell) << " of order " << order);
  CHECK(orders.l2 > order + 1 - 0.1);
  CHECK(orders.h1 > order - 0.1);
}

TEST_CASE("a dynamic manufactured solution converges in space", "[study]") {
  const auto [cell, order, cells] = GENERATE(table<CellType, int, int>({{CellType::quadrilateral, 1, 12},
                                                                        {CellType::quadrilateral, 2, 6},
                                                                        {CellType::triangle, 1, 12},
                                                                        {CellType::triangle, 2, 6},
                                                                        {CellType::hexahedron, 1, 6},
                                                                        {CellType::hexahedron, 2, 3},
                                                                        {CellType::tetrahedron, 1, 6},
                                                                        {CellType::tetrahedron, 2, 3}}));
  Body body;
  body.cell = cell;
  body.order = order;
  body.cells = cells;
  body.dynamic = true;
  body.exact.frequency = 1;
  // Steps so short that the error of the discretisation in space alone shows.
  const bool plane = topology(cell).dimension == 2;
  const Orders orders = observed(body, 0.5, plane ? 1.0 : 0.2, plane ? 20 : 2);
  INFO(name(cell) << " of order " << order);
  CHECK(orders.l2 > order + 1 - 0.1);
  CHECK(orders.h1 > order - 0.1);
}

TEST_CASE("the time scheme has order 1 for theta = 1 and order 2 for theta = 0.5", "[study]") {
  Body body;
  body.dynamic = true;
  body.exact.linear = true;
  body.exact.frequency = 3;
  body.cell = GENERATE(CellType::quadrilateral, CellType::tetrahedron);
  body.cells = 2;
  for (const double theta : {1.0, 0.5}) {
    const double coarse = test::solve(body, theta, 1, 150).l2, fine = test::solve(body, theta, 1, 300).l2;
    INFO("theta " << theta << ": " << coarse << " -> " << fine);
    CHECK(std::log2(coarse / fine) == Approx(theta == 1.0 ? 1 : 2).margin(0.1));
  }
}

TEST_CASE("the mixed form converges with the displacement form's orders, nearly incompressible too",
          "[ranks][study]") {
  Body body;
  body.cell = GENERATE(CellType::quadrilateral, CellType::triangle);
  body.order = 2;
  body.mixed = true;
  body.cells = 8;
  body.poisson = 0.3;
  const Orders orders = observed(body, 1, 1, 1);
  CHECK(orders.l2 > 2.9);
  CHECK(orders.h1 > 1.9);
}

TEST_CASE("Newton's method is quadratic at large deformation", "[ranks]") {
  Body body;
  body.cells = 8;
  body.order = 2;
  std::tie(body.mixed, body.exact.amplitude) = GENERATE(table<bool, double>({{false, 0.2}, {true, 0.05}}));
  const auto problem = test::make_problem(body);
  MumpsSolver solver;
  Newton newton(*problem, solver, {1e-12, 1e-12, 12, true});
  problem->initialise(0, false);
  const TimePoint at = time_point(1, 0, 1);
  problem->begin_step(at);
  const auto history = newton.solve(at).history;
  // Residuals down to the first one at rounding.
  std::vector<double> residual;
  std::string shown;
  for (const NewtonIteration& iteration : history) {
    residual.push_back(std::log10(iteration.residual));
    shown += std::to_string(residual.back()) + " ";
    if (residual.back() < -12) break;
  }
  INFO("log10 of the residuals: " << shown);
  REQUIRE(residual.size() >= 4);
  REQUIRE(residual.back() < -12);
  // The last residual may be cut off by rounding, the ones before may not be in the basin yet: of the last
  // two observed orders the better one counts.
  const auto order = [&](std::size_t k) {
    return (residual[k] - residual[k - 1]) / (residual[k - 1] - residual[k - 2]);
  };
  const std::size_t last = residual.size() - 1;
  CHECK(std::max(order(last), order(last - 1)) > 1.9);
}
