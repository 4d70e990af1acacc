// SPDX-License-Identifier: BSD-3-Clause
// Which faces between cells a ghost penalty acts on, and their sizes.
#include <catch2/catch.hpp>
#include <cmath>

#include "cut/cut_test.hpp"
#include "seam/assembly/domains.hpp"
#include "seam/field/field.hpp"

using namespace seam;
using Faces = InteriorFaceDomain::Faces;

namespace {

/// Faces of all ranks on a square of 8 x 8 cells out of which a box is cut.
long long count_faces(const Surface& body, Faces faces, bool covered_are_active) {
  const Mesh mesh = grid(CellType::quadrilateral, {8, 8, 0}, unmoved());
  CutMesh cut(mesh);
  cut.cut(std::vector{body});
  Field field("water", mesh, {{"v", 1, 1, 0, ""}});
  std::vector<char> active(mesh.cells(), 1);
  for (int c = 0; c < mesh.cells(); ++c)
    if (!covered_are_active && cut.state(c) == CellState::body) active[c] = 0;
  field.occupy(active, &cut);
  const InteriorFaceDomain domain(field, 2, faces);
  return mesh.communicator().sum(static_cast<long long>(domain.size()));
}

Surface rectangle(Point low, Point high) {
  return polygon({low, {high[0], low[1], 0}, high, {low[0], high[1], 0}});
}

}  // namespace

TEST_CASE("a ghost penalty holds all faces of cut cells and of covered ones that are kept", "[cut][ranks]") {
  // It covers 2 x 2 cells, and cuts the 12 around them.
  const Surface square = rectangle({0.3, 0.3, 0}, {0.7, 0.7, 0});
  CHECK(count_faces(square, Faces::all, true) == 2 * 7 * 8);
  CHECK(count_faces(square, Faces::ghost, true) == 40);
  CHECK(count_faces(square, Faces::wet_ghost, true) == 40);
  CHECK(count_faces(square, Faces::ghost, false) == 28);
  CHECK(count_faces(square, Faces::wet_ghost, false) == 28);
  // It cuts 2 x 4 cells; two of the faces between them are within it.
  const Surface flat = rectangle({0.3, 0.3, 0}, {0.7, 0.45, 0});
  CHECK(count_faces(flat, Faces::ghost, true) == 22);
  CHECK(count_faces(flat, Faces::wet_ghost, true) == 20);
}

TEST_CASE("sizes of a face are the diameter of the larger cell, and how far that reaches", "[ranks]") {
  const Mesh mesh = grid(CellType::quadrilateral, {6, 1, 0}, [](const Point& x) {
    return Point{x[0] * x[0], x[1], 0};
  });
  Field field("water", mesh, {{"v", 1, 1, 0, ""}});
  field.occupy(std::vector<char>(mesh.cells(), 1));
  const InteriorFaceDomain faces(field, 2);
  Element element;
  int seen = 0;
  for (int f = 0; f < faces.size(); ++f, ++seen) {
    faces.fill(f, element);
    const double x = element.sides[0].position[0], right = std::sqrt(x) + 1.0 / 6;
    CHECK(element.cell_size[0] == Approx(std::hypot(right * right - x, 1)));  // cells grow to the right
    CHECK(element.trace_size[0] == Approx(right * right - x));
  }
  CHECK(mesh.communicator().sum(static_cast<long long>(seen)) == 5);
}
