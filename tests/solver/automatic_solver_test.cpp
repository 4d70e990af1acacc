// SPDX-License-Identifier: BSD-3-Clause
// Which solver `auto` takes, and what `krylov` does when its preconditioner is too weak or too old.
#include "seam/linear/automatic_solver.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "seam/base/memory.hpp"
#include "seam/linear/krylov_solver.hpp"
#include "seam/plugin/registry.hpp"

using namespace seam;

namespace {

/// Rows (-1, diagonal, upper) of a chain, numbered from 0.
Matrix chain(int rows, double diagonal, double upper) {
  Matrix a;
  a.rows = rows;
  a.global_rows = rows;
  a.column_global.resize(rows);
  std::iota(a.column_global.begin(), a.column_global.end(), 0);
  a.unknown = a.column_global;
  const std::size_t entries = 3 * static_cast<std::size_t>(rows) - 2;
  a.allocate(rows, entries, entries);
  std::size_t next = 0;
  for (int r = 0; r < rows; ++r) {
    for (int c = std::max(0, r - 1); c <= std::min(rows - 1, r + 1); ++c) {
      a.column[next] = c;
      a.value[next++] = c == r ? diagonal : c < r ? -1 : upper;
    }
    a.row_start[r + 1] = next;
  }
  return a;
}

std::vector<EquationBlock> equations(int rows) {
  EquationUnknown c;
  c.name = "c";
  c.rows.resize(rows);
  std::iota(c.rows.begin(), c.rows.end(), 0);
  c.coordinates.resize(2 * static_cast<std::size_t>(rows));
  return {{"chain", 2, 0, rows, {c}}};
}

/// Solves a chain from the left, as its rows have nothing to their right; says what it was told to.
class Told final : public LinearSolver {
 public:
  struct Says {
    double operations_per_entry = 0, bytes = 0;
    bool works = true;
    int solved = 0;
  };
  explicit Told(Says& says) : says_(says) {}
  std::optional<Effort> effort(const Matrix& a) override {
    return Effort{says_.bytes, says_.operations_per_entry * static_cast<double>(a.entries())};
  }

 protected:
  void solve_into(const Matrix& a, const std::vector<EquationBlock>&, const std::vector<double>& b,
                  std::vector<double>& x, SolveReport&) override {
    ++says_.solved;
    if (!says_.works) throw SingularMatrix("it goes round in circles", {});
    for (int r = 0; r < a.rows; ++r) x[r] = (b[r] + (r > 0 ? x[r - 1] : 0)) / 2;
  }

 private:
  Says& says_;
};

struct Automatic {
  Told::Says direct, iterative;
  Registry registry;
  std::unique_ptr<AutomaticSolver> solver;
  Automatic() {
    const auto add = [&](const std::string& name, Told::Says& says) {
      registry.add<LinearSolver>(
          "linear_solver", name, Schema("For tests."),
          [&](const Parameters&, const Registry&) { return std::make_unique<Told>(says); });
    };
    add("factors", direct);
    add("rounds", iterative);
    Parameters p, factors, rounds;
    factors.set_type("factors");
    rounds.set_type("rounds");
    p.set("direct", {std::vector<Parameters>{factors}, {}, {}, true});
    p.set("iterative", {std::vector<Parameters>{rounds}, {}, {}, true});
    solver = std::make_unique<AutomaticSolver>(p, registry);
  }
  void solve(int rows = 10) {
    const Matrix a = chain(rows, 2, 0);
    std::vector<double> x;
    solver->solve(a, equations(rows), std::vector<double>(rows, 1.0), x);
    CHECK(x.back() == Approx(1 - std::pow(2, -rows)).epsilon(1e-12));
  }
};

/// Of a chain: nothing (fill 0) or the whole inverse of the matrix it was built for, whose rows have nothing
/// to their right. Notes what it was built with.
class Remembers final : public BlockInverse {
 public:
  static inline std::vector<long> built;
  explicit Remembers(long fill) : fill_(fill) {}
  void build(const Matrix& matrix, const EquationBlock&) override {
    built.push_back(fill_);
    diagonal_ = matrix.value[0];
  }
  void apply(std::span<const double> b, std::span<double> x) const override {
    for (std::size_t r = 0; r < b.size(); ++r)
      x[r] = fill_ == 0 ? b[r] : (b[r] + (r > 0 ? x[r - 1] : 0)) / diagonal_;
  }

 private:
  long fill_;
  double diagonal_ = 1;
};

KrylovSolver krylov(long fill, long restart) {
  static const Registry registry = [] {
    Registry all;
    Schema schema("For tests.");
    schema.integer("fill", "of the test").otherwise("0");
    all.add<BlockInverse>("block_inverse", "remembers", schema, [](const Parameters& p, const Registry&) {
      return std::make_unique<Remembers>(p.integer("fill"));
    });
    return all;
  }();
  Parameters inverse, p;
  inverse.set_type("remembers");
  inverse.set("fill", {fill, {}, {}, true});
  p.set("tolerance", {1e-10, {}, {}, true});
  p.set("maximum_iterations", {400L, {}, {}, true});
  p.set("restart", {restart, {}, {}, true});
  p.set("keep", {1.5, {}, {}, true});
  p.set("preconditioner", {std::vector<Parameters>{inverse}, {}, {}, true});
  p.set("fields", {std::vector<std::pair<std::string, Parameters>>{}, {}, {}, true});
  Remembers::built.clear();
  return {p, registry};
}

int iterations(KrylovSolver& solver, const Matrix& a) {
  std::vector<double> x;
  const SolveReport report = solver.solve(a, equations(a.rows), std::vector<double>(a.rows, 1.0), x);
  CHECK(report.relative_residual < 2e-10);
  return report.iterations;
}

}  // namespace

TEST_CASE("a factorisation is taken while it is cheap and fits into memory") {
  Automatic cheap;
  CHECK(cheap.solver->choice().empty());
  cheap.direct.operations_per_entry = 1e4;
  cheap.solve();
  CHECK(cheap.direct.solved == 1);
  CHECK_THAT(cheap.solver->choice(),
             Catch::StartsWith("factors: ") && Catch::Contains("1e+04 operations an entry"));
  CHECK(cheap.solver->effort(chain(10, 2, 0))->operations == Approx(28e4));

  Automatic dear;
  dear.direct.operations_per_entry = 4e4;
  dear.solve();
  CHECK(dear.iterative.solved == 1);
  CHECK(dear.direct.solved == 0);
  CHECK_THAT(dear.solver->choice(), Catch::StartsWith("rounds: "));

  Automatic large;
  large.direct.bytes = 0.7 * machine_memory();
  large.solve();
  CHECK(large.iterative.solved == 1);
  large.direct.bytes = 0.5 * machine_memory();
  large.solve(14);  // not half as many again
  CHECK(large.iterative.solved == 2);
  large.solve(20);
  CHECK(large.direct.solved == 1);
}

TEST_CASE("where iterations do not do, a factorisation is taken that fits into memory, and stays") {
  Automatic hard;
  hard.direct.operations_per_entry = 4e4;
  hard.iterative.works = false;
  hard.solve();
  hard.solve();
  CHECK(hard.iterative.solved == 1);
  CHECK(hard.direct.solved == 2);
  CHECK_THAT(hard.solver->choice(),
             Catch::StartsWith("factors: rounds did not do: it goes round in circles"));
  // As if it were the first.
  hard.solver->forget();
  hard.solve();
  CHECK(hard.iterative.solved == 2);

  Automatic large;
  large.direct.bytes = 10 * machine_memory();
  large.iterative.works = false;
  CHECK_THROWS_WITH(large.solve(), Catch::Contains("it goes round in circles"));
  CHECK(large.direct.solved == 0);

  // What a factorisation cannot solve is not tried by iterations.
  Automatic singular;
  singular.direct.works = false;
  CHECK_THROWS_AS(singular.solve(), SingularMatrix);
  CHECK(singular.iterative.solved == 0);
}

TEST_CASE("incomplete factorisations get more fill when a whole Krylov space has found next to nothing") {
  const Matrix a = chain(60, 1, 0);
  KrylovSolver weak = krylov(0, 10);
  CHECK(iterations(weak, a) <= 12);
  CHECK(Remembers::built == std::vector<long>{0, 1});
  // What was hard stays so, until the next solve is to be as if it were the first.
  weak.forget();
  iterations(weak, a);
  CHECK(Remembers::built == std::vector<long>{0, 1, 0, 1});

  // Without: where each space gains something.
  KrylovSolver slow = krylov(0, 10);
  CHECK(iterations(slow, chain(60, 2, 0)) > 20);
  CHECK(Remembers::built == std::vector<long>{0});
}

TEST_CASE("a preconditioner that has become too old is given up after half as many iterations again") {
  const Matrix first = chain(60, 1.2, 0.1), other = chain(60, 3, 0);
  KrylovSolver solver = krylov(1, 100);
  const int fresh = iterations(solver, first);
  CHECK(fresh > 5);
  CHECK(iterations(solver, first) == fresh);
  CHECK(Remembers::built.size() == 1);
  const int more = iterations(solver, other);
  CHECK(Remembers::built.size() == 2);
  CHECK(more <= static_cast<int>(1.5 * fresh) + 10 + 2);
}
