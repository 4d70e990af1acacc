// SPDX-License-Identifier: BSD-3-Clause
// What a coupling on a surface that looks at an obstacle is given.
#include "seam/contact/contact_domain.hpp"

#include <catch2/catch.hpp>

#include "seam/mesh/input/grid.hpp"
#include "seam/solve/problem.hpp"
#include "seam/term/kernel_term.hpp"

using namespace seam;

namespace {

using u = Vector<0>;

/// Holds a body without mass by a spring.
struct Spring {
  using Reads = Slots<Value<u>>;
  using Tests = Slots<Value<u>>;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(u{}) += s.value(u{});
  }
};

/// A dashpot between the body and what it faces.
struct Dashpot {
  using Reads = Slots<Rate<u>>;
  using Tests = Slots<Value<u>>;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(u{}) += s.rate(u{});
  }
};

class Massless final : public Physics {
 public:
  [[nodiscard]] std::vector<Unknown> unknowns(int dimension) const override {
    return {{"displacement", dimension, 1, 0, "m", UnknownRole::motion}};
  }
  void build(FieldSetup& setup) const override { setup.add_cell_term(make_term(Spring{}), {"displacement"}); }
};

/// A strip of 4 x 2 cells, 1 long and 0.1 thick.
std::shared_ptr<const Mesh> strip() {
  Grid grid;
  grid.cell = CellType::quadrilateral;
  grid.lines[0] = graded_lines(0, 1, 4);
  grid.lines[1] = graded_lines(0, 0.1, 2);
  return std::make_shared<Mesh>("strip", std::make_shared<MeshData>(make_grid(grid)), Communicator());
}

Surface ground(double) {
  Surface surface;
  surface.points = {2, -0.02, -1, -0.02};
  surface.facets = {0, 1};
  return surface;
}

}  // namespace

TEST_CASE("On contact the trace size is the cell's volume over the area of its face") {
  const auto mesh = strip();
  Field body("body", *mesh, {{"displacement", 2, 1, 0, "m"}});
  ContactDomain domain(std::make_shared<BodySurface>(body, std::vector<std::string>{}, "displacement"),
                       nullptr, ground, {0.05, 0.05}, 2);
  domain.follow(0);
  REQUIRE(domain.size() == 4);
  Element element;
  for (int e = 0; e < 4; ++e) {
    domain.fill(e, element);
    CHECK(element.trace_size[0] == Approx(0.05).epsilon(1e-12));
    CHECK(element.cell_size[0] == Approx(std::hypot(0.25, 0.05)).epsilon(1e-12));
  }
}

TEST_CASE("A coupling on an obstacle sees the velocity of a body without mass") {
  Problem problem{Communicator()};
  Field& body = problem.add_field("body", strip(), std::make_unique<Massless>());
  const auto domain = std::make_shared<ContactDomain>(
      std::make_shared<BodySurface>(body, std::vector<std::string>{}, "displacement"), nullptr, ground,
      ContactWindow{0.05, 0.05}, 2);
  problem.name_interface("ground", {{"", domain}});
  problem.add_coupling(domain, {{make_term(Dashpot{}), {{0, "displacement"}}}});
  problem.finish();
  const TimePoint at = time_point(0.5, 0.5, 1);
  problem.begin_step(at);
  Block& block = body.blocks()[0];
  std::fill(block.now.value.begin(), block.now.value.end(), -0.05);
  problem.update_rates(at);
  for (const double rate : block.now.rate) CHECK(rate == Approx(-0.1).epsilon(1e-12));
}
