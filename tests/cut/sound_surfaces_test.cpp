// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that are closed only by another body's, or given twice.
#include "seam/cut/sound_surfaces.hpp"

#include <catch2/catch.hpp>

#include "seam/mesh/input/grid.hpp"
#include "seam/mesh/mesh.hpp"

using namespace seam;

namespace {

std::unique_ptr<Mesh> box(int dimension) {
  Grid grid;
  grid.cell = dimension == 2 ? CellType::quadrilateral : CellType::tetrahedron;
  for (int d = 0; d < dimension; ++d) grid.lines[d] = graded_lines(0, 1, 5);
  return std::make_unique<Mesh>("box", std::make_shared<MeshData>(make_grid(grid)), Communicator());
}

/// A line through points of the plane.
Surface line(std::vector<double> points) {
  Surface result{2, std::move(points), {}, false};
  for (int k = 0; k + 1 < result.point_count(); ++k) result.facets.insert(result.facets.end(), {k, k + 1});
  return result;
}

/// A wall of two triangles, upright over a stretch of the x axis, from y = `from` to `to`.
Surface wall(double x, double from, double to, double height) {
  return {3, {x, from, -0.1, x, to, -0.1, x, to, height, x, from, height}, {0, 1, 2, 0, 2, 3}, false};
}

}  // namespace

TEST_CASE("surfaces of two bodies may not close each other inside of the mesh") {
  const auto mesh = box(2);
  const Surface left = line({0.5, 0.5, 0.3, 0.5, 0.3, -0.1}), right = line({0.7, -0.1, 0.7, 0.5, 0.5, 0.5});
  const auto look = [&](const Surface& a, const Surface& b, const std::string& one,
                        const std::string& other) {
    refuse_unsound_surfaces(*mesh, {a, b}, {one, other});
  };
  CHECK_THROWS_WITH(
      look(left, right, "left", "right"),
      Catch::Contains("the surface of 'left' ends inside of mesh 'box' at (0.5, 0.5), on that of "
                      "'right'") &&
          Catch::Contains("`tied`"));
  // Also where the other one goes on.
  CHECK_THROWS(look(left, line({0.7, -0.1, 0.7, 0.5, 0.4, 0.5}), "left", "right"));
  // Parts of one body, shapes that are no body's, one that ends elsewhere, outside, or at the border.
  CHECK_NOTHROW(look(left, right, "body", "body"));
  CHECK_NOTHROW(look(left, right, "left", ""));
  CHECK_NOTHROW(look(left, line({0.7, -0.1, 0.7, 0.52, 0.5, 0.52}), "left", "right"));
  CHECK_NOTHROW(
      look(line({-0.1, 0.5, 0.3, 0.5, 0.3, -0.1}), line({0.7, -0.1, 0.7, 0.5, -0.1, 0.5}), "left", "right"));
  CHECK_NOTHROW(
      look(line({0, 0.5, 0.3, 0.5, 0.3, -0.1}), line({0.7, -0.1, 0.7, 0.5, 0, 0.5}), "left", "right"));
  // The whole of one that touches the other.
  Surface whole = line({0.5, 0.5, 0.3, 0.5, 0.3, 0.1, 0.5, 0.1});
  whole.facets.insert(whole.facets.end(), {3, 0});
  whole.closed = true;
  CHECK_NOTHROW(look(whole, line({0.5, 1.1, 0.5, 0.3, 0.5, -0.1}), "left", "right"));
}

TEST_CASE("no part of a body's surface may be given twice") {
  const auto mesh = box(2);
  const Surface foot = line({0.2, 0.5, 0.5, 0.5, 0.8, 0.5}), part = line({0.8, 0.5, 0.5, 0.5}),
                beside = line({0.8, 0.5, 0.8, 1.1});
  CHECK_THROWS_WITH(
      refuse_unsound_surfaces(*mesh, {foot, part}, {"block", "block"}),
      Catch::Contains("the same part of the surface of 'block'") && Catch::Contains("(0.8, 0.5)"));
  CHECK_NOTHROW(refuse_unsound_surfaces(*mesh, {foot, beside}, {"block", "block"}));
  CHECK_NOTHROW(refuse_unsound_surfaces(*mesh, {foot, foot}, {"", ""}));
}

TEST_CASE("in space, too, by the edges that they share") {
  const auto mesh = box(3);
  const auto look = [&](double height, double shift) {
    refuse_unsound_surfaces(*mesh, {wall(0.5, -0.1, 0.5, height), wall(0.5, 0.5 + shift, 1.1, height)},
                            {"left", "right"});
  };
  CHECK_THROWS_WITH(look(0.6, 0), Catch::Contains("ends inside of mesh 'box' at (0.5, 0.5, 0.6)"));
  CHECK_NOTHROW(look(0.6, 0.01));
  // Its upper edge lies outside; what ends at the lower one does so, too.
  CHECK_NOTHROW(
      refuse_unsound_surfaces(*mesh, {wall(0.5, -0.1, 1.1, 0.6), wall(0.4, -0.1, 1.1, 0.6)}, {"a", "b"}));
}
