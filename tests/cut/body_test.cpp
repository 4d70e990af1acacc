// SPDX-License-Identifier: BSD-3-Clause
// Boundaries of meshes as surfaces of bodies.
#include "seam/surface/body.hpp"

#include <catch2/catch.hpp>

#include "seam/mesh/input/grid.hpp"

namespace {

using namespace seam;

/// Twice (2D) or six times (3D) the enclosed volume, by the divergence theorem.
double enclosed(const Surface& s) {
  double sum = 0;
  for (int f = 0; f < s.facet_count(); ++f) {
    const auto x = [&](int a, int d) { return s.points[s.facets[f * s.dimension + a] * s.dimension + d]; };
    if (s.dimension == 2) {
      sum += x(0, 0) * x(1, 1) - x(0, 1) * x(1, 0);
    } else {
      for (int d = 0; d < 3; ++d) {
        const int e = (d + 1) % 3, g = (d + 2) % 3;
        sum += x(0, d) * (x(1, e) * x(2, g) - x(1, g) * x(2, e));
      }
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("the boundary of a mesh encloses the mesh, with its normal outward") {
  const CellType cell =
      GENERATE(CellType::triangle, CellType::quadrilateral, CellType::tetrahedron, CellType::hexahedron);
  const int order = GENERATE(1, 2);
  Grid grid;
  grid.cell = cell;
  grid.order = order;
  for (auto& lines : grid.lines) lines = graded_lines(-0.5, 1.0, 3);
  const Surface surface = body_boundary(make_grid(grid), {}).surface;
  const bool flat = surface.dimension == 2;
  CHECK(enclosed(surface) == Approx(flat ? 2 * 2.25 : 6 * 3.375).epsilon(1e-13));
}
