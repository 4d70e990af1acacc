// SPDX-License-Identifier: BSD-3-Clause
// In space: what of a body's surface is wet, and what the closed rest of it weighs.
#include "seam/contact/embedded_surface.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "seam/mesh/input/grid.hpp"
#include "seam/mesh/quadrature.hpp"
#include "seam/state/state_store.hpp"

using namespace seam;

namespace {

using Corner = std::array<double, 3>;

std::unique_ptr<Mesh> block(CellType cell, const Corner& low, const Corner& high, int cells) {
  Grid grid;
  grid.cell = cell;
  for (int d = 0; d < 3; ++d) grid.lines[d] = graded_lines(low[d], high[d], cells);
  return std::make_unique<Mesh>("block", std::make_shared<MeshData>(make_grid(grid)), Communicator());
}

/// The same, its upper side tilted along x about where x = 0.5.
std::unique_ptr<Mesh> tilted(const Corner& low, const Corner& high, double slope) {
  Grid grid;
  grid.cell = CellType::hexahedron;
  for (int d = 0; d < 3; ++d) grid.lines[d] = graded_lines(low[d], high[d], 1);
  MeshData data = make_grid(grid);
  for (std::size_t k = 0; k < data.coordinates.size(); k += 3)
    if (data.coordinates[k + 2] > 0) data.coordinates[k + 2] += slope * (data.coordinates[k] - 0.5);
  return std::make_unique<Mesh>("block", std::make_shared<MeshData>(std::move(data)), Communicator());
}

/// A stamp of one cell's tetrahedra that has sunk by `depth` into a step, which ends below it.
struct Stamp {
  explicit Stamp(double edge, double depth = 0.01, double slope = 0)
      : water_mesh(block(CellType::hexahedron, {0, 0, 0}, {1, 1, 1}, 6)),
        stamp_mesh(block(CellType::tetrahedron, {0.25, 0.25, 0.5}, {0.75, 0.75, 0.85}, 1)),
        step_mesh(tilted({edge, -0.5, -0.5}, {1.5, 1.5, 0.5 + depth}, slope)),
        water("water", *water_mesh, {{"p", 1, 1, 0, ""}}),
        stamp("stamp", *stamp_mesh, {{"displacement", 3, 1, 0, "m"}}),
        step("step", *step_mesh, {{"displacement", 3, 1, 0, "m"}}),
        cut(water),
        stamp_surface(std::make_shared<BodySurface>(stamp, std::vector<std::string>{}, "displacement")),
        step_surface(std::make_shared<BodySurface>(step, std::vector<std::string>{}, "displacement")),
        surface(water, cut, cut.add_body([this](double) { return stamp_surface->now(); }), stamp_surface,
                step_surface, {0.05, 0.05}, degree) {
    cut.add_body([this](double) { return step_surface->now(); });
    water.blocks()[0].known.assign(water.blocks()[0].known.size(), 1);
    cut.update(0);
    water.occupy(cut.active_cells(), &cut.mesh());
    surface.begin_step();
    surface.follow();
  }
  /// Positions of a zone's points on one of its sides, [point].
  [[nodiscard]] std::vector<Corner> positions(EmbeddedSurface::Zone zone, int side) {
    const EmbeddedZone domain({&surface, [](EmbeddedSurface*) {}}, zone);
    std::vector<Corner> result;
    Element element;
    for (int e = 0; e < domain.size(); ++e) {
      domain.fill(e, element);
      for (int q = 0; q < element.points; ++q) {
        Corner& x = result.emplace_back();
        std::copy_n(&element.sides[side].position[static_cast<std::size_t>(q) * 3], 3, x.begin());
      }
    }
    return result;
  }
  /// Of the points of a part on the stamp's lower side.
  [[nodiscard]] double area(EmbeddedSurface::Zone part) const {
    double sum = 0;
    for (const EmbeddedSurface::Element& element : surface.elements(part))
      for (std::size_t q = 0; q < element.own.weight.size(); ++q)
        if (element.normal[3 * q + 2] > 0.99) sum += element.own.weight[q];
    return Communicator().sum(sum);
  }
  static constexpr int degree = 2;  ///< three points a facet
  std::unique_ptr<Mesh> water_mesh, stamp_mesh, step_mesh;
  Field water, stamp, step;
  FieldCut cut;
  std::shared_ptr<BodySurface> stamp_surface, step_surface;
  EmbeddedSurface surface;
};

/// Of a triangle, the area where x > edge. @param x of its vertices
double area_beyond(double edge, double area, Corner x) {
  std::ranges::sort(x);
  const double width = x[2] - x[0];
  if (edge <= x[0]) return area;
  if (edge >= x[2]) return 0;
  if (edge > x[1]) return area * (x[2] - edge) * (x[2] - edge) / (width * (x[2] - x[1]));
  return area * (1 - (edge - x[0]) * (edge - x[0]) / (width * (x[1] - x[0])));
}

struct Expected {
  double wet = 0, closed = 0;
  int bounded = 0;  ///< facets whose closed points would have to stand for more than twice their own
};

/// All that is not wet, but for no point more than twice its weight.
Expected expected(const Stamp& body, double edge) {
  const Quadrature& rule = quadrature(CellType::triangle, Stamp::degree);
  const Surface stamp = body.stamp_surface->now();
  Expected result;
  for (int facet = 0; facet < stamp.facet_count(); ++facet) {
    Corner x{}, y{}, z{};
    for (int k = 0; k < 3; ++k) {
      const double* at = &stamp.points[static_cast<std::size_t>(stamp.facets[facet * 3 + k]) * 3];
      x[k] = at[0], y[k] = at[1], z[k] = at[2];
    }
    if (*std::ranges::max_element(z) > 0.5 + 1e-9) continue;
    const double area = std::abs((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])) / 2;
    const double closed = area_beyond(edge, area, x);
    double points = 0;
    for (int q = 0; q < rule.count(); ++q) {
      const double *s = &rule.points[static_cast<std::size_t>(q) * 2], weight = 2 * area * rule.weights[q];
      if (x[0] + s[0] * (x[1] - x[0]) + s[1] * (x[2] - x[0]) > edge) points += weight;
    }
    result.wet += area - closed;
    result.closed += std::min(closed, 2 * points);
    if (points > 0 && closed > 2 * points) ++result.bounded;
  }
  return result;
}

}  // namespace

TEST_CASE("closed points stand for all of a facet that is not wet, none for more than twice its own area") {
  int bounded = 0;
  // In quarters of the stamp's width from its left side.
  for (const double share : {-0.1, 0.1, 0.17, 0.3, 0.5, 0.7, 0.8, 0.9}) {
    const double edge = 0.25 + 0.5 * share;
    const Stamp stamp(edge);
    const Expected right = expected(stamp, edge);
    INFO("edge at " << share << " of the width");
    CHECK(stamp.area(EmbeddedSurface::free) + stamp.area(EmbeddedSurface::near) ==
          Approx(right.wet).epsilon(0).margin(1e-9));
    CHECK(stamp.area(EmbeddedSurface::closed) == Approx(right.closed).epsilon(0).margin(1e-9));
    bounded += right.bounded;
  }
  CHECK(bounded > 0);
}

TEST_CASE("closed points look at the nearest of those wet points that face the other body") {
  // Half of the stamp is on the step; what is wet and faces it lies on its tilted upper side.
  Stamp stamp(-0.5, 0, 0.2);
  const std::vector<Corner> closed = stamp.positions(EmbeddedSurface::closed, 1),
                            edge = stamp.positions(EmbeddedSurface::closed, 3),
                            fluid = stamp.positions(EmbeddedSurface::closed, 0),
                            wet = stamp.positions(EmbeddedSurface::near, 1);
  REQUIRE(closed.size() >= 3);
  REQUIRE(wet.size() > 3);
  const auto distance = [](const Corner& a, const Corner& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  };
  for (std::size_t q = 0; q < closed.size(); ++q) {
    double least = 1, most = 0;
    for (const Corner& x : wet) {
      least = std::min(least, distance(closed[q], x));
      most = std::max(most, distance(closed[q], x));
    }
    REQUIRE(most > 1.2 * least);
    CHECK(distance(closed[q], edge[q]) == Approx(least).epsilon(1e-9));
    CHECK(distance(fluid[q], edge[q]) < 1e-9);
  }
}

TEST_CASE("of a facet that is closed in part only points behind the other surface stand for what is closed") {
  const Stamp stamp(-0.5, 0, 0.05);
  int points = 0, ahead = 0;
  for (const EmbeddedSurface::Element& element : stamp.surface.elements(EmbeddedSurface::closed))
    for (const double gap : element.gap) {
      CHECK(gap < 0);
      ++points;
    }
  for (const EmbeddedSurface::Element& element : stamp.surface.elements(EmbeddedSurface::near))
    for (const double gap : element.gap) ahead += gap > 0 ? 1 : 0;
  CHECK(points > 0);
  CHECK(ahead > 0);
  // Half of the lower side, 0.5 by 0.5.
  CHECK(stamp.area(EmbeddedSurface::closed) == Approx(0.125).epsilon(1e-9));
}

TEST_CASE("a surface that lies deeper in the other body than the window looks back is refused") {
  CHECK_NOTHROW(Stamp(-0.5, 0.04));
  CHECK_THROWS_WITH(Stamp(-0.5, 0.06), Catch::Contains("has passed through"));
}

TEST_CASE("how deep bodies are in each other is a state, which goes back with a step and is forgotten") {
  const auto overlap = [](const Field& body) {
    for (const AnyState* state : body.state().states())
      if (state->name() == "stamp/passage/step") return state->numbers().at(0);
    FAIL("the stamp has no such state");
    return 0.0;
  };
  const auto lift = [](Stamp& body, double by) {
    Block& block = body.stamp.blocks()[0];
    for (std::size_t k = 2; k < block.now.value.size(); k += 3) block.now.value[k] = by;
    body.surface.follow();
  };
  // Half of what the window looks back is 0.025.
  CHECK(overlap(Stamp(-0.5, 0.02).stamp) == Approx(0.02));
  Stamp deep(-0.5, 0.03);
  CHECK(overlap(deep.stamp) == Approx(0.03));
  const StateStore::Snapshot before = Stamp(-0.5, 0.02).stamp.state().snapshot(0);
  deep.stamp.state().restore(before);
  CHECK(overlap(deep.stamp) == Approx(0.02));
  lift(deep, 0.029);
  CHECK(overlap(deep.stamp) == Approx(0.001));
}

TEST_CASE(
    "bodies that were deep in each other are looked at in the next step, and later only if they still are") {
  Stamp stamp(-0.5, 0.041);
  Passage passage(stamp.stamp_surface, stamp.step_surface, {0.05, 0.05});
  const auto check = [&](double height, double least_gap) {
    Block& block = stamp.stamp.blocks()[0];
    for (std::size_t k = 2; k < block.now.value.size(); k += 3) block.now.value[k] = height;
    passage.check(OppositePoints(*stamp.stamp_surface, stamp.step_surface.get(), stamp.stamp_surface->now(),
                                 stamp.step_surface->now(), {0.05, 0.05}),
                  least_gap);
  };
  // Onwards by less than what is looked at in any case, and out of sight.
  const auto sink = [&](double least_gap) {
    check(0, least_gap);
    passage.begin_step(stamp.step_surface->now());
    check(-0.011, 0);
  };
  passage.begin_step(stamp.step_surface->now());
  CHECK_THROWS_WITH(sink(-0.041), Catch::Contains("has passed through"));
  CHECK_NOTHROW(sink(-0.02));
}

TEST_CASE("interfaces between the same bodies remember an overlap each") {
  Stamp stamp(-0.5, 0.02);
  const Passage again(stamp.stamp_surface, stamp.step_surface, {0.05, 0.05});
  const std::vector<AnyState*> states = stamp.stamp.state().states();
  for (const std::string name : {"stamp/passage/step", "stamp/passage/step 2"})
    CHECK(std::ranges::count_if(states, [&](const AnyState* state) { return state->name() == name; }) == 1);
}
