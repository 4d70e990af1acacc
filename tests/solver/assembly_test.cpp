// SPDX-License-Identifier: BSD-3-Clause
// The tangent of cell, face and interface terms, patterns, prescribed values, singular systems.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "diffusion.hpp"
#include "seam/assembly/assembler.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"

namespace {

using namespace seam;

/// Largest difference between the tangent and central differences of the residual, relative to the latter.
double tangent_error(Problem& problem, double amplitude) {
  const TimePoint at = time_point(1, 0, 1);
  problem.begin_step(at);
  for (FieldEntry& entry : problem.fields())
    for (Block& block : entry.field->blocks())
      for (int node = 0; node < block.space->nodes(); ++node)
        for (int k = 0; k < block.size; ++k) {
          // By global number, so that all ranks agree.
          const std::size_t i = static_cast<std::size_t>(node) * block.size + k;
          if (!block.prescribed[i])
            block.now.value[i] = amplitude * std::sin(1.7 * block.space->global_node(node) + k);
        }
  Assembler& assembler = problem.assembler();
  assembler.assemble(at, true);
  const int rows = assembler.matrix().rows;
  std::vector<double> direction(rows), product;
  for (int r = 0; r < rows; ++r)
    direction[r] = std::cos(2.3 * static_cast<double>(assembler.matrix().first_row + r));
  multiply(assembler.matrix(), direction, product);
  const std::vector<double> mask = assembler.residual();
  const double step = 1e-5 * amplitude;
  assembler.add_increment(direction, step);
  assembler.assemble(at, false);
  const auto ahead = assembler.residual();
  assembler.add_increment(direction, -2 * step);
  assembler.assemble(at, false);
  const auto behind = assembler.residual();
  double difference = 0, size = 0;
  for (int r = 0; r < rows; ++r) {
    if (ahead[r] == 0 && behind[r] == 0 && mask[r] == 0) continue;  // prescribed: identity rows
    const double slope = (ahead[r] - behind[r]) / (2 * step);
    difference = std::max(difference, std::abs(slope - product[r]));
    size = std::max(size, std::abs(slope));
  }
  return problem.communicator().max(difference) / problem.communicator().max(size);
}

}  // namespace

TEST_CASE("tangents of cell and interior face terms match finite differences", "[ranks]") {
  const CellType cell =
      GENERATE(CellType::quadrilateral, CellType::triangle, CellType::hexahedron, CellType::tetrahedron);
  const int order = GENERATE(1, 2);
  auto problem = test::diffusion_problem(cell, 3, {1.0, 0.3, 0.2, true, order, "0.2"});
  problem->finish();
  problem->initialise(0);
  INFO(name(cell) << " of order " << order);
  CHECK(tangent_error(*problem, 0.5) < 1e-6);
}

TEST_CASE("interior face terms couple neighbours of neighbours and see no jump of a smooth function") {
  auto narrow = test::diffusion_problem(CellType::quadrilateral, 6, {});
  narrow->finish();
  auto wide = test::diffusion_problem(CellType::quadrilateral, 6, {1.0, 0.1, 0.1, true, 1, "0"});
  wide->finish();
  CHECK(wide->assembler().matrix().entries() >
        1.5 * static_cast<double>(narrow->assembler().matrix().entries()));

  // A linear function has no jump: with no source its residual vanishes inside, penalty or not.
  auto smooth = test::diffusion_problem(CellType::quadrilateral, 6, {0.0, 1.0, 1.0, false, 2, "0"});
  smooth->finish();
  Block& block = smooth->fields()[0].field->blocks()[0];
  for (int node = 0; node < block.space->nodes(); ++node)
    block.now.value[node] = 1e-3 * (block.space->position(node)[0] + 2 * block.space->position(node)[1]);
  smooth->assembler().assemble(time_point(1, 0, 1), false);
  for (int node = 0; node < block.space->owned_nodes(); ++node) {
    const double* x = block.space->position(node);
    const bool inside = x[0] > 0.01 && x[0] < 0.99 && x[1] > 0.01 && x[1] < 0.99;
    const int row = smooth->assembler().row(*smooth->fields()[0].field, 0, node, 0);
    if (inside && row >= 0) CHECK(std::abs(smooth->assembler().residual()[row]) < 1e-9);
  }
}

TEST_CASE("a field that is not held is named", "[ranks]") {
  auto problem = test::diffusion_problem(CellType::quadrilateral, 4, {1.0, 0.0, 0.0, false, 1, "0"});
  problem->finish();
  problem->initialise(0);
  CHECK_THROWS_WITH(test::solve_static(*problem), Catch::Contains("field 'body' is not held") &&
                                                      Catch::Contains("its c can change by a constant"));
}

TEST_CASE("two conditions on the same unknown are reported with both places") {
  class Twice final : public Physics {
   public:
    [[nodiscard]] std::vector<Unknown> unknowns(int) const override { return {{"c", 1, 1, 0, ""}}; }
    void build(FieldSetup& setup) const override {
      setup.prescribe("x_min", "c", 0, Expression(1.0), {"scene.yaml", 3, 5});
      setup.prescribe("x_min", "c", 0, Expression(2.0), {"scene.yaml", 7, 5});
    }
  };
  Problem problem{Communicator()};
  CHECK_THROWS_WITH(
      problem.add_field("body",
                        std::make_shared<Mesh>("box", test::box(CellType::quadrilateral, 2), Communicator()),
                        std::make_unique<Twice>()),
      Catch::Contains("scene.yaml:3:5") && Catch::Contains("scene.yaml:7:5"));
}

TEST_CASE("the rounding of a residual is the root of the sum of the squares of what its unknowns round to") {
  auto problem = test::diffusion_problem(CellType::quadrilateral, 4, {});
  problem->finish();
  problem->initialise(0);
  Block& block = problem->fields()[0].field->blocks()[0];
  Assembler& assembler = problem->assembler();
  std::vector<double> value(static_cast<std::size_t>(assembler.matrix().rows), 0.0);
  std::vector<char> held(value.size(), 0);
  for (int node = 0; node < block.space->nodes(); ++node) {
    block.now.value[node] = 3 + std::sin(1.7 * node);
    const int row = assembler.row(*problem->fields()[0].field, 0, node, 0);
    if (row < 0) continue;
    value.at(row) = block.now.value[node];
    held.at(row) = block.prescribed[node];
  }
  REQUIRE(std::ranges::count(held, 1) > 0);
  assembler.assemble(time_point(1, 0, 1), true);
  const std::vector<double> rounding = assembler.rounding();
  const Matrix& a = assembler.matrix();
  for (int r = 0; r < a.rows; ++r) {
    double square = 0;  // what is held has no residual
    for (std::size_t k = a.row_start[r]; k < a.row_start[r + 1] && held[r] == 0; ++k)
      square += std::pow(a.value[k] * value[a.column[k]] * std::numeric_limits<double>::epsilon(), 2);
    CHECK(rounding[r] == Approx(std::sqrt(square)).epsilon(1e-12));
  }
}
