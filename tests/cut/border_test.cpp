// SPDX-License-Identifier: BSD-3-Clause
// Bodies whose sides lie in the border of the mesh.
#include <catch2/catch.hpp>
#include <cmath>

#include "cut/cut_test.hpp"

using namespace seam;

TEST_CASE("A body flush with the border of the mesh touches no fluid there", "[cut]") {
  const CellType type =
      GENERATE(CellType::quadrilateral, CellType::triangle, CellType::hexahedron, CellType::tetrahedron);
  const int dim = type == CellType::quadrilateral || type == CellType::triangle ? 2 : 3;
  const Mesh mesh = grid(type, {4, 4, dim == 3 ? 4 : 1}, unmoved());
  // Exactly on it, and as far off as rounding leaves a body.
  const double off = GENERATE(0.0, 1e-12);
  for (int axis = 0; axis < dim; ++axis)
    for (const bool high : {false, true}) {
      Point from{0.33, 0.33, 0.33}, to{0.71, 0.71, 0.71};
      (high ? to : from)[axis] = high ? 1 - off : off;
      const Surface body =
          dim == 3 ? box(from, to) : polygon({from, {to[0], from[1], 0}, to, {from[0], to[1], 0}});
      CutMesh cut(mesh);
      cut.cut(std::array{body});
      check_closure(cut);
      const double side = to[axis] - from[axis], end = std::pow(0.38, dim - 1);
      CHECK(total_fluid(cut) == Approx(1 - side * end).epsilon(1e-9));
      CHECK(total_interface(cut) == Approx((dim == 2 ? 2 * side : 4 * side * 0.38) + end).epsilon(1e-9));
    }
}
