// SPDX-License-Identifier: BSD-3-Clause
// The fluid part as polygons and polyhedra.
#include <catch2/catch.hpp>

#include "cut/cut_test.hpp"

using namespace seam;

namespace {

/// Area, or volume by the flux of the position through the faces.
double enclosed(const WetShape& shape, int dimension) {
  double sum = 0;
  for (int p = 0; p < shape.count(); ++p) {
    const auto at = [&](int k) { return &shape.points[(shape.first[p] + k) * dimension]; };
    const int n = shape.first[p + 1] - shape.first[p];
    if (dimension == 2)
      for (int k = 0; k < n; ++k)
        sum += 0.5 * (at(k)[0] * at((k + 1) % n)[1] - at(k)[1] * at((k + 1) % n)[0]);
    else
      for (int k = 1; k + 1 < n; ++k) {
        const double *a = at(0), *b = at(k), *c = at(k + 1);
        sum += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                a[2] * (b[0] * c[1] - b[1] * c[0])) /
               6;
      }
  }
  return sum;
}

/// Sum of the simplices' volumes; none of them may be turned inside out.
double add_up(const std::vector<double>& corners, int dimension, double cell_volume) {
  const int stride = dimension * (dimension + 1);
  double sum = 0;
  for (std::size_t s = 0; s < corners.size(); s += stride) {
    double e[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}};
    for (int k = 0; k < dimension; ++k)
      for (int d = 0; d < dimension; ++d) e[k][d] = corners[s + (k + 1) * dimension + d] - corners[s + d];
    const double volume = (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
                           e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
                           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
                          (dimension == 2 ? 2 : 6);
    CHECK(volume > -1e-13 * cell_volume);
    sum += volume;
  }
  return sum;
}

void check_shapes(const CutMesh& cut) {
  WetShape shape;
  std::vector<double> simplices;
  for (const int c : cut.cut_cells()) {
    cut.wet_shape(c, shape);
    CHECK(enclosed(shape, cut.mesh().dimension()) ==
          Approx(cut.wet_volume(c)).epsilon(0).margin(1e-12 * cut.cell_volume(c)));
    cut.wet_simplices(c, simplices);
    CHECK(add_up(simplices, cut.mesh().dimension(), cut.cell_volume(c)) ==
          Approx(cut.wet_volume(c)).epsilon(0).margin(1e-11 * cut.cell_volume(c)));
  }
}

}  // namespace

TEST_CASE("The shapes of the fluid parts enclose their volumes", "[cut][shape]") {
  std::mt19937 random(2);
  for (const CellType type : {CellType::quadrilateral, CellType::triangle}) {
    const Mesh mesh = grid(type, {6, 6, 0}, rotated(2, 0.2, {1, 1, 1}, {0, 0, 0}));
    CutMesh cut(mesh);
    for (int k = 0; k < 20; ++k) {
      cut.cut(std::vector{star(random, {0.5, 0.6, 0}, 0.4, 9), star(random, {0.2, 0.6, 0}, 0.4, 9),
                          star(random, {0.5, 1.0, 0}, 0.01, 5)});
      check_shapes(cut);
    }
  }
  for (const CellType type : {CellType::hexahedron, CellType::tetrahedron}) {
    const Mesh mesh = grid(type, {4, 4, 4}, rotated(3, 0.2, {1, 1, 1}, {0, 0, 0}));
    CutMesh cut(mesh);
    for (int k = 0; k < 5; ++k) {
      cut.cut(std::vector{sphere({0.5 + 0.01 * k, 0.5, 0.5}, 0.3, 2),
                          sphere({0.2, 0.5, 0.7 + 0.003 * k}, 0.3, 1),
                          sphere({0.8, 0.3 + 0.01 * k, 0.6}, 0.02, 0)});
      check_shapes(cut);
    }
  }
}
