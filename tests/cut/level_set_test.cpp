// SPDX-License-Identifier: BSD-3-Clause
// Bodies given by a function.
#include "seam/cut/level_set.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "cut/cut_test.hpp"

using namespace seam;

namespace {

double owned_fluid(const CutMesh& cut) {
  double sum = 0;
  for (int c = 0; c < cut.mesh().owned_cells(); ++c)
    if (cut.state(c) != CellState::body)
      sum += cut.state(c) == CellState::cut ? cut.wet_volume(c) : whole_volume(cut.mesh(), c);
  return cut.mesh().communicator().sum(sum);
}

}  // namespace

TEST_CASE("A linear level set cuts exactly, also along mesh lines", "[cut][level_set][ranks]") {
  for (const CellType type :
       {CellType::quadrilateral, CellType::triangle, CellType::hexahedron, CellType::tetrahedron})
    for (const double slope : {0.0, 0.3}) {
      const Mesh mesh = grid(type, {4, 4, 4}, unmoved());
      CutMesh cut(mesh);
      // The plane at 0.5 lies on mesh lines without slope; the body is below it.
      const Surface body =
          level_set_surface(mesh, [&](const double* x) { return x[1] - 0.5 - slope * (x[0] - 0.5); });
      CHECK_FALSE(body.closed);
      cut.cut(std::span(&body, 1));
      check_closure(cut);
      CHECK(owned_fluid(cut) == Approx(0.5).epsilon(1e-12));
    }
}

TEST_CASE("Circles and spheres from level sets converge with the mesh", "[cut][level_set][ranks]") {
  for (const CellType type : {CellType::quadrilateral, CellType::hexahedron})
    for (const double radius : {0.3, 0.6}) {  // inside the mesh, and through its boundary
      std::vector<double> error;
      const bool plane = type == CellType::quadrilateral;
      for (const int n : {6, 12, 24}) {
        const Mesh mesh = grid(type, {n, n, n}, unmoved());
        CutMesh cut(mesh);
        const Surface body = level_set_surface(mesh, [&](const double* x) {
          double square = -radius * radius;
          for (int i = 0; i < (plane ? 2 : 3); ++i) square += std::pow(x[i] - (radius > 0.5 ? 0 : 0.5), 2);
          return square;
        });
        CHECK(body.closed == (radius < 0.5));
        cut.cut(std::span(&body, 1));
        const double pi = std::numbers::pi,
                     whole = plane ? pi * radius * radius : 4 * pi / 3 * std::pow(radius, 3);
        error.push_back(std::abs(1 - owned_fluid(cut) - whole * (radius < 0.5 ? 1 : plane ? 0.25 : 0.125)));
      }
      INFO(radius << ": " << error[0] << ", " << error[1] << ", " << error[2]);
      CHECK(error[2] < error[0] / 10);  // second order would be 16
      CHECK(error[2] < 2e-3);
    }
}

TEST_CASE("A level set that is not finite is refused", "[cut][level_set]") {
  const Mesh mesh = grid(CellType::quadrilateral, {2, 2, 0}, unmoved());
  CHECK_THROWS_WITH(level_set_surface(mesh, [](const double* x) { return 1 / x[0]; }),
                    Catch::Contains("the level set is inf at (0, 0)"));
}
