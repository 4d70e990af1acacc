// SPDX-License-Identifier: BSD-3-Clause
// Unknowns that live on parts of a boundary.
#include <catch2/catch.hpp>

#include "diffusion.hpp"
#include "seam/assembly/assembler.hpp"
#include "seam/assembly/element.hpp"
#include "seam/contact/contact_interface.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"

namespace {

using namespace seam;
using own = Scalar<0>;
using multiplier = Scalar<1>;
using other = Scalar<2>;

/// (grad dc, grad c)
struct Conduction {
  using Reads = Slots<Gradient<own>>;
  using Tests = Slots<Gradient<own>>;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.gradient(own{}) += s.gradient(own{});
  }
};

/// -<dc - dc', q> - <dq, c - c'>
struct Tie {
  using Reads = Slots<Value<own>, Value<multiplier>, Value<other>>;
  using Tests = Reads;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const T q = s.value(multiplier{});
    r.value(own{}) -= q;
    r.value(other{}) += q;
    r.value(multiplier{}) -= s.value(own{}) - s.value(other{});
  }
};

/// c = 2 x + 3 y + 1 on some boundaries.
class Plate final : public Physics {
 public:
  Plate(int order, std::vector<std::string> held) : order_(order), held_(std::move(held)) {}
  [[nodiscard]] std::vector<Unknown> unknowns(int) const override { return {{"c", 1, order_, 0, ""}}; }
  void build(FieldSetup& setup) const override {
    setup.add_cell_term(make_term(Conduction{}), {"c"});
    for (const std::string& boundary : held_)
      setup.prescribe(boundary, "c", 0, Expression("2*x + 3*y + 1", {}), {});
  }

 private:
  int order_;
  std::vector<std::string> held_;
};

std::shared_ptr<const Mesh> plate(CellType cell, int order, double from, double to, int n, int m,
                                  double height = 1) {
  Grid grid;
  grid.cell = cell;
  grid.order = order;
  grid.lines[0] = graded_lines(from, to, n);
  grid.lines[1] = graded_lines(0, height, m);
  return std::make_shared<Mesh>("plate", std::make_shared<MeshData>(make_grid(grid)), Communicator());
}

struct PlainSetup final : InterfaceSetup {
  FieldCut& cut(int) override { throw std::logic_error("nothing is cut here"); }
  std::string displacement(int) override { return ""; }
  std::shared_ptr<const MeshData> mesh(const std::string&) override { return nullptr; }
};

struct TwoPlates {
  std::unique_ptr<Problem> problem = std::make_unique<Problem>(Communicator());
  std::shared_ptr<IntegrationDomain> seam;
};

/// Plates left and right of x = 1 with 5 and 7 cells along it, tied by a multiplier on the left one.
/// @param height of the right one
TwoPlates tied(CellType cell, int order, const std::vector<std::string>& held_beside, double height = 1) {
  TwoPlates result;
  Unknown q{"seam.q", 1, order, 0, "", UnknownRole::constraint};
  q.boundaries = {"x_max"};
  q.multiplier_of = "c";
  std::vector<std::string> left = held_beside, right = held_beside;
  left.push_back("x_min");
  right.push_back("x_max");
  PlainSetup setup;
  setup.sides = {&result.problem->add_field("left", plate(cell, order, 0, 1, 3, 5),
                                            std::make_unique<Plate>(order, left), {}, {q}),
                 &result.problem->add_field("right", plate(cell, order, 1, 2, 4, 7, height),
                                            std::make_unique<Plate>(order, right))};
  setup.degree = 2 * order;
  Parameters p;
  p.set("fields", {std::vector<std::string>{"left", "right"}, {}, {}, true});
  p.set("boundaries", {std::vector<std::string>{"x_max", "x_min"}, {}, {}, true});
  result.seam = NonMatchingInterface(p).build(setup).front().domain;
  result.problem->name_interface("seam", {{"", result.seam}}, {});
  result.problem->add_coupling(result.seam, {{make_term(Tie{}), {{0, "c"}, {0, "seam.q"}, {1, "c"}}}});
  result.problem->finish(0, true);
  result.problem->initialise(0, false);
  return result;
}

}  // namespace

TEST_CASE("a multiplier on a boundary ties meshes that do not match", "[ranks]") {
  const CellType cell = GENERATE(CellType::quadrilateral, CellType::triangle);
  const int order = GENERATE(1, 2);
  // Held at the seam's ends, too, or free there, where the exact solution is not.
  const bool held = GENERATE(true, false);
  INFO(name(cell) << " of order " << order << (held ? ", held beside the seam" : ""));
  const auto beside = held ? std::vector<std::string>{"y_min", "y_max"} : std::vector<std::string>{};
  const TwoPlates plates = tied(cell, order, beside);
  Problem& problem = *plates.problem;
  REQUIRE(test::solve_static(problem).converged);
  double apart = 0;
  for (const char* name : {"left", "right"}) {
    const Block& block = problem.field(name).field->blocks()[0];
    for (int node = 0; node < block.space->owned_nodes() && held; ++node) {
      const double* x = block.space->position(node);
      apart = std::max(apart, std::abs(block.now.value[node] - (2 * x[0] + 3 * x[1] + 1)));
    }
  }
  CHECK(apart < 1e-12);
  const Block& surface = problem.field("left").field->blocks()[1];
  int unknowns = 0;
  for (int node = 0; node < surface.space->owned_nodes(); ++node) {
    const bool on_seam = surface.space->position(node)[0] == 1;
    const double y = surface.space->position(node)[1];
    CHECK((surface.active[node] != 0) == (on_seam && (!held || (y > 0 && y < 1))));
    if (surface.active[node] == 0) continue;
    ++unknowns;
    // What the left plate gets, minus its own flux there.
    if (held) CHECK(surface.now.value[node] == Approx(2).epsilon(1e-10));
  }
  CHECK(problem.communicator().sum(static_cast<double>(unknowns)) == 5 * order + 1 - (held ? 2 : 0));
}

TEST_CASE("functions of a surface's nodes make up a constant, some of them left out or not", "[ranks]") {
  const int order = GENERATE(1, 2);
  const bool held = GENERATE(true, false);
  const TwoPlates plates =
      tied(CellType::quadrilateral, order,
           held ? std::vector<std::string>{"y_min", "y_max"} : std::vector<std::string>{});
  Element element;
  const Block& surface = plates.problem->field("left").field->blocks()[1];
  for (int e = 0; e < plates.seam->size(); ++e) {
    plates.seam->fill(e, element);
    const ShapeTable& table = element.sides[0].functions(1, order);
    for (int q = 0; q < element.points; ++q) {
      double sum = 0, slope = 0;
      for (int a = 0; a < table.nodes; ++a) {
        const int node = element.sides[0].nodes[1][a];
        if (surface.active[node] != 0) {
          sum += table.value_at(q)[a];
          slope += table.gradient_at(q)[table.stride + a];
        }
      }
      CHECK(sum == Approx(1).epsilon(1e-12));
      CHECK(slope == Approx(0).margin(1e-12));
    }
  }
}

TEST_CASE("unknowns of a surface that nothing is opposite to are zero", "[ranks]") {
  const int order = GENERATE(1, 2);
  const TwoPlates plates = tied(CellType::quadrilateral, order, {}, 0.5);
  REQUIRE(test::solve_static(*plates.problem).converged);
  const Block& surface = plates.problem->field("left").field->blocks()[1];
  for (int node = 0; node < surface.space->owned_nodes(); ++node) {
    if (surface.active[node] == 0) continue;
    // Cells are 0.2 high: up to 0.6 a function has a part of its support in front of the right plate.
    INFO("y = " << surface.space->position(node)[1]);
    CHECK((surface.now.value[node] == 0) == (surface.space->position(node)[1] > 0.61));
  }
}
