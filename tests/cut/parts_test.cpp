// SPDX-License-Identifier: BSD-3-Clause
// Connected parts of the fluid.
#include <catch2/catch.hpp>

#include "cut/cut_test.hpp"

using namespace seam;

namespace {

Surface rectangle(double x0, double y0, double x1, double y1) {
  return polygon({{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}});
}

/// A square ring around a chamber.
std::vector<Surface> ring(double x, double y, double inner, double wall) {
  const double outer = inner + wall;
  return {rectangle(x - outer, y - outer, x + outer, y - inner),
          rectangle(x - outer, y + inner, x + outer, y + outer),
          rectangle(x - outer, y - outer, x - inner, y + outer),
          rectangle(x + inner, y - outer, x + outer, y + outer)};
}

}  // namespace

TEST_CASE("Parts of the fluid are told apart and small ones can be dropped", "[cut][parts][ranks]") {
  const Mesh mesh = grid(CellType::quadrilateral, {20, 20, 0}, unmoved());
  CutMesh cut(mesh);
  std::vector<Surface> bodies = ring(.25, .25, .12, .06);
  for (const Surface& s : ring(.72, .68, .03, .06)) bodies.push_back(s);
  cut.cut(bodies);
  const WetParts parts = cut.find_parts();
  REQUIRE(parts.volume.size() == 3);
  std::vector<double> sorted = parts.volume;
  std::sort(sorted.begin(), sorted.end());
  CHECK(sorted[0] == Approx(.06 * .06).epsilon(1e-12));
  CHECK(sorted[1] == Approx(.24 * .24).epsilon(1e-12));
  CHECK(sorted[2] == Approx(1 - .36 * .36 - .18 * .18).epsilon(1e-12));
  CHECK(*std::min_element(parts.cells.begin(), parts.cells.end()) == Approx(.0036 * 400).epsilon(1e-12));

  std::vector<int> small;
  for (int c = 0; c < mesh.cells(); ++c)
    if (parts.part[c] >= 0 && parts.cells[parts.part[c]] < 2) small.push_back(c);
  const Communicator& communicator = mesh.communicator();
  CHECK(communicator.any(!small.empty()));
  CHECK(cut.drop(small) == Approx(.06 * .06).epsilon(1e-12));
  for (const int c : small) CHECK(cut.state(c) == CellState::body);
  double left = 0;
  for (int c = 0; c < mesh.owned_cells(); ++c)
    if (cut.state(c) != CellState::body)
      left += cut.state(c) == CellState::cut ? cut.wet_volume(c) : whole_volume(mesh, c);
  CHECK(communicator.sum(left) == Approx(1 - .36 * .36 - .18 * .18 + .24 * .24).epsilon(1e-12));
  CHECK(cut.find_parts().volume.size() == 2);
}

TEST_CASE("Ghost cells have their owners' states", "[cut][parts][ranks]") {
  const double h = 1.0 / 8;
  const Mesh mesh = grid(CellType::quadrilateral, {8, 8, 0}, unmoved());
  CutMesh cut(mesh);
  cut.cut(std::vector{rectangle(2 * h, 3 * h, 5 * h, 6 * h)});
  std::vector<int> mine(64, 0);
  for (int c = 0; c < mesh.owned_cells(); ++c) mine[mesh.global_cell(c)] = 1 + static_cast<int>(cut.state(c));
  std::vector<double> all(mine.begin(), mine.end());
  mesh.communicator().sum(all);
  for (int c = 0; c < mesh.cells(); ++c)
    CHECK(all[mesh.global_cell(c)] == 1 + static_cast<int>(cut.state(c)));
  CHECK(mesh.communicator().sum(static_cast<double>(std::count(mine.begin(), mine.end(), 3))) == 12);
}
