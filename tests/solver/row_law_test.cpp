// SPDX-License-Identifier: BSD-3-Clause
// Equations that are functions of assembled rows and of their unknown.
#include "seam/field/row_law.hpp"

#include <catch2/catch.hpp>

#include "diffusion.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"

namespace {

using namespace seam;
using test::c;

/// (grad dc, grad c) + (dc, load)
struct Membrane {
  using Reads = Slots<Gradient<c>>;
  using Tests = Slots<Value<c>, Gradient<c>>;
  double load;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.gradient(c{}) += s.gradient(c{});
    r.value(c{}) += T(load);
  }
};

/// A membrane that does not go below a height: there the assembled row is the force that lifts it.
struct AboveGround {
  static constexpr int components = 1;
  double ground, factor;
  template <class T>
  Vec<1, T> operator()(const Vec<1, T>& height, const Vec<1, T>& row, double) const {
    const T missing = T(ground) - height[0];
    return {{plain(row[0]) + factor * plain(missing) > 0 ? -1.0 * missing : row[0]}};
  }
};

class MembranePhysics final : public Physics {
 public:
  explicit MembranePhysics(double factor) : factor_(factor) {}
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override {
    Unknown height{"c", 1, 1, 0, ""};
    if (factor_ > 0) height.law = make_row_law(AboveGround{-0.25, factor_});
    return {height};
  }
  void build(FieldSetup& setup) const override {
    setup.add_cell_term(make_term(Membrane{8}), {"c"});
    for (const char* end : {"x_min", "x_max"}) setup.prescribe(end, "c", 0, Expression("0", {}), {});
  }

 private:
  double factor_;
};

using pair = Vector<0>;

/// (grad dv, grad v) - (dv, x e_0 + e_1)
struct TwoMembranes {
  using Reads = Slots<Gradient<pair>>;
  using Tests = Slots<Value<pair>, Gradient<pair>>;
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.gradient(pair{}) += s.gradient(pair{});
    Vec<dim, T> load;
    load[0] = x.position[0];
    load[1] = 1.0;
    r.value(pair{}) -= load;
  }
};

/// Says the same as both rows, and something that is zero where they are.
struct Mixed {
  static constexpr int components = 2;
  double bend;  ///< 0: a linear mix
  template <class T>
  Vec<2, T> operator()(const Vec<2, T>& value, const Vec<2, T>& row, double) const {
    return {{row[0] + 3.0 * row[1], 2.0 * row[0] - row[1] + bend * row[0] * value[1]}};
  }
};

class TwoMembranesPhysics final : public Physics {
 public:
  explicit TwoMembranesPhysics(std::shared_ptr<const RowLaw> law) : law_(std::move(law)) {}
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override {
    Unknown both{"v", 2, 1, 0, ""};
    both.law = law_;
    return {both};
  }
  void build(FieldSetup& setup) const override {
    setup.add_cell_term(make_term(TwoMembranes{}), {"v"});
    setup.prescribe("x_min", "v", 0, Expression("0.5", {}), {});
    setup.prescribe("x_min", "v", 1, Expression("0", {}), {});
    setup.prescribe("x_max", "v", 0, Expression("0", {}), {});
    setup.prescribe("x_max", "v", 1, Expression("0", {}), {});
  }

 private:
  std::shared_ptr<const RowLaw> law_;
};

std::unique_ptr<Problem> problem_of(std::unique_ptr<Physics> physics, int n) {
  auto problem = std::make_unique<Problem>(Communicator());
  problem->add_field("body",
                     std::make_shared<Mesh>("box", test::box(CellType::quadrilateral, n), Communicator()),
                     std::move(physics));
  problem->finish(0, true);
  problem->initialise(0, false);
  return problem;
}

}  // namespace

TEST_CASE("a membrane over an obstacle finds where it lies on it", "[ranks]") {
  // c'' = 8 beside the ground at -1/4, which it leaves at 1/4 and 3/4. Nodes lie there: linear elements are
  // exact at them.
  const double factor = GENERATE(1e-4, 1.0, 1e4);
  INFO("factor " << factor);
  const auto problem = problem_of(std::make_unique<MembranePhysics>(factor), 8);
  const NewtonReport report = test::solve_static(*problem);
  REQUIRE(report.converged);
  CHECK(report.iterations() <= 6);
  const Block& block = problem->field("body").field->blocks()[0];
  for (int node = 0; node < block.space->owned_nodes(); ++node) {
    const double x = std::min(block.space->position(node)[0], 1 - block.space->position(node)[0]);
    const double exact = x < 0.25 ? 4 * (x - 0.25) * (x - 0.25) - 0.25 : -0.25;
    CHECK(block.now.value[node] == Approx(exact).margin(1e-12));
  }
}

TEST_CASE("without its law the membrane hangs through", "[ranks]") {
  const auto problem = problem_of(std::make_unique<MembranePhysics>(0), 8);
  REQUIRE(test::solve_static(*problem).converged);
  const Block& block = problem->field("body").field->blocks()[0];
  for (int node = 0; node < block.space->owned_nodes(); ++node) {
    const double x = block.space->position(node)[0];
    CHECK(block.now.value[node] == Approx(4 * x * (x - 1)).margin(1e-12));
  }
}

TEST_CASE("rows of a node that are mixed with each other say the same", "[ranks]") {
  const double bend = GENERATE(0.0, 1.0);
  const auto plain = problem_of(std::make_unique<TwoMembranesPhysics>(nullptr), 6);
  const auto mixed = problem_of(std::make_unique<TwoMembranesPhysics>(make_row_law(Mixed{bend})), 6);
  const NewtonReport before = test::solve_static(*plain), after = test::solve_static(*mixed);
  REQUIRE(before.converged);
  REQUIRE(after.converged);
  // Rows that are mixed linearly take as many iterations, with the way that given values have to go, too.
  // Where one factor changes with the unknown, the other one is zero in the end: convergence is quadratic.
  CHECK(after.iterations() <= (bend == 0 ? before.iterations() : 6));
  const Block &one = plain->field("body").field->blocks()[0],
              &other = mixed->field("body").field->blocks()[0];
  for (std::size_t i = 0; i < one.now.value.size(); ++i)
    CHECK(other.now.value[i] == Approx(one.now.value[i]).margin(1e-10));
}
