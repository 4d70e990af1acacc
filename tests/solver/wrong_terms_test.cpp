// SPDX-License-Identifier: BSD-3-Clause
// Terms that give what is no number, or refuse a step on one rank only.
#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "seam/assembly/evaluator.hpp"
#include "seam/assembly/together.hpp"
#include "seam/base/plugin_fault.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"
#include "solver/diffusion.hpp"

using namespace seam;
using test::c;

namespace {

/// Right at rest, but for its derivative: 0.5/0 times 0.
struct RootOfGradient {
  using Reads = Slots<Gradient<c>>;
  using Tests = Slots<Value<c>, Gradient<c>>;
  double source = 1;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const auto slope = s.gradient(c{});
    r.gradient(c{}) += (1.0 + sqrt(dot(slope, slope))) * slope;
    r.value(c{}) -= source;
  }
};

/// Its source is no number in a part of the box.
struct NoNumber {
  using Reads = Slots<Value<c>>;
  using Tests = Slots<Value<c>>;
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(c{}) += s.value(c{}) - (x.position[0] < 0.2 ? std::nan("") : 1.0);
  }
};

/// Fails at points on the right of a line through a cell.
struct Throwing {
  using Reads = Slots<Value<c>>;
  using Tests = Slots<Value<c>>;
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    if (x.position[0] > 0.9) throw std::runtime_error("no such row");
    r.value(c{}) += s.value(c{}) - 1.0;
  }
};

/// Refuses the step where only one rank has cells.
struct Refusing {
  using Reads = Slots<Value<c>>;
  using Tests = Slots<Value<c>>;
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    if (x.position[0] < 0.2 && x.position[1] < 0.2) throw StepRefused("too far in the corner");
    r.value(c{}) += s.value(c{}) - 1.0;
  }
};

/// Reads a rate of an unknown that has none, with a factor that may be 0.
template <int factor>
struct WithRate {
  using Reads = Slots<Value<c>, Rate<c>>;
  using Tests = Slots<Value<c>>;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(c{}) += s.value(c{}) - 1.0;
    if (factor > 0) r.value(c{}) += factor * s.rate(c{});
  }
};

/// Names a rate without use, and is no number where it is tried whether it depends on it.
struct NotAtHome {
  using Reads = Slots<Value<c>, Rate<c>>;
  using Tests = Slots<Value<c>>;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(c{}) += sqrt(s.value(c{}) - 10.0);
  }
};

template <class Kernel>
class OneTerm final : public Physics {
 public:
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override { return {{"c", 1, 1, 0, ""}}; }
  void build(FieldSetup& setup) const override {
    setup.add_cell_term(make_term(Kernel{}), {"c"});
    setup.prescribe("x_max", "c", 0, Expression(0.0), {});
  }
};

/// Cells whose points follow more facets than the core makes room for.
class ManyMovers final : public IntegrationDomain {
 public:
  ManyMovers(Field& field, int movers) : field_(field), movers_(static_cast<std::size_t>(movers), {0, "c"}) {}
  [[nodiscard]] int size() const override { return 0; }
  [[nodiscard]] std::vector<Field*> fields() const override { return {&field_}; }
  void fill(int, Element&) const override {}
  [[nodiscard]] const int* nodes(int, int, int) const override { return nullptr; }
  [[nodiscard]] std::string description() const override { return "a strange domain"; }
  [[nodiscard]] const std::vector<Operand>& movers() const override { return movers_; }

 private:
  Field& field_;
  std::vector<Operand> movers_;
};

template <class Kernel>
std::unique_ptr<Problem> problem_of() {
  auto problem = std::make_unique<Problem>(Communicator());
  problem->add_field("body",
                     std::make_shared<Mesh>("box", test::box(CellType::quadrilateral, 6), Communicator()),
                     std::make_unique<OneTerm<Kernel>>());
  problem->finish();
  problem->initialise(0);
  return problem;
}

}  // namespace

TEST_CASE("A tangent that is no number is refused, and says which term gives it", "[ranks]") {
  const auto problem = problem_of<RootOfGradient>();
  const NewtonReport report = test::solve_static(*problem);
  CHECK_FALSE(report.converged);
  for (const std::string part : {"RootOfGradient", "body.c", "cells of field 'body'", "derivatives", "cell "})
    CHECK_THAT(report.reason, Catch::Contains(part));
}

TEST_CASE("A residual that is no number is refused, and says where", "[ranks]") {
  const auto problem = problem_of<NoNumber>();
  const NewtonReport report = test::solve_static(*problem);
  CHECK_FALSE(report.converged);
  CHECK_THAT(report.reason, Catch::Contains("NoNumber") && Catch::Contains("gives no finite number"));
}

TEST_CASE("A step that a term refuses on one rank is refused on all", "[ranks]") {
  const auto problem = problem_of<Refusing>();
  CHECK_THROWS_AS(test::solve_static(*problem), StepRefused);
  // All ranks are still in step.
  CHECK(Communicator().sum(1LL) == Communicator().size());
}

TEST_CASE("What fails on one rank fails on all, with the message of that rank", "[ranks]") {
  const Communicator all;
  const auto fail = [&](bool refuse) {
    together(all, [&] {
      if (all.rank() != all.size() - 1) return;
      if (refuse) throw StepRefused("no");
      throw Error("broken");
    });
  };
  CHECK_THROWS_WITH(fail(true), "no");
  CHECK_THROWS_AS(fail(true), StepRefused);
  CHECK_THROWS_WITH(fail(false), "broken");
  CHECK_NOTHROW(together(all, [] {}));
}

TEST_CASE("a term that depends on a rate of an unknown without is refused; one that only names it is not") {
  CHECK_THROWS_AS(problem_of<WithRate<1>>(), PluginFault);
  CHECK_THROWS_WITH(problem_of<WithRate<1>>(),
                    Catch::Contains("it depends on a rate of 'c', which has none"));
  CHECK_NOTHROW(problem_of<WithRate<0>>());
  CHECK_NOTHROW(problem_of<NotAtHome>());
}

TEST_CASE("points that move with more facets than there is room for are refused") {
  const auto problem = problem_of<WithRate<0>>();
  Field& field = *problem->fields()[0].field;
  CHECK_NOTHROW(ElementEvaluator(ManyMovers(field, 9), {}));  // in the plane a facet moves by 4 numbers
  CHECK_THROWS_WITH(ElementEvaluator(ManyMovers(field, 10), {}),
                    Catch::Contains("the points of a strange domain move with 10 facets; 9 at most"));
}

TEST_CASE("where a kernel throws, the message names the point at which it does") {
  const auto problem = problem_of<Throwing>();
  // The last column of cells begins at 5/6: its first points are left of 0.9.
  try {
    static_cast<void>(test::solve_static(*problem));
    FAIL("it should throw");
  } catch (const PluginFault& fault) {
    const std::string text = fault.what();
    const std::size_t at = text.find(" at (");
    REQUIRE(at != std::string::npos);
    INFO(text);
    CHECK(std::stod(text.substr(at + 5)) > 0.9);
  }
}
