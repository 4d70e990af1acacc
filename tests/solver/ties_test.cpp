// SPDX-License-Identifier: BSD-3-Clause
// Unknowns that are tied to others: values, balance, tangent, chains, and what cannot be.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "seam/assembly/assembler.hpp"
#include "seam/conformance/tangent.hpp"
#include "seam/constraint/constraint.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"
#include "seam/plugin/registry.hpp"
#include "solver/diffusion.hpp"

using namespace seam;

namespace {

/// The unknown at a node, wherever it lies.
UnknownPlace at(const Ties& ties, const Field& field, std::array<double, 2> x) {
  const Space& space = *field.blocks()[0].space;
  std::vector<UnknownPlace> found;
  for (int node = 0; node < space.owned_nodes(); ++node)
    if (std::hypot(space.position(node)[0] - x[0], space.position(node)[1] - x[1]) < 1e-9)
      found.push_back(ties.place(field, 0, node, 0));
  found = field.mesh().communicator().gather_all(found);
  REQUIRE(found.size() == 1);
  return found.front();
}

/// The value of the unknown at a node, on all ranks.
double value(const Field& field, std::array<double, 2> x) {
  const Space& space = *field.blocks()[0].space;
  double sum = 0;
  for (int node = 0; node < space.owned_nodes(); ++node)
    if (std::hypot(space.position(node)[0] - x[0], space.position(node)[1] - x[1]) < 1e-9)
      sum += field.blocks()[0].now.value[node];
  return field.mesh().communicator().sum(sum);
}

/// Ties as a test says.
class Said final : public Constraint {
 public:
  using What = std::function<void(Ties&, const Field&)>;
  explicit Said(const Field& field, What what) : field_(field), what_(std::move(what)) {}
  void build(ConstraintSetup&) override {}
  void tie(Ties& ties, const TimePoint&) const override { what_(ties, field_); }

 private:
  const Field& field_;
  What what_;
};

/// Nodes of a box of six cells each way.
constexpr std::array<double, 2> a{1.0 / 6, 0.5}, b{5.0 / 6, 1.0 / 3}, c{0.5, 5.0 / 6}, d{2.0 / 3, 2.0 / 3};

std::unique_ptr<Problem> problem_with(const Said::What& what) {
  auto problem = test::diffusion_problem(CellType::quadrilateral, 6, {});
  const Field& field = *problem->fields()[0].field;
  if (what) problem->add_constraint(std::make_unique<Said>(field, what), {"scene.yaml", 7, 3});
  problem->finish();
  problem->initialise(0);
  return problem;
}

/// What holds the values at these nodes where they are those of the solution: the flux that each takes up.
std::vector<double> fluxes(const Field& solution, const std::vector<std::array<double, 2>>& nodes) {
  auto problem = problem_with({});
  Block& block = problem->fields()[0].field->blocks()[0];
  block.now.value = solution.blocks()[0].now.value;
  block.now.value.resize(block.space->nodes());
  problem->assembler().assemble(time_point(1, 0, 1), false);
  std::vector<double> result;
  for (const auto& x : nodes) {
    double flux = 0;
    for (int node = 0; node < block.space->owned_nodes(); ++node)
      if (std::hypot(block.space->position(node)[0] - x[0], block.space->position(node)[1] - x[1]) < 1e-9)
        flux += problem->assembler()
                    .full_residual()[problem->assembler().row(*problem->fields()[0].field, 0, node, 0)];
    result.push_back(problem->communicator().sum(flux));
  }
  return result;
}

}  // namespace

TEST_CASE("tied unknowns have the value of the relation, and hand their balance on", "[ranks]") {
  const double handed = GENERATE(0.5, -1.5);  // the first is the coefficient
  const auto problem = problem_with([&](Ties& ties, const Field& field) {
    ties.tie(at(ties, field, a), {{at(ties, field, b), 0.5, handed}, {at(ties, field, d), -0.25, 0}}, 0.1);
    ties.tie(at(ties, field, b), {{at(ties, field, c), 2, 3}}, -0.3);  // a chain
  });
  REQUIRE(test::solve_static(*problem).converged);
  const Field& field = *problem->fields()[0].field;
  CHECK(value(field, b) == Approx(2 * value(field, c) - 0.3).epsilon(1e-12));
  CHECK(value(field, a) == Approx(0.5 * value(field, b) - 0.25 * value(field, d) + 0.1).epsilon(1e-12));
  const std::vector<double> flux = fluxes(field, {a, b, c, d});
  CHECK(std::abs(flux[0]) > 1e-3);
  CHECK(std::abs(flux[1]) > 1e-3);
  CHECK(flux[2] + 3 * (flux[1] + handed * flux[0]) == Approx(0).margin(1e-11));
  CHECK(flux[3] == Approx(0).margin(1e-11));
}

TEST_CASE("coefficients that depend on the state are differentiated", "[ranks]") {
  // c_a = c_b + c_b^2/2: the derivative, and what is handed on, is 1 + c_b.
  const auto squared = [](bool exact) {
    return [exact](Ties& ties, const Field& field) {
      const double v = value(field, b);
      const UnknownPlace to = at(ties, field, b);
      ties.tie(at(ties, field, a), {{to, 1 + v, 1 + v}}, -v * v / 2);
      // That of the unknown's owner counts, as the tie does.
      if (exact) ties.add_change(to, to, 1);
      ties.tie(at(ties, field, d), {{at(ties, field, a), 0.5, 2}}, 0);  // and what is tied to it
    };
  };
  const auto problem = problem_with(squared(true)), without = problem_with(squared(false));
  if (problem->communicator().size() == 1) {
    const auto shaken = problem_with(squared(true));
    Block& block = shaken->fields()[0].field->blocks()[0];
    for (std::size_t k = 0; k < block.now.value.size(); ++k)
      block.now.value[k] = 0.3 + 0.1 * std::sin(7.0 * k);
    std::ranges::fill(block.prescribed, 0);
    shaken->assembler().rebuild();
    const TimePoint time = time_point(1, 0, 1);
    const std::vector<double> nothing(shaken->assembler().matrix().rows, 0.0);
    for (int k = 0; k < 4; ++k) {
      shaken->update_spaces(time);
      shaken->assembler().add_increment(nothing, 1);
    }
    shaken->update_spaces(time);
    CHECK(tangent_error(*shaken, shaken->assembler(), time, true).relative < 1e-6);
  }
  const NewtonReport report = test::solve_static(*problem), slow = test::solve_static(*without);
  INFO(report.reason << "; " << slow.reason);
  REQUIRE(report.converged);
  REQUIRE(slow.converged);
  CHECK(report.history.size() < slow.history.size());
  const Field& field = *problem->fields()[0].field;
  CHECK(value(field, a) == Approx(value(field, b) + std::pow(value(field, b), 2) / 2).epsilon(1e-11));
  CHECK(value(*without->fields()[0].field, a) == Approx(value(field, a)).epsilon(1e-9));
  CHECK(value(field, d) == Approx(0.5 * value(field, a)).epsilon(1e-11));
  const std::vector<double> flux = fluxes(field, {a, b, d});
  CHECK(std::abs(flux[0]) > 1e-3);
  CHECK(std::abs(flux[2]) > 1e-3);
  CHECK(flux[1] + (1 + value(field, b)) * (flux[0] + 2 * flux[2]) == Approx(0).margin(1e-10));
}

TEST_CASE("what coefficients change with may be another field's, and lie on any rank", "[ranks]") {
  // c_a = (1 + w) c_b with w of a second field, to which nothing is tied.
  auto problem = test::diffusion_problem(CellType::quadrilateral, 6, {});
  problem->add_field("second",
                     std::make_shared<Mesh>("box", test::box(CellType::quadrilateral, 5), Communicator()),
                     std::make_unique<test::DiffusionPhysics>(test::Options{}));
  const Field &field = *problem->fields()[0].field, &second = *problem->fields()[1].field;
  const std::array<double, 2> w{0.8, 0.8};
  problem->add_constraint(
      std::make_unique<Said>(field,
                             [&](Ties& ties, const Field& of) {
                               const double v = value(second, w);
                               const UnknownPlace with = at(ties, second, w);
                               ties.tie(at(ties, of, a), {{at(ties, of, b), 1 + v, 1 + v}}, 0);
                               ties.add_change(at(ties, of, b), with, 1);
                             }),
      {"scene.yaml", 7, 3});
  problem->finish();
  problem->initialise(0);
  const NewtonReport report = test::solve_static(*problem);
  INFO(report.reason);
  REQUIRE(report.converged);
  CHECK(std::abs(value(second, w)) > 0.01);
  CHECK(value(field, a) == Approx((1 + value(second, w)) * value(field, b)).epsilon(1e-11));
  if (problem->communicator().size() > 1) {
    // The node has become known where the tie is.
    const Ties ties({problem->fields()[0].field.get(), problem->fields()[1].field.get()});
    const UnknownPlace tied = at(ties, field, a), with = at(ties, second, w);
    if (problem->communicator().rank() == tied.owner)
      CHECK(second.blocks()[0].space->local_node(with.node) >= 0);
  }
}

TEST_CASE("second rates of what is tied are those of the others, and what turning adds", "[ranks]") {
  // c_a = c_b + c_b^2/2, hence c_a'' = (1 + c_b) c_b'' + c_b'^2.
  const auto problem = problem_with([](Ties& ties, const Field& field) {
    const double v = value(field, b);
    const UnknownPlace to = at(ties, field, b);
    ties.tie(at(ties, field, a), {{to, 1 + v, 1 + v}}, -v * v / 2);
    ties.add_change(to, to, 1);
  });
  const Field& field = *problem->fields()[0].field;
  Block& block = problem->fields()[0].field->blocks()[0];
  block.time_order[0] = 2;
  std::ranges::fill(block.now.value, 0.5);
  block.now.rate.assign(block.now.value.size(), 3.0);
  block.now.second_rate.assign(block.now.value.size(), -4.0);
  problem->update_spaces(time_point(1, 0, 1));
  problem->assembler().settle_rates();
  problem->assembler().settle_second_rates();
  const auto number = [&](const std::vector<double>& of) {
    double sum = 0;
    for (int node = 0; node < block.space->owned_nodes(); ++node)
      if (std::hypot(block.space->position(node)[0] - a[0], block.space->position(node)[1] - a[1]) < 1e-9)
        sum += of[node];
    return field.mesh().communicator().sum(sum);
  };
  CHECK(number(block.now.rate) == Approx(1.5 * 3).epsilon(1e-14));
  CHECK(number(block.now.second_rate) == Approx(1.5 * -4 + 3 * 3).epsilon(1e-14));
}

TEST_CASE("a constraint that fails on one rank fails on all", "[ranks]") {
  bool fails = false;
  const auto problem = problem_with([&](Ties&, const Field& field) {
    const Communicator& communicator = field.mesh().communicator();
    if (fails && communicator.rank() == communicator.size() - 1)
      throw std::runtime_error("the knot came undone");
  });
  fails = true;
  // Without the others it would leave them waiting for its ties.
  CHECK_THROWS_WITH(problem->ties(time_point(1, 0, 1)), Catch::Contains("the knot came undone"));
}

TEST_CASE("what is tied may change in every iteration", "[ranks]") {
  // Once the solution is there, a is tied to another node, at another rank.
  const auto problem = problem_with([](Ties& ties, const Field& field) {
    const bool late = value(field, d) > 0.01;
    ties.tie(at(ties, field, a), {{at(ties, field, late ? c : b), 1, 1}}, late ? 0.05 : 0);
    if (late) ties.tie(at(ties, field, b), {{at(ties, field, d), 1, 1}}, 0);
  });
  const NewtonReport report = test::solve_static(*problem);
  REQUIRE(report.converged);
  CHECK(std::ranges::any_of(report.history, &NewtonIteration::space_changed));
  const Field& field = *problem->fields()[0].field;
  CHECK(value(field, a) == Approx(value(field, c) + 0.05).epsilon(1e-12));
  CHECK(value(field, b) == Approx(value(field, d)).epsilon(1e-12));
  const std::vector<double> flux = fluxes(field, {a, b, c, d});
  CHECK(flux[0] + flux[2] == Approx(0).margin(1e-11));
  CHECK(flux[1] + flux[3] == Approx(0).margin(1e-11));
}

TEST_CASE("a state that is rewound may have been tied to fewer nodes", "[ranks]") {
  bool late = false;
  const auto problem = problem_with([&](Ties& ties, const Field& field) {
    if (late) ties.tie(at(ties, field, a), {{at(ties, field, c), 1, 1}}, 0);
  });
  const TimePoint time = time_point(1, 0, 1);
  const StateStore::Snapshot before = problem->state().snapshot(0);
  late = true;
  REQUIRE(test::solve_static(*problem).converged);
  problem->state().restore(before);
  REQUIRE(test::solve_static(*problem).converged);
  const Field& field = *problem->fields()[0].field;
  CHECK(value(field, a) == Approx(value(field, c)).epsilon(1e-12));
  problem->update_spaces(time);
  problem->state().restore(before);
  const Block& block = field.blocks()[0];
  CHECK(block.now.value.size() == static_cast<std::size_t>(block.space->nodes()));
}

TEST_CASE("what is tied to a prescribed unknown, of whatever rank, goes its way with it", "[ranks]") {
  const double y = GENERATE(0.0, 0.5, 1.0);
  const auto solved = [&](const Communicator& communicator) {
    Problem problem(communicator);
    const Field& field = problem.add_field(
        "body", std::make_shared<Mesh>("box", test::box(CellType::quadrilateral, 6), communicator),
        std::make_unique<test::DiffusionPhysics>(test::Options{1, 0, 0, true, 1, "2"}));
    const auto tied = [y](Ties& ties, const Field& of) {
      for (const auto& x : {a, b}) ties.tie(at(ties, of, x), {{at(ties, of, {0, y}), 0.5, 0.5}}, 0);
    };
    problem.add_constraint(std::make_unique<Said>(field, tied), {});
    problem.finish();
    problem.initialise(0, false);
    const NewtonReport report = test::solve_static(problem);
    REQUIRE(report.converged);
    CHECK(value(field, a) == Approx(1).epsilon(1e-12));
    CHECK(value(field, b) == Approx(1).epsilon(1e-12));
    return report.history;
  };
  // Iteration by iteration as on one rank.
  const auto alone = solved(Communicator(MPI_COMM_SELF)), together = solved(Communicator());
  REQUIRE(alone.size() == together.size());
  for (std::size_t k = 0; k < alone.size(); ++k)
    CHECK(together[k].residual == Approx(alone[k].residual).epsilon(1e-6).margin(1e-12));
}

TEST_CASE("a step does not end before relations are met") {
  const auto problem = problem_with([](Ties& ties, const Field& field) {
    const double v = value(field, b);
    const UnknownPlace to = at(ties, field, b);
    ties.tie(at(ties, field, a), {{to, 1 + v, 1 + v}}, -v * v / 2);
    ties.add_change(to, to, 1);
  });
  MumpsSolver solver;
  Newton newton(*problem, solver, {0.1, 0.1, 25, true});  // of little ambition
  const TimePoint time = time_point(1, 0, 1);
  problem->begin_step(time);
  REQUIRE(newton.solve(time).converged);
  const Field& field = *problem->fields()[0].field;
  CHECK(value(field, a) == Approx(value(field, b) + std::pow(value(field, b), 2) / 2).epsilon(1e-9));
}

TEST_CASE("nodes are tied to the face they lie on, not to one that ends nearby", "[ranks]") {
  Registry registry;
  register_constraints(registry);
  Problem problem{Communicator()};
  for (const auto& [name, cells] : {std::pair("fine", 20), std::pair("coarse", 3)})
    problem.add_field(name,
                      std::make_shared<Mesh>(name, test::box(CellType::quadrilateral, cells), Communicator()),
                      std::make_unique<test::DiffusionPhysics>(test::Options{}));
  using Names = std::vector<std::string>;
  Parameters p;
  p.set_type("tied");
  p.set("fields", {Names{"fine", "coarse"}, {}, {}, true});
  p.set("boundaries", {Names{"x_max", "x_max"}, {}, {}, true});
  p.set("unknowns", {Names{}, {}, {}, true});
  problem.add_constraint(registry.create<Constraint>("constraint", p));
  problem.finish();
  problem.initialise(0);
  for (const Ties::Resolved& tie : problem.ties(time_point(1, 0, 1))) {
    double sum = 0, place = 0;
    CHECK(tie.to.size() <= 2);
    for (const TiedTo& to : tie.to) {
      CHECK(to.coefficient > 0);
      sum += to.coefficient;
      place += to.coefficient * to.unknown.position[1];
    }
    CHECK(sum == Approx(1));
    CHECK(place == Approx(tie.unknown.position[1]).epsilon(0).margin(1e-12));
  }
}

TEST_CASE("an unknown tied twice, in a circle, or prescribed is refused with its places", "[ranks]") {
  using Catch::Contains;
  CHECK_THROWS_WITH(problem_with([](Ties& ties, const Field& field) {
                      ties.tie(at(ties, field, a), {{at(ties, field, b), 1, 1}}, 0);
                      ties.set_origin({"scene.yaml", 9, 3});
                      ties.tie(at(ties, field, a), {{at(ties, field, c), 1, 1}}, 0);
                    }),
                    Contains("scene.yaml:7:3") && Contains("scene.yaml:9:3") && Contains("is tied twice") &&
                        Contains("'body' at (0.166667, 0.5) is tied"));
  CHECK_THROWS_WITH(problem_with([](Ties& ties, const Field& field) {
                      ties.tie(at(ties, field, a), {{at(ties, field, b), 1, 1}}, 0);
                      ties.tie(at(ties, field, b), {{at(ties, field, c), 1, 1}}, 0);
                      ties.set_origin({"scene.yaml", 9, 3});
                      ties.tie(at(ties, field, c), {{at(ties, field, a), 1, 1}}, 0);
                    }),
                    Contains("scene.yaml:7:3") && Contains("scene.yaml:9:3") && Contains("circle"));
  CHECK_THROWS_WITH(problem_with([](Ties& ties, const Field& field) {
                      ties.tie(at(ties, field, {0, 0.5}), {{at(ties, field, b), 1, 1}}, 0);
                    }),
                    Contains("scene.yaml:7:3") && Contains("is tied here and prescribed"));
}
