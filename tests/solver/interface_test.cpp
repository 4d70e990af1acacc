// SPDX-License-Identifier: BSD-3-Clause
// Two fields that meet at a matching interface, whose cells may lie on different ranks.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "diffusion.hpp"
#include "seam/assembly/assembler.hpp"
#include "seam/cut/field_cut.hpp"
#include "seam/field/field.hpp"
#include "seam/interface/matching.hpp"
#include "seam/mesh/mesh.hpp"
#include "seam/record/error_norms.hpp"
#include "solver/krylov.hpp"

namespace {

using namespace seam;
using test::krylov;

/// Linear conduction in both bodies, transfer a (c0 - c1) between them.
struct Conduction {
  using Reads = Slots<Gradient<test::c>>;
  using Tests = Slots<Gradient<test::c>>;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.gradient(test::c{}) += s.gradient(test::c{});
  }
};

struct Transfer {
  using left = Scalar<0>;
  using right = Scalar<1>;
  using Reads = Slots<Value<left>, Value<right>>;
  using Tests = Reads;
  double a;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const T flux = a * (s.value(left{}) - s.value(right{}));
    r.value(left{}) += flux;
    r.value(right{}) -= flux;
  }
};

class Conductor final : public Physics {
 public:
  Conductor(int order, std::string held, double value)
      : order_(order), held_(std::move(held)), value_(value) {}
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override { return {{"c", 1, order_, 0, ""}}; }
  void build(FieldSetup& setup) const override {
    setup.add_cell_term(make_term(Conduction{}), {"c"});
    setup.prescribe(held_, "c", 0, Expression(value_), {});
  }

 private:
  int order_;
  std::string held_;
  double value_;
};

std::shared_ptr<const Mesh> half(CellType cell, double from, double to, int n) {
  Grid grid;
  grid.cell = cell;
  grid.lines[0] = graded_lines(from, to, n);
  for (int d = 1; d < topology(cell).dimension; ++d) grid.lines[d] = graded_lines(0, 1, 6);
  return std::make_shared<Mesh>("half", std::make_shared<MeshData>(make_grid(grid)), Communicator());
}

/// For an interface that needs neither cuts nor meshes of the scene.
struct PlainSetup final : InterfaceSetup {
  PlainSetup(std::vector<Field*> fields, int polynomial_degree) {
    sides = std::move(fields);
    degree = polynomial_degree;
  }
  FieldCut& cut(int) override { throw std::logic_error("nothing is cut here"); }
  std::string displacement(int) override { return ""; }
  std::shared_ptr<const MeshData> mesh(const std::string&) override { return nullptr; }
};

/// Bodies [0, 1] and [1, 2] with c = 0 and c = 1 at the far ends.
std::unique_ptr<Problem> two_bodies(CellType cell, int order) {
  auto problem = std::make_unique<Problem>(Communicator());
  std::vector<Field*> sides{
      &problem->add_field("left", half(cell, 0, 1, 5), std::make_unique<Conductor>(1, "x_min", 0.0)),
      &problem->add_field("right", half(cell, 1, 2, 3), std::make_unique<Conductor>(order, "x_max", 1.0))};
  Parameters p;
  p.set("fields", {std::vector<std::string>{"left", "right"}, {}, {}, true});
  p.set("boundaries", {std::vector<std::string>{"x_max", "x_min"}, {}, {}, true});
  PlainSetup setup(sides, 2 * order);
  problem->add_coupling(MatchingInterface(p).build(setup).front().domain,
                        {{make_term(Transfer{4.0}), {{0, "c"}, {1, "c"}}}});
  problem->finish();
  problem->initialise(0, false);
  return problem;
}

/// Those of a field of one scalar.
EquationBlock equations(const std::string& field, int first, int count) {
  EquationBlock block{field, 2, first, count, {}};
  EquationUnknown& unknown = block.unknowns.emplace_back();
  for (int r = 0; r < count; ++r) unknown.rows.push_back(first + r);
  return block;
}

void check_exact(Problem& problem) {
  // In series: two bodies of resistance 1, a gap of resistance 1/4; the flux is 1/(2 + 1/4).
  const double flux = 1 / 2.25;
  const TimePoint at = time_point(1, 0, 1);
  const std::vector<std::pair<std::string, double>> points{
      {"left", 1.0}, {"left", 0.3}, {"right", 1.0}, {"right", 1.7}};
  for (const auto& [name, x] : points) {
    const FieldEntry& entry = problem.field(name);
    std::vector<double> position{x, 0.4, 0.6};
    position.resize(entry.mesh->dimension());
    const ProbePoint probe(entry, position, {});
    const double expected = name == "left" ? flux * x : 1 - flux * (2 - x);
    CHECK(probe.evaluate(entry, find_quantity(entry, "c"), at)[0] == Approx(expected).epsilon(1e-9));
  }
}

}  // namespace

TEST_CASE("a message beyond the 2 GiB that MPI sends at once is refused") {
  // Never written to: the memory exists in name only.
  struct Large {
    Large() {}  // NOLINT(modernize-use-equals-default): this one leaves the bytes alone
    std::array<char, 1 << 20> bytes;
  };
  std::vector<std::vector<Large>> messages;
  messages.emplace_back(2048);
  CHECK_THROWS_WITH(Communicator().gather_all(messages.front()),
                    Catch::Contains("2147483648 bytes is beyond the 2 GiB"));
  CHECK_THROWS_WITH(Communicator().exchange<Large>(messages), Catch::Contains("beyond the 2 GiB"));
}

TEST_CASE("two bodies exchange through a matching interface", "[ranks]") {
  const CellType cell = GENERATE(CellType::quadrilateral, CellType::triangle, CellType::hexahedron);
  const int order = GENERATE(1, 2);
  INFO(name(cell) << ", right body of order " << order);
  auto problem = two_bodies(cell, order);
  REQUIRE(test::solve_static(*problem).converged);
  check_exact(*problem);
}

TEST_CASE("faces match up to rounding, not up to what is seen in a picture", "[ranks]") {
  const auto build = [](double shift) {
    Problem problem{Communicator()};
    Grid grid;
    grid.cell = CellType::quadrilateral;
    grid.lines[0] = graded_lines(1, 2, 3);
    grid.lines[1] = graded_lines(shift, 1 + shift, 6);
    const auto right =
        std::make_shared<Mesh>("half", std::make_shared<MeshData>(make_grid(grid)), Communicator());
    PlainSetup setup({&problem.add_field("left", half(CellType::quadrilateral, 0, 1, 5),
                                         std::make_unique<Conductor>(1, "x_min", 0.0)),
                      &problem.add_field("right", right, std::make_unique<Conductor>(1, "x_max", 1.0))},
                     2);
    Parameters p;
    p.set("fields", {std::vector<std::string>{"left", "right"}, {}, {}, true});
    p.set("boundaries", {std::vector<std::string>{"x_max", "x_min"}, {}, {}, true});
    return MatchingInterface(p).build(setup).front().domain->size();
  };
  CHECK(Communicator().sum(static_cast<long long>(build(1e-9))) == 6);
  // A ten thousandth of a face.
  CHECK_THROWS_WITH(build(1e-4 / 6), Catch::Contains("no matching face"));
  CHECK_THROWS_WITH(build(-1e-4 / 6), Catch::Contains("no matching face"));
}

TEST_CASE("the trace size on a matching interface is the volume of the first cell over its face", "[ranks]") {
  const CellType cell = GENERATE(CellType::quadrilateral, CellType::hexahedron);
  Problem problem{Communicator()};
  PlainSetup setup(
      {&problem.add_field("left", half(cell, 0, 1, 5), std::make_unique<Conductor>(1, "x_min", 0.0)),
       &problem.add_field("right", half(cell, 1, 2, 3), std::make_unique<Conductor>(1, "x_max", 1.0))},
      2);
  Parameters p;
  p.set("fields", {std::vector<std::string>{"left", "right"}, {}, {}, true});
  p.set("boundaries", {std::vector<std::string>{"x_max", "x_min"}, {}, {}, true});
  const auto domain = MatchingInterface(p).build(setup).front().domain;
  Element element;
  for (int e = 0; e < domain->size(); ++e) {
    domain->fill(e, element);
    CHECK(element.trace_size[0] == Approx(0.2).epsilon(1e-12));
    CHECK(element.cell_size[0] ==
          Approx(std::hypot(0.2, cell == CellType::hexahedron ? std::sqrt(2) / 6 : 1.0 / 6)));
  }
}

TEST_CASE("errors along an interface are those on the parts of it that bound the field", "[ranks]") {
  Problem problem{Communicator()};
  PlainSetup setup({&problem.add_field("left", half(CellType::quadrilateral, 0, 1, 5),
                                       std::make_unique<Conductor>(1, "x_min", 0.0)),
                    &problem.add_field("right", half(CellType::quadrilateral, 1, 2, 3),
                                       std::make_unique<Conductor>(1, "x_max", 1.0))},
                   2);
  Parameters p;
  p.set("fields", {std::vector<std::string>{"left", "right"}, {}, {}, true});
  p.set("boundaries", {std::vector<std::string>{"x_max", "x_min"}, {}, {}, true});
  std::vector<InterfacePart> parts = MatchingInterface(p).build(setup);
  const auto error = [&] {
    return interface_error_norms(parts, problem.field("left"), "c", {Expression(3.0)}, {}, 0).l2;
  };
  // All unknowns are 0, and the interface has length 1.
  CHECK(error() == Approx(3));
  parts.push_back(parts.front());
  CHECK(error() == Approx(3 * std::sqrt(2)));
  parts.back().bounds_field = false;
  CHECK(error() == Approx(3));
}

TEST_CASE("block Gauss-Seidel solves two coupled fields", "[ranks]") {
  const std::string preconditioner = GENERATE("multigrid", "schur", "ilu");
  auto problem = two_bodies(CellType::hexahedron, 1);
  KrylovSolver solver = krylov(preconditioner);
  Newton newton(*problem, solver, {1e-11, 1e-5, 10, true});
  const TimePoint at = time_point(1, 0, 1);
  problem->begin_step(at);
  const NewtonReport report = newton.solve(at);
  REQUIRE(report.converged);
  CHECK(report.history[0].linear_iterations < 60);
  check_exact(*problem);
}

TEST_CASE("a kept preconditioner serves a matrix that was built anew with the same pattern") {
  constexpr int n = 50;
  Matrix a;
  const auto fill = [&](double scale) {  // scale * tridiagonal(-1, 2.5, -1)
    a.allocate(n, 3 * n - 2, 3 * n - 2);
    std::size_t k = 0;
    for (int r = 0; r < n; ++r) {
      for (int c = std::max(0, r - 1); c < std::min(n, r + 2); ++c) {
        a.column[k] = c;
        a.value[k++] = scale * (c == r ? 2.5 : -1.0);
      }
      a.row_start[r + 1] = k;
    }
  };
  a.global_rows = n;
  for (int r = 0; r < n; ++r) a.column_global.push_back(r);
  const EquationBlock block = equations("c", 0, n);
  KrylovSolver solver = krylov("ilu");
  const std::vector<double> b(n, 1.0);
  std::vector<double> x, y;
  fill(1);
  solver.solve(a, {block}, b, x);
  fill(2);
  const SolveReport report = solver.solve(a, {block}, b, y);
  CHECK_FALSE(report.new_factorisation);
  for (int r = 0; r < n; ++r) CHECK(y[r] == Approx(x[r] / 2).epsilon(1e-9));
  // As after a step that failed.
  solver.forget();
  CHECK(solver.solve(a, {block}, b, y).new_factorisation);
}

namespace {

/// Equations of a chain of groups: each is coupled to itself, a little to its neighbours in the group, and to
/// the equation in the same place of the group before. The groups are blocks.
Matrix chain(int groups, int size, double before, const std::vector<double>& diagonal, double beside) {
  Matrix a;
  const int n = groups * size;
  a.global_rows = n;
  std::vector<std::vector<std::pair<int, double>>> rows(n);
  for (int r = 0; r < n; ++r) {
    const int place = r % size;
    if (r >= size) rows[r].emplace_back(r - size, before);
    if (place > 0) rows[r].emplace_back(r - 1, beside);
    rows[r].emplace_back(r, diagonal[r % diagonal.size()]);
    if (place + 1 < size) rows[r].emplace_back(r + 1, beside);
    a.column_global.push_back(r);
    a.unknown.push_back(r);
  }
  std::size_t entries = 0, k = 0;
  for (const auto& row : rows) entries += row.size();
  a.allocate(n, entries, entries);
  for (int r = 0; r < n; ++r) {
    for (const auto& [column, value] : rows[r]) {
      a.column[k] = column;
      a.value[k++] = value;
    }
    a.row_start[r + 1] = k;
  }
  return a;
}

std::vector<EquationBlock> blocks_of(int groups, int size) {
  std::vector<EquationBlock> blocks(groups);
  for (int g = 0; g < groups; ++g)
    blocks[g] = equations(std::string(1, static_cast<char>('a' + g)), g * size, size);
  return blocks;
}

}  // namespace

TEST_CASE("of blocks that depend on those before them one sweep is the inverse") {
  constexpr int groups = 4, size = 6;
  const Matrix a = chain(groups, size, 3, {4}, -1);
  KrylovSolver solver = krylov("ilu");
  std::vector<double> x;
  // Of three diagonals, an incomplete factorisation is the whole one.
  CHECK(solver.solve(a, blocks_of(groups, size), std::vector<double>(a.rows, 1.0), x).iterations == 1);
}

TEST_CASE("what is kept of a solver is given up once it costs too many iterations") {
  constexpr int n = 60;
  const std::vector<double> b(n, 1.0);
  std::vector<double> x;
  // A diagonal of k values, seen through the inverse of one of a single value, takes k iterations.
  const auto solved = [&](LinearSolver& solver, const std::vector<double>& diagonal) {
    const SolveReport report = solver.solve(chain(1, n, 0, diagonal, 0), blocks_of(1, n), b, x);
    for (int r = 0; r < n; ++r) REQUIRE(x[r] == Approx(1 / diagonal[r % diagonal.size()]).epsilon(1e-5));
    return report;
  };
  Parameters p;
  p.set("keep", {4L, {}, {}, true});
  MumpsSolver direct(p);  // keeps its factors up to 4 iterations
  KrylovSolver iterative =
      krylov("ilu");  // keeps up to 1.5 times the iterations of the first solve, one here
  for (LinearSolver* solver : {static_cast<LinearSolver*>(&direct), static_cast<LinearSolver*>(&iterative)}) {
    CAPTURE(solver == &direct);
    CHECK(solved(*solver, {1}).new_factorisation);
    CHECK_FALSE(solved(*solver, {2}).new_factorisation);
    const SolveReport slow = solved(*solver, {1, 2, 3, 4, 5, 6});
    CHECK_FALSE(slow.new_factorisation);
    CHECK(slow.iterations == 6);
    CHECK(solved(*solver, {1, 2, 3, 4, 5, 6}).new_factorisation);
    CHECK_FALSE(solved(*solver, {1, 2, 3, 4, 5, 6}).new_factorisation);
  }
  // After half as many again as it may take the direct solver factorises at once.
  CHECK(solved(direct, {1, 20, 3, 400, 5, 6000, 7, 80000, 9, 100, 11, 12}).new_factorisation);
}

TEST_CASE("a solver's word is not taken for its solution", "[ranks]") {
  // It says nothing of having failed.
  class Wrong final : public LinearSolver {
   public:
    explicit Wrong(double relative_error) : error_(relative_error) {}

   private:
    void solve_into(const Matrix& a, const std::vector<EquationBlock>& blocks, const std::vector<double>& b,
                    std::vector<double>& x, SolveReport& report) override {
      MumpsSolver solver;
      report = solver.solve(a, blocks, b, x);
      for (double& entry : x) entry *= 1 + error_;
    }
    double error_;
  };
  auto problem = two_bodies(CellType::quadrilateral, 1);
  problem->update_spaces(time_point(1, 0, 1));
  problem->assembler().assemble(time_point(1, 0, 1), true);
  const Assembler& assembler = problem->assembler();
  std::vector<double> x;
  const auto solve = [&](double error) {
    return Wrong(error).solve(assembler.matrix(), assembler.equation_blocks(),
                              std::vector<double>(assembler.matrix().rows, 1.0), x);
  };
  // A solution that is too large by a part leaves that part of the right-hand side.
  CHECK(solve(1e-7).relative_residual == Approx(1e-7).epsilon(1e-4));
  CHECK_THROWS_AS(solve(1e-5), SingularMatrix);
  CHECK_THROWS_AS(solve(-1), SingularMatrix);
  CHECK_THROWS_AS(solve(std::nan("")), SingularMatrix);
}

TEST_CASE("factors that are kept are dropped when a step is rewound", "[ranks]") {
  auto problem = two_bodies(CellType::quadrilateral, 1);
  Parameters keep;
  keep.set("keep", {20L, {}, {}, true});
  MumpsSolver solver(keep);
  problem->update_spaces(time_point(1, 0, 1));
  problem->assembler().assemble(time_point(1, 0, 1), true);
  const std::vector<double> b(problem->assembler().matrix().rows, 1.0);
  std::vector<double> x;
  const auto solve = [&] {
    return solver.solve(problem->assembler().matrix(), problem->assembler().equation_blocks(), b, x);
  };
  CHECK(solve().new_factorisation);
  CHECK_FALSE(solve().new_factorisation);
  solver.forget();
  CHECK(solve().new_factorisation);
}

TEST_CASE("faces without a partner are named") {
  auto problem = std::make_unique<Problem>(Communicator());
  std::vector<Field*> sides{&problem->add_field("left", half(CellType::quadrilateral, 0, 1, 5),
                                                std::make_unique<Conductor>(1, "x_min", 0.0)),
                            &problem->add_field("right", half(CellType::quadrilateral, 1.5, 2, 3),
                                                std::make_unique<Conductor>(1, "x_max", 1.0))};
  Parameters p;
  p.set("fields", {std::vector<std::string>{"left", "right"}, {}, {}, true});
  p.set("boundaries", {std::vector<std::string>{"x_max", "x_min"}, {}, {}, true});
  PlainSetup setup(sides, 2);
  CHECK_THROWS_WITH(
      MatchingInterface(p).build(setup),
      Catch::Contains("face of 'left' on boundary 'x_max'") && Catch::Contains("no matching face"));
}
