// SPDX-License-Identifier: BSD-3-Clause
#include "seam/mesh/input/grid.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "mesh/mesh_test.hpp"
#include "seam/mesh/input/mesh_input.hpp"

using namespace seam;
using Catch::Contains;

namespace {

struct Case {
  std::string cell;
  int dimension;
  int per_brick;
};
const std::vector<Case> cases = {
    {"quadrilateral", 2, 1}, {"triangle", 2, 2}, {"hexahedron", 3, 1}, {"tetrahedron", 3, 6}};

std::string grid_text(const Case& c, int order, const std::string& more = "") {
  return c.dimension == 2 ? "grid: {from: [-1, 0], to: [1, 3], cells: [3, 4], cell: " + c.cell +
                                ", order: " + std::to_string(order) + more + "}"
                          : "grid: {from: [-1, 0, 0], to: [1, 3, 0.5], cells: [3, 4, 2], cell: " + c.cell +
                                ", order: " + std::to_string(order) + more + "}";
}

}  // namespace

TEST_CASE("A grid fills its box and names its sides") {
  for (const Case& c : cases)
    for (const int order : {1, 2}) {
      CAPTURE(c.cell, order);
      const MeshData m = mesh_from_yaml(grid_text(c, order), c.dimension);
      const int bricks = c.dimension == 2 ? 12 : 24;
      CHECK(m.cell_count() == bricks * c.per_brick);
      const int across = 3 * order + 1, up = 4 * order + 1, deep = c.dimension == 2 ? 1 : 2 * order + 1;
      CHECK(m.node_count() == across * up * deep);
      CHECK(volume(m) == Approx(c.dimension == 2 ? 6.0 : 3.0));
      REQUIRE(m.boundaries.size() == 2u * c.dimension);
      const double depth = c.dimension == 2 ? 1.0 : 0.5;
      const Surface left = surface(m, "x_min"), top = surface(m, "y_max");
      CHECK(left.area == Approx(3 * depth));
      CHECK(left.normal[0] == Approx(-3 * depth));
      CHECK(top.area == Approx(2 * depth));
      CHECK(top.normal[1] == Approx(2 * depth));
      if (c.dimension == 3) CHECK(surface(m, "z_max").normal[2] == Approx(6.0));
    }
}

TEST_CASE("Grid nodes are numbered x first") {
  const MeshData m = mesh_from_yaml(grid_text(cases[0], 1), 2);
  CHECK(m.coordinates[0] == -1.0);
  CHECK(m.coordinates[2] == Approx(-1 + 2.0 / 3));
  CHECK(m.coordinates[3] == 0.0);
  CHECK(m.cells[2] == 5);
}

TEST_CASE("Grading is the width of the last cell over that of the first") {
  const auto lines = graded_lines(0, 2, 5, 16);
  REQUIRE(lines.size() == 6);
  CHECK((lines[5] - lines[4]) / (lines[1] - lines[0]) == Approx(16));
  CHECK((lines[2] - lines[1]) / (lines[1] - lines[0]) == Approx(2));
  CHECK(lines[5] == 2.0);
  CHECK(graded_lines(0, 1, 4)[1] == 0.25);
  CHECK(volume(mesh_from_yaml(grid_text(cases[1], 2, ", grading: [4, 0.25]"), 2)) == Approx(6));
}

TEST_CASE("Lines may be given one by one") {
  const MeshData m = mesh_from_yaml("grid: {lines: {x: [0, 0.1, 1], y: [0, 2]}}", 2);
  CHECK(m.cell_count() == 2);
  CHECK(m.coordinates[2] == 0.1);
  const auto error = [](const std::string& text) { return error_of([&] { mesh_from_yaml(text, 2); }); };
  CHECK_THAT(
      error("grid: {lines: {x: [0, 1, 1], y: [0, 2]}}"),
      Contains("scene.yaml:1:") && Contains("line 3 along x is at 1, not beyond the one before it at 1"));
  CHECK_THAT(error("grid: {lines: {x: [0, 1]}}"), Contains("the grid needs 'from'") && Contains("along y"));
  CHECK_THAT(error("grid: {lines: {x: [0, 1]}, from: [0.5, 0], to: [1, 1], cells: [1, 1]}"),
             Contains("'from' is 0.5 along x, but the lines given there make it 0"));
}

TEST_CASE("A map shapes the grid: Cook's membrane") {
  const std::string cook = ", map: [\"48*x\", \"44*x + y*(44 - 28*x)\"]}";
  for (const int order : {1, 2}) {
    const MeshData m = mesh_from_yaml(
        "grid: {from: [0, 0], to: [1, 1], cells: [4, 4], order: " + std::to_string(order) + cook, 2);
    CHECK(volume(m) == Approx(48 * (44 + 16) / 2.0));
    CHECK(surface(m, "x_max").area == Approx(16));
  }
}

TEST_CASE("Second-order nodes follow a curved map") {
  // A quarter ring between radii 1 and 2.
  const MeshData m = mesh_from_yaml(
      "grid: {from: [1, 0], to: [2, 1], cells: [2, 8], order: 2, map: [\"x*cos(pi/2*y)\", "
      "\"x*sin(pi/2*y)\"]}",
      2);
  CHECK(volume(m) == Approx(std::acos(-1.0) * 3 / 4).epsilon(1e-5));
}

TEST_CASE("A grid can be turned") {
  const MeshData m = mesh_from_yaml(grid_text(cases[0], 1, ", rotate: {angle: 90, about: [-1, 0]}"), 2);
  CHECK(volume(m) == Approx(6));
  CHECK(m.coordinates[0] == Approx(-1));
  CHECK(m.coordinates[2] == Approx(-1).epsilon(0).margin(1e-15));
  CHECK(m.coordinates[3] == Approx(2.0 / 3));
  const MeshData b = mesh_from_yaml(grid_text(cases[2], 1, ", rotate: {angle: 90, axis: [0, 2, 0]}"), 3);
  CHECK(volume(b) == Approx(3));
  CHECK(surface(b, "x_max").normal[2] == Approx(-1.5));
  CHECK_THAT(
      error_of([&] { mesh_from_yaml(grid_text(cases[0], 1, ", rotate: {angle: 9, axis: [0, 2]}"), 2); }),
      Contains("a plane mesh turns about z only"));
}

TEST_CASE("Sides are renamed and joined, boundaries and regions picked by place") {
  const MeshData m =
      mesh_from_yaml(grid_text(cases[0], 1, ", sides: {x_min: wall, x_max: wall, y_min: inlet}") +
                         "\nboundaries: {loaded: {where: \"x > 0.99 && y > 2\"}}"
                         "\nregions: {low: {where: \"y < 1.5\"}}",
                     2);
  CHECK(m.boundaries.at("wall").size() == 8);
  CHECK(m.boundaries.at("inlet").size() == 3);
  CHECK(m.boundaries.contains("y_max"));
  CHECK_FALSE(m.boundaries.contains("x_min"));
  CHECK(surface(m, "loaded").area == Approx(0.75));
  CHECK(m.regions.at("low").size() == 6);
  const auto error = [](const std::string& more) {
    return error_of([&] { mesh_from_yaml(grid_text(cases[0], 1) + "\n" + more, 2); });
  };
  CHECK_THAT(error("boundaries: {far: {where: \"x > 5\"}}"),
             Contains("no outer face fulfils 'x > 5', so 'far' would be empty"));
  CHECK_THAT(error("boundaries: {x_min: {where: \"x > 5\"}}"), Contains("has a boundary 'x_min' already"));
  CHECK_THAT(error("regions: {far: {where: \"x > 5\"}}"), Contains("no cell fulfils 'x > 5'"));
  CHECK_THAT(error_of([&] { mesh_from_yaml(grid_text(cases[0], 1, ", sides: {z_min: a}"), 2); }),
             Contains("a plane grid has no side 'z_min'"));
}

TEST_CASE("A grid that cannot be made says why") {
  const auto error = [](const std::string& text, int dimension = 2) {
    return error_of([&] { mesh_from_yaml("grid: {" + text + "}", dimension); });
  };
  CHECK_THAT(error("from: [0, 0], to: [1, 1], cells: [2.5, 1]"), Contains("2.5 cells along x"));
  CHECK_THAT(error("from: [0, 0], to: [1, 1], cells: [0, 1]"), Contains("0 cells along x"));
  CHECK_THAT(error("from: [0, 2], to: [1, 1], cells: [1, 1]"),
             Contains("the grid ends at y = 1, not beyond"));
  CHECK_THAT(error("from: [0, 0], to: [1, 1], cells: [100000, 100000]"),
             Contains("found 10000000000 cells in the grid, at most 1e+08 are allowed"));
  CHECK_THAT(error("from: [0, 0], to: [1, 1], cells: [1, 1], cell: hexahedron"),
             Contains("a hexahedron has dimension 3, but the scene has dimension 2"));
  CHECK_THAT(error("from: [0, 0], to: [1, 1], cells: [1, 1], diagonals: rising"),
             Contains("'diagonals' is for tri"));
  CHECK_THAT(error("from: [0, 0], to: [1, 1], cells: [2, 1], map: [\"-x\", y]"),
             Contains("2 inverted cell(s)") && Contains("cell 0 (nodes 0 1 4 3) around (-0.25, 0.5)"));
  CHECK_THAT(error("from: [0, 0], to: [1, 1], cells: [2, 1], map: [\"0*x\", y]"),
             Contains("2 degenerate cell(s)"));
  CHECK_THAT(error("from: [0, 0], to: [1, 1], cells: [2, 1], map: [\"1/x\", y]"),
             Contains("component 1 of 'map' is not a finite number at (0, 0)"));
  CHECK_THAT(error("from: [1e8, 0], to: [100000000.0000001, 1], cells: [99, 1]"), Contains("too thin"));
  CHECK_THAT(error_of([] { mesh_from_yaml("boundaries: {}", 2); }), Contains("neither 'grid' nor 'file'"));
}
