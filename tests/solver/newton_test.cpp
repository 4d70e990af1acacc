// SPDX-License-Identifier: BSD-3-Clause
// When Newton's method has converged, and when it goes only a part of its way.
#include <algorithm>
#include <catch2/catch.hpp>

#include "diffusion.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"

namespace {

using namespace seam;
using test::c;

/// (dc, factor c^power), with rates of any order in the place of c.
template <class Slot>
struct Power {
  using Reads = Slots<Slot>;
  using Tests = Slots<Value<c>>;
  double factor;
  int power;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    T value;
    if constexpr (std::is_same_v<Slot, SecondRate<c>>)
      value = s.second_rate(c{});
    else
      value = s.value(c{});
    T product(factor);
    for (int k = 0; k < power; ++k) product = product * value;
    r.value(c{}) += product;
  }
};

/// (dc, ln c + 1 + x)
struct Logarithm {
  using Reads = Slots<Value<c>>;
  using Tests = Slots<Value<c>>;
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    using std::log;
    r.value(c{}) += log(s.value(c{})) + 1.0 + x.position[0];
  }
};

class OnlyPositive final : public Physics {
 public:
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override { return {{"c", 1, 1, 0, ""}}; }
  void build(FieldSetup& setup) const override {
    setup.add_cell_term(make_term(Logarithm{}), {"c"});
    setup.set_initial("c", 0, Expression(3.0));
  }
};

/// Terms that are the same everywhere, so that the solution is, too.
class Polynomial final : public Physics {
 public:
  Polynomial(std::vector<std::pair<double, int>> terms, double start, double mass = 0)
      : terms_(std::move(terms)), start_(start), mass_(mass) {}
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override {
    return {{"c", 1, 1, mass_ > 0 ? 2 : 0, ""}};
  }
  void build(FieldSetup& setup) const override {
    for (const auto& [factor, power] : terms_)
      setup.add_cell_term(make_term(Power<Value<c>>{factor, power}), {"c"});
    if (mass_ > 0) setup.add_cell_term(make_term(Power<SecondRate<c>>{mass_, 1}), {"c"});
    setup.set_initial("c", 0, Expression(start_));
  }

 private:
  std::vector<std::pair<double, int>> terms_;
  double start_, mass_;
};

std::unique_ptr<Problem> problem_of(std::vector<std::pair<double, int>> terms, double start,
                                    double mass = 0) {
  auto problem = std::make_unique<Problem>(Communicator());
  problem->add_field("body",
                     std::make_shared<Mesh>("box", test::box(CellType::quadrilateral, 2), Communicator()),
                     std::make_unique<Polynomial>(std::move(terms), start, mass));
  problem->finish();
  problem->initialise(0);
  return problem;
}

NewtonReport solve(Problem& problem, const NewtonOptions& options) {
  MumpsSolver solver;
  Newton newton(problem, solver, options);
  const TimePoint at = time_point(1, 0, 1);
  problem.begin_step(at);
  return newton.solve(at);
}

}  // namespace

TEST_CASE("a small residual is no solution as long as increments are not small") {
  // A double root: residuals are squares of what is missing.
  auto problem = problem_of({{1, 2}, {-2, 1}, {1, 0}}, 3);
  const NewtonReport report = solve(*problem, {1e-3, 1e-5, 60, true});
  REQUIRE(report.converged);
  for (const double value : problem->fields()[0].field->blocks()[0].now.value)
    CHECK(std::abs(value - 1) < 1e-4);
}

TEST_CASE("an increment that makes a small residual large is taken in part") {
  // Next to a minimum that no root is at, the tangent points far away.
  auto problem = problem_of({{1, 3}, {-3, 1}, {2 + 1e-6, 0}}, 1 + 1e-6);
  NewtonReport report = solve(*problem, {1e-12, 1e-5, 1, true});
  REQUIRE(report.history.size() == 2);
  REQUIRE(report.history[0].residual < 1e-6);
  CHECK(report.history[1].damping < 1);
  problem = problem_of({{1, 3}, {-3, 1}, {2 + 1e-6, 0}}, 1 + 1e-6);
  report = solve(*problem, {1e-12, 1e-5, 1, false});
  CHECK(report.history[1].damping == 1);
}

TEST_CASE("what has inertia begins with the acceleration that its balance says") {
  // 2 d2c/dt2 + 3 c = 5, from rest at 1/3.
  auto problem = problem_of({{3, 1}, {-5, 0}}, 1.0 / 3, 2);
  MumpsSolver solver;
  Newton newton(*problem, solver, {1e-12, 1e-8, 10, true});
  newton.solve_initial_rates(0);
  const Block& block = problem->fields()[0].field->blocks()[0];
  for (std::size_t i = 0; i < block.now.value.size(); ++i) {
    CHECK(block.now.value[i] == Approx(1.0 / 3).epsilon(1e-14));
    CHECK(block.now.rate[i] == Approx(0).margin(1e-14));
    CHECK(block.now.second_rate[i] == Approx(2).epsilon(1e-12));
    CHECK(block.old.second_rate[i] == block.now.second_rate[i]);
  }
}

TEST_CASE("spaces go back with a state that was no admissible one") {
  std::vector<std::vector<double>> residuals;
  for (const bool follows : {false, true}) {
    Problem problem{Communicator()};
    problem.add_field("body",
                      std::make_shared<Mesh>("box", test::box(CellType::quadrilateral, 4), Communicator()),
                      std::make_unique<OnlyPositive>());
    FieldEntry& entry = problem.fields()[0];
    bool was_negative = false;
    problem.add_space_update([&](const TimePoint&) {
      // Where the logarithm is none, half of the cells go.
      const std::vector<double>& values = entry.field->blocks()[0].now.value;
      const bool is_negative = follows && *std::min_element(values.begin(), values.end()) <= 0;
      if (is_negative == was_negative) return false;
      was_negative = is_negative;
      std::vector<char> active(entry.mesh->cells(), 1);
      if (is_negative) std::fill(active.begin(), active.begin() + entry.mesh->cells() / 2, 0);
      problem.occupy(entry, active);
      return true;
    });
    problem.finish();
    problem.initialise(0);
    const NewtonReport report = solve(problem, {1e-11, 1e-7, 30, true});
    REQUIRE(report.converged);
    CHECK(report.history[1].damping < 1);
    residuals.emplace_back();
    for (const NewtonIteration& iteration : report.history) residuals.back().push_back(iteration.residual);
  }
  REQUIRE(residuals[0].size() == residuals[1].size());
  for (std::size_t k = 0; k < residuals[0].size(); ++k)
    CHECK(residuals[1][k] == Approx(residuals[0][k]).epsilon(1e-9).margin(1e-13));
}
