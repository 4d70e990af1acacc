// SPDX-License-Identifier: BSD-3-Clause
#include "seam/mesh/cell_type.hpp"

#include <array>
#include <catch2/catch.hpp>

using namespace seam;

namespace {

const std::array all = {CellType::point,         CellType::segment,     CellType::triangle,
                        CellType::quadrilateral, CellType::tetrahedron, CellType::hexahedron};

std::array<double, 3> place(const CellTopology& t, int node) {
  std::array<double, 3> x{};
  for (int i = 0; i < t.dimension; ++i) x[i] = t.node_coordinates[node * t.dimension + i];
  return x;
}

std::array<double, 3> minus(std::array<double, 3> a, const std::array<double, 3>& b) {
  for (int i = 0; i < 3; ++i) a[i] -= b[i];
  return a;
}

}  // namespace

TEST_CASE("A cell type has as many nodes as its Lagrange elements") {
  const std::array<int, 6> first = {1, 2, 3, 4, 4, 8}, second = {1, 3, 6, 9, 10, 27};
  for (std::size_t i = 0; i < all.size(); ++i) {
    CHECK(topology(all[i]).type == all[i]);
    CHECK(topology(all[i]).nodes(1) == first[i]);
    CHECK(topology(all[i]).nodes(2) == second[i]);
    CHECK_THROWS_AS(topology(all[i]).nodes(3), std::logic_error);
  }
  CHECK(name(CellType::hexahedron) == "hexahedron");
}

TEST_CASE("Nodes of order 2 behind the vertices sit in the middle of the edges") {
  for (const CellType type : all) {
    const CellTopology& t = topology(type);
    for (std::size_t e = 0; e < t.edges.size(); ++e) {
      const auto a = place(t, t.edges[e][0]), b = place(t, t.edges[e][1]);
      const auto middle = place(t, t.vertices + static_cast<int>(e));
      for (int i = 0; i < 3; ++i) CHECK(middle[i] == 0.5 * (a[i] + b[i]));
    }
  }
}

TEST_CASE("Nodes of order 2 on a face lie where the face's own element has them") {
  for (const CellType type : all) {
    const CellTopology& t = topology(type);
    const CellTopology& face = topology(t.face_type);
    REQUIRE(t.faces.size() == t.face_nodes.size());
    for (std::size_t f = 0; f < t.faces.size(); ++f) {
      const auto& nodes = t.face_nodes[f];
      REQUIRE(static_cast<int>(nodes.size()) == face.nodes(2));
      REQUIRE(static_cast<int>(t.faces[f].size()) == face.vertices);
      // Faces are flat and their maps affine: vertex 0, and the vertices next to it along the axes.
      const auto origin = place(t, t.faces[f][0]);
      for (int a = 0; a < face.nodes(2); ++a) {
        std::array<double, 3> expected = origin;
        for (int k = 0; k < face.dimension; ++k) {
          const int next = k == 0 ? 1 : face.vertices - 1;
          const auto axis = minus(place(t, t.faces[f][next]), origin);
          for (int i = 0; i < 3; ++i) expected[i] += face.node_coordinates[a * face.dimension + k] * axis[i];
        }
        for (int i = 0; i < 3; ++i) CHECK(place(t, nodes[a])[i] == expected[i]);
      }
    }
  }
}

TEST_CASE("Faces point outward") {
  for (const CellType type : all) {
    const CellTopology& t = topology(type);
    if (t.dimension < 2) continue;
    std::array<double, 3> centre{};
    for (int v = 0; v < t.vertices; ++v)
      for (int i = 0; i < 3; ++i) centre[i] += place(t, v)[i] / t.vertices;
    for (const auto& face : t.faces) {
      const auto origin = place(t, face[0]), along = minus(place(t, face[1]), origin);
      const auto up = t.dimension == 2 ? std::array<double, 3>{0, 0, 1} : minus(place(t, face[2]), origin);
      const auto out = minus(origin, centre);
      double product = 0;
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        product += (along[j] * up[k] - along[k] * up[j]) * out[i];
      }
      CHECK(product > 0);
    }
  }
}

TEST_CASE("The hexahedron's face midpoints are in VTK's order") {
  const CellTopology& t = topology(CellType::hexahedron);
  const std::array<std::array<double, 3>, 7> expected = {
      {{0, .5, .5}, {1, .5, .5}, {.5, 0, .5}, {.5, 1, .5}, {.5, .5, 0}, {.5, .5, 1}, {.5, .5, .5}}};
  for (int i = 0; i < 7; ++i) CHECK(place(t, 20 + i) == expected[i]);
}
