// SPDX-License-Identifier: BSD-3-Clause
// What unknowns declare of themselves, and what solvers make of it.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "seam/base/plugin_fault.hpp"
#include "seam/field/field.hpp"
#include "seam/linear/equilibration.hpp"
#include "seam/linear/mumps_solver.hpp"
#include "seam/mesh/mesh.hpp"
#include "seam/record/probes.hpp"
#include "seam/solve/newton.hpp"
#include "solver/diffusion.hpp"
#include "solver/krylov.hpp"

using namespace seam;
using test::DiagonalInverse;

namespace {

/// Equations of two fields of one unknown each, coupled at random.
struct TwoKinds {
  static constexpr int nodes = 12, n = 2 * nodes;
  Matrix matrix;
  std::vector<EquationBlock> blocks;
  /// @param row, column what the equations, and the values, of the second are multiplied by
  /// @param scale that the second declares @param coupling size of what either does to the other
  explicit TwoKinds(double row = 1, double column = 1, double scale = 0, double coupling = 1) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    matrix.global_rows = n;
    matrix.allocate(n, n * n, n * n);
    for (int r = 0; r < n; ++r) {
      matrix.column_global.push_back(r);
      matrix.unknown.push_back(r);
      for (int c = 0; c < n; ++c) {
        matrix.column[r * n + c] = c;
        matrix.value[r * n + c] = (number(random) + (r == c ? 8 : 0)) * (r < nodes ? 1 : row) *
                                  (c < nodes ? 1 : column) * ((r < nodes) == (c < nodes) ? 1 : coupling);
      }
      matrix.row_start[r + 1] = static_cast<std::size_t>(r + 1) * n;
    }
    for (const int first : {0, nodes}) {
      EquationBlock& block = blocks.emplace_back();
      block.field = first == 0 ? "a" : "b";
      block.first = first;
      block.count = nodes;
      block.unknowns.emplace_back().scale = first == 0 ? 0 : scale;
      for (int r = 0; r < nodes; ++r) block.unknowns[0].rows.push_back(first + r);
    }
  }
  /// Weight of the second unknown's equations over that of the first's.
  [[nodiscard]] double ratio() const {
    const std::vector<double> weight = equation_weights(matrix, blocks);
    for (int r = 0; r < n; ++r) REQUIRE(weight[r] == weight[r < nodes ? 0 : nodes]);
    return weight[nodes] / weight[0];
  }
};

/// Flow of a very viscous fluid with quadratic velocities and linear pressures (Taylor and Hood).
struct Creeping {
  using v = Vector<0>;
  using p = Scalar<1>;
  using Reads = Slots<Gradient<v>, Value<p>>;
  using Tests = Slots<Gradient<v>, Value<p>>;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    auto stress = s.gradient(v{});
    T divergence = 0;
    for (int i = 0; i < dim; ++i) {
      divergence += stress(i, i);
      stress(i, i) -= s.value(p{});
    }
    r.gradient(v{}) += stress;
    r.value(p{}) -= divergence;
  }
};

class TaylorHood final : public Physics {
 public:
  [[nodiscard]] std::vector<Unknown> unknowns(int dim) const override {
    return {{"velocity", dim, 2, 0, "m/s"}, {"pressure", 1, 1, 0, "Pa", UnknownRole::constraint}};
  }
  void build(FieldSetup& setup) const override {
    setup.add_cell_term(make_term(Creeping{}, 0), {"velocity", "pressure"});
    for (const char* wall : {"y_min", "y_max"})
      for (int c = 0; c < 2; ++c) setup.prescribe(wall, "velocity", c, Expression(0.0), {});
    setup.prescribe("x_min", "velocity", 0, Expression("4*y*(1 - y)", {}), {});
    setup.prescribe("x_min", "velocity", 1, Expression(0.0), {});
  }
};

/// One unknown, declared as it is said to be.
class Declared final : public Physics {
 public:
  explicit Declared(Unknown unknown) : unknown_(std::move(unknown)) {}
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override { return {unknown_}; }
  [[nodiscard]] std::string displacement() const override { return "u"; }
  void build(FieldSetup&) const override {}

 private:
  Unknown unknown_;
};

}  // namespace

TEST_CASE("residuals are weighed alike in whatever units the unknowns are") {
  const double plain = TwoKinds().ratio();
  CHECK(plain == Approx(1).epsilon(0.5));
  CHECK(TwoKinds(1e6, 1).ratio() == Approx(plain / 1e6));
  CHECK(TwoKinds(1e-9, 1e4).ratio() == Approx(plain * 1e9));
  // Where nothing couples them the size that an unknown declares says how large its equations' terms are.
  CHECK(TwoKinds(1, 1, 100, 0).ratio() == Approx(TwoKinds(1, 1, 1, 0).ratio() / 100));
}

TEST_CASE("equations in small units are solved as well as those in large ones") {
  const TwoKinds system(1e12, 1e-6);
  std::vector<double> exact(TwoKinds::n, 1.0), b, x;
  for (int r = TwoKinds::nodes; r < TwoKinds::n; ++r) exact[r] = 1e6;
  multiply(system.matrix, exact, b);
  KrylovSolver solver = test::krylov("ilu", {1e-10, 0, 0, {}});
  CHECK(solver.solve(system.matrix, system.blocks, b, x).iterations > 1);
  for (int r = 0; r < TwoKinds::n; ++r) CHECK(x[r] == Approx(exact[r]).epsilon(1e-8));
}

TEST_CASE("a field's own inverse is taken for its equations, with rows counted from its first") {
  const TwoKinds system;
  const std::vector<double> b(TwoKinds::n, 1.0);
  std::vector<double> x, y;
  DiagonalInverse::built = 0;
  KrylovSolver plain = test::krylov("ilu", {1e-10, 0, 0, {}}),
               own = test::krylov("ilu", {1e-10, 0, 0, {{"b", "diagonal"}}});
  const int few = plain.solve(system.matrix, system.blocks, b, x).iterations;
  CHECK(DiagonalInverse::built == 0);
  CHECK(own.solve(system.matrix, system.blocks, b, y).iterations > few);
  CHECK(DiagonalInverse::built == 1);
  for (int r = 0; r < TwoKinds::n; ++r) CHECK(y[r] == Approx(x[r]).epsilon(1e-8));
  KrylovSolver unknown = test::krylov("ilu", {1e-10, 0, 0, {{"c", "diagonal"}}});
  CHECK_THROWS_WITH(unknown.solve(system.matrix, system.blocks, b, y),
                    Catch::Contains("there is no field 'c'"));
}

TEST_CASE("what a physics declares of its near-null space are motions without strain") {
  for (const int dim : {2, 3}) {
    const std::vector<double> x = {0.1, 0.7, -0.4, 1.1, 0.2, 0.9, -0.3, 0.5, 0.8, 0.6, -0.2, 0.3};
    const int nodes = static_cast<int>(x.size()) / dim;
    EquationUnknown unknown{
        "u", dim, UnknownRole::motion, NearNullspace::rigid_motions, 0, std::vector<int>(x.size()), x};
    const auto modes = near_nullspace(unknown, dim);
    REQUIRE(modes.size() == (dim == 2 ? 3U : 6U));
    for (const auto& mode : modes) {
      double largest = 0;
      for (int a = 0; a < nodes; ++a)
        for (int b = 0; b < a; ++b) {
          double stretch = 0;
          for (int d = 0; d < dim; ++d)
            stretch += (mode[a * dim + d] - mode[b * dim + d]) * (x[a * dim + d] - x[b * dim + d]);
          CHECK(std::abs(stretch) < 1e-14);
          for (int d = 0; d < dim; ++d) largest = std::max(largest, std::abs(mode[a * dim + d]));
        }
      CHECK(largest > 0.1);
    }
    for (std::size_t m = dim; m < modes.size(); ++m) CHECK(modes[m] != modes[m - 1]);
    unknown.near_nullspace = NearNullspace::constants;
    const auto constants = near_nullspace(unknown, dim);
    REQUIRE(constants.size() == static_cast<std::size_t>(dim));
    for (int m = 0; m < dim; ++m)
      for (int a = 0; a < nodes; ++a)
        for (int d = 0; d < dim; ++d) CHECK(constants[m][a * dim + d] == (d == m ? 1 : 0));
  }
}

TEST_CASE("quadratic velocities with linear pressures are solved iteratively as directly", "[ranks]") {
  const auto solved = [&](LinearSolver& solver) {
    Problem problem{Communicator()};
    Field& flow = problem.add_field(
        "flow", std::make_shared<Mesh>("box", test::box(CellType::quadrilateral, 36), Communicator()),
        std::make_unique<TaylorHood>());
    problem.finish();
    problem.initialise(0);
    Newton newton(problem, solver, {1e-9, 1e-5, 10, true});
    const TimePoint at = time_point(1, 0, 1);
    problem.begin_step(at);
    const NewtonReport report = newton.solve(at);
    INFO(report.reason);
    REQUIRE(report.converged);
    std::vector<std::vector<double>> values;
    for (const Block& block : flow.blocks()) values.push_back(block.now.value);
    return values;
  };
  MumpsSolver direct;
  KrylovSolver iterative = test::krylov("schur", {1e-10, 0, 0, {}});
  const auto expected = solved(direct), found = solved(iterative);
  for (std::size_t b = 0; b < expected.size(); ++b) {
    double size = 0, most = 0;
    for (std::size_t i = 0; i < expected[b].size(); ++i) {
      size = std::max(size, std::abs(expected[b][i]));
      most = std::max(most, std::abs(expected[b][i] - found[b][i]));
    }
    CHECK(size > 0.5);
    CHECK(most < 1e-6 * size);
  }
}

TEST_CASE("what an unknown cannot declare is the plugin's fault") {
  const auto declare = [](Unknown unknown) {
    Problem problem{Communicator()};
    problem.add_field("body",
                      std::make_shared<Mesh>("box", test::box(CellType::quadrilateral, 2), Communicator()),
                      std::make_unique<Declared>(std::move(unknown)));
  };
  declare({"c", 1, 1, 0, ""});
  CHECK_THROWS_WITH(declare({"c", 1, 1, 0, "", UnknownRole::plain, NearNullspace::rigid_motions}),
                    Catch::Contains("its unknown 'c' has 1 components: rigid motions have 2"));
  CHECK_THROWS_WITH(declare({"c", 1, 1, 0, "", UnknownRole::plain, NearNullspace::constants, -1}),
                    Catch::Contains("has the scale -1"));
  declare({"u", 2, 1, 0, "m", UnknownRole::motion});
  CHECK_THROWS_WITH(declare({"u", 2, 1, 0, "m"}), Catch::Contains("does not say so: UnknownRole::motion"));
  CHECK_THROWS_AS(declare({"c", 1, 1, 0, "", UnknownRole::plain, NearNullspace::constants, std::nan("")}),
                  PluginFault);
}

namespace {

/// x, and twice that as the second component.
struct Places {
  using Reads = Slots<Value<test::c>>;
  static constexpr int values(int dim) { return dim; }
  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>&, double* value) const {
    for (int d = 0; d < dim; ++d) value[d] = (d + 1) * x.position[0];
  }
};

/// Records integrals of one number and of a vector.
class WithIntegrals final : public Physics {
 public:
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override { return {{"c", 1, 1, 0, ""}}; }
  void build(FieldSetup& setup) const override {
    setup.add_cell_term(make_term(test::Diffusion{1}), {"c"});
    setup.add_integral("places", make_quantity(Places{}), {"c"});
  }
};

}  // namespace

TEST_CASE("an integral of a vector is recorded by its components") {
  Problem problem{Communicator()};
  problem.add_field("body",
                    std::make_shared<Mesh>("box", test::box(CellType::quadrilateral, 2), Communicator()),
                    std::make_unique<WithIntegrals>());
  problem.finish();
  problem.initialise(0);
  Results results;
  record_integrals(problem, time_point(0, 0, 1), results);
  REQUIRE(results.series.size() == 2);
  CHECK(results.series.at("body.places.x").at(0) == Approx(0.5));
  CHECK(results.series.at("body.places.y").at(0) == Approx(1));
  CHECK(is_series_of("body.places.y", "body.places"));
  CHECK_FALSE(is_series_of("body.places.y", "body"));
  CHECK_FALSE(is_series_of("body.places", "body.place"));
}
