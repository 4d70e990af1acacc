// SPDX-License-Identifier: BSD-3-Clause
// States of nodes that come alive.
#include "seam/cut/extension.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "cut/cut_test.hpp"
#include "seam/base/diagnostics.hpp"
#include "seam/cut/field_cut.hpp"

using namespace seam;

namespace {

/// Another linear function for each component of each level.
double linear(std::size_t level, int component, const double* x, int dim) {
  double sum = 1.0 + static_cast<double>(level) - 3 * component;
  for (int d = 0; d < dim; ++d) sum += (0.5 + static_cast<double>(level) * (d + 1) - 0.7 * component) * x[d];
  return sum;
}

}  // namespace

TEST_CASE("all levels of a state, old ones included, go on to new nodes as they are", "[ranks]") {
  const auto [cell_type, polynomial] = GENERATE(table<CellType, int>(
      {{CellType::quadrilateral, 1}, {CellType::triangle, 2}, {CellType::hexahedron, 1}}));
  const CellType type = cell_type;
  const int order = polynomial, dim = type == CellType::hexahedron ? 3 : 2;
  const Mesh mesh = grid(type, {5, 4, dim == 3 ? 3 : 0}, rotated(dim, 0.3, {1, 1.2, 1}, {0, 0, 0}));
  Field field("water", mesh, {{"v", 2, order, 1, ""}});
  field.occupy(std::vector<char>(mesh.cells(), 1));
  Block& block = field.blocks()[0];
  field.keep_mean_rates();
  std::vector<std::vector<double>*> levels;
  for (const NodalState& state : {block.now, block.old})
    for (std::vector<double>* level :
         {&state.value, &state.rate, &state.second_rate, state.mean_rate, state.mean_second_rate})
      levels.push_back(level);

  const auto each_value = [&](const auto& visit) {
    for (int c = 0; c < mesh.cells(); ++c)
      for (int k = 0; k < block.space->nodes_per_cell(); ++k) {
        double reference[3];
        std::copy_n(&topology(type).node_coordinates[static_cast<std::size_t>(k) * dim], dim, reference);
        const Point x = position(mesh, c, reference);
        const int node = field.cell_nodes(0, c)[k];
        for (std::size_t l = 0; l < levels.size(); ++l)
          for (int i = 0; i < 2; ++i)
            visit((*levels[l])[static_cast<std::size_t>(node) * 2 + i], linear(l, i, x.data(), dim), node, x);
      }
  };
  block.known.assign(block.known.size(), 1);
  int fresh = 0;
  each_value([&](double& value, double exact, int node, const Point& x) {
    value = exact;
    // A corner of the mesh is new, and holds whatever was there.
    if (std::hypot(x[0], x[1], x[2]) < 0.25) {
      block.known[node] = 0;
      value = 1e3;
      ++fresh;
    }
  });
  REQUIRE(Communicator().sum(static_cast<long long>(fresh)) > 0);
  Extension(field).extend();
  each_value([](double value, double exact, int, const Point&) {
    CHECK(value == Approx(exact).epsilon(1e-9).margin(1e-9));
  });
}

TEST_CASE("what states are extended to does not depend on the unit of length", "[ranks]") {
  std::vector<std::vector<double>> values;
  for (const double unit : {1.0, 100.0}) {
    const Mesh mesh = grid(CellType::quadrilateral, {5, 4, 0}, [&](const Point& x) {
      return Point{unit * x[0], unit * x[1], 0};
    });
    Field field("water", mesh, {{"v", 1, 2, 1, ""}});
    field.occupy(std::vector<char>(mesh.cells(), 1));
    Block& block = field.blocks()[0];
    for (int n = 0; n < block.space->nodes(); ++n) {
      const double* x = block.space->position(n);
      const bool is_new = std::hypot(x[0], x[1]) < 0.25 * unit;
      block.known[n] = is_new ? 0 : 1;
      block.now.value[n] = is_new ? 1e3 : std::sin(5 * x[0] / unit + 2 * x[1] / unit);
    }
    Extension(field).extend();
    values.push_back(block.now.value);
  }
  REQUIRE(values[0].size() == values[1].size());
  for (std::size_t n = 0; n < values[0].size(); ++n)
    CHECK(values[1][n] == Approx(values[0][n]).epsilon(1e-9).margin(1e-9));
}

TEST_CASE("states reach along a film that opens, and never beyond what is around it", "[ranks]") {
  const Mesh mesh = grid(CellType::quadrilateral, {20, 20, 0}, unmoved());
  const auto box_of = [](double x0, double y0, double x1, double y1) {
    return polygon({{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}});
  };
  double left = 0.22, right = 0.82, gap = 0;
  Field field("water", mesh, {{"u", 1, 1, 1, ""}});
  FieldCut cut(field);
  cut.add_body([&](double) { return box_of(left, 0.2, right, 0.51); });
  cut.add_body([&](double) { return box_of(left, 0.51 + gap, right, 0.8 + gap); });
  Block& block = field.blocks()[0];
  block.known.assign(block.known.size(), 1);
  cut.update(0);
  // It falls steeply towards the film from both of its ends.
  for (int n = 0; n < block.space->nodes(); ++n)
    block.now.value[n] = std::abs(block.space->position(n)[0] - 0.52);
  const std::vector<char> known = block.known;
  gap = 1e-4;
  SECTION("between its ends") {
    cut.update(0.1);
    double least = 1, greatest = 0;
    for (int n = 0; n < block.space->nodes(); ++n) {
      if (known[n] || !block.active[n]) continue;
      least = std::min(least, block.now.value[n]);
      greatest = std::max(greatest, block.now.value[n]);
    }
    const Communicator all;
    CHECK(all.min(least) > 0.2);
    CHECK(all.max(greatest) < 0.35);
  }
  SECTION("but not where it is too thick") {
    gap = 0.02;
    CHECK_THROWS_AS(cut.update(0.1), StepRefused);
  }
  SECTION("and one that nothing known touches begins at rest, unless it is too thick") {
    left = -0.1;
    right = 1.1;
    gap = 0;
    cut.update(0.1);
    const std::vector<char> apart = block.known;
    gap = 2e-2;
    CHECK_THROWS_AS(cut.update(0.2), StepRefused);
    gap = 6e-3;  // large enough not to be dropped
    for (int n = 0; n < block.space->nodes(); ++n)
      if (!apart[n]) block.now.value[n] = 1;
    cut.update(0.2);
    int fresh = 0;
    double most = 0;
    for (int n = 0; n < block.space->nodes(); ++n) {
      if (apart[n] || !block.active[n]) continue;
      ++fresh;
      most = std::max(most, std::abs(block.now.value[n]));
    }
    const Communicator all;
    CHECK(all.sum(static_cast<double>(fresh)) >= 40);
    CHECK(all.max(most) < 1e-9);
  }
}
