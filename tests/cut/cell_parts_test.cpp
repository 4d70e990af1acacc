// SPDX-License-Identifier: BSD-3-Clause
// Several connected parts of the fluid in one cell.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "cut/cut_test.hpp"

using namespace seam;

namespace {

/// A plate across the whole unit square or cube, in direction `dimension - 1` at a height that grows along
/// the other axes.
Surface plate(int dimension, double height, double slope, double thickness) {
  const double reach = 0.2;
  const auto lifted = [&](const Point& x) {
    Point result = x;
    result[dimension - 1] += slope * (x[0] + (dimension == 3 ? 0.7 * x[1] : 0.0));
    return result;
  };
  if (dimension == 2)
    return moved(polygon({{-reach, height, 0},
                          {1 + reach, height, 0},
                          {1 + reach, height + thickness, 0},
                          {-reach, height + thickness, 0}}),
                 lifted);
  return moved(box({-reach, -reach, height}, {1 + reach, 1 + reach, height + thickness}), lifted);
}

/// Volume, closure of the boundary and rules of all parts of all cells.
void check_parts(const CutMesh& cut) {
  const Mesh& mesh = cut.mesh();
  const auto dim = static_cast<std::size_t>(mesh.dimension());
  const CellTopology& shape = topology(mesh.type());
  CutRule rule;
  InterfaceRule interface;
  for (const int c : cut.cut_cells()) {
    const double size = std::pow(cut.cell_volume(c), 1.0 / static_cast<double>(dim));
    double volume = 0, area = 0;
    for (int p = 0; p < cut.parts(c); ++p) {
      volume += cut.wet_volume(c, p);
      area += cut.interface_area(c, p);
      cut.volume_rule(c, 2, rule, p);
      double sum = 0;
      for (const double w : rule.weight) sum += w;
      CHECK(std::abs(sum - cut.wet_volume(c, p)) < 1e-12 * cut.cell_volume(c));
      // The vector areas of interface and fluid faces of the part add up to zero.
      std::array<double, 3> closure{};
      cut.interface_rule(c, 1, interface, nullptr, p);
      for (int q = 0; q < interface.count(); ++q)
        for (std::size_t d = 0; d < dim; ++d)
          closure[d] += interface.weight[q] * interface.normal[q * dim + d];
      for (int f = 0; f < static_cast<int>(shape.faces.size()); ++f) {
        cut.face_rule(c, f, 1, rule, p);
        const double* x[3] = {};
        for (std::size_t k = 0; k < dim; ++k)
          x[k] = mesh.geometry(c) + static_cast<std::size_t>(shape.faces[f][k]) * dim;
        Point normal{x[1][1] - x[0][1], x[0][0] - x[1][0], 0};
        if (dim == 3)
          for (int d = 0; d < 3; ++d) {
            const int e = (d + 1) % 3, g = (d + 2) % 3;
            normal[d] = (x[1][e] - x[0][e]) * (x[2][g] - x[0][g]) - (x[1][g] - x[0][g]) * (x[2][e] - x[0][e]);
          }
        const double length = std::hypot(normal[0], normal[1], normal[2]);
        for (const double w : rule.weight)
          for (std::size_t d = 0; d < dim; ++d) closure[d] += w * normal[d] / length;
      }
      for (const double x : closure) CHECK(std::abs(x) < 1e-11 * std::pow(size, dim - 1));
    }
    CHECK(std::abs(volume - cut.wet_volume(c)) < 1e-12 * cut.cell_volume(c));
    CHECK(area == Approx(cut.interface_area(c)).epsilon(1e-11));
  }
}

/// Volume on either side of a plate, over owned cells, by walking from part to part across faces.
std::vector<double> volumes_by_walking(const CutMesh& cut) {
  const Mesh& mesh = cut.mesh();
  const int faces = static_cast<int>(topology(mesh.type()).faces.size());
  std::map<std::pair<int, int>, int> seen;  // (cell, part) -> region
  std::vector<double> volume;
  for (int start = 0; start < mesh.cells(); ++start)
    for (int p = 0; p < cut.parts(start); ++p) {
      if (cut.state(start) == CellState::body || seen.contains({start, p})) continue;
      const int region = static_cast<int>(volume.size());
      volume.push_back(0);
      std::vector<std::pair<int, int>> front{{start, p}};
      seen[{start, p}] = region;
      while (!front.empty()) {
        const auto [c, part] = front.back();
        front.pop_back();
        volume[region] += cut.state(c) == CellState::cut ? cut.wet_volume(c, part) : whole_volume(mesh, c);
        for (int f = 0; f < faces; ++f)
          for (const auto& [own, other] : cut.joined(c, f))
            if (own == part && seen.emplace(std::pair(cut.neighbour(c, f), other), region).second)
              front.emplace_back(cut.neighbour(c, f), other);
      }
    }
  return volume;
}

}  // namespace

TEST_CASE("A thin plate parts the cells it passes through, wherever it lies", "[cut][parts_of_cells]") {
  for (const CellType type :
       {CellType::quadrilateral, CellType::triangle, CellType::hexahedron, CellType::tetrahedron}) {
    const int n = type == CellType::quadrilateral || type == CellType::triangle ? 6 : 4;
    const int dim = n == 6 ? 2 : 3;
    const Mesh mesh = grid(type, {n, n, n}, unmoved());
    CutMesh cut(mesh);
    // Among the heights are those at which a side of the plate coincides with faces of cells.
    for (const double height : {0.5, 0.5 - 0.03, 0.41, 0.31, 0.5 - 1e-9, 0.47 + 1e-13})
      for (const double slope : {0.0, 0.05, 0.2})
        for (const double thickness : {0.03, 1e-6}) {
          CAPTURE(name(type), height, slope, thickness);
          const Surface body = plate(dim, height, slope, thickness);
          cut.cut(std::span(&body, 1));
          CHECK(cut.parts(cut.cut_cells()[0]) == 1);
          cut.separate_parts();
          check_parts(cut);
          auto volume = volumes_by_walking(cut);
          REQUIRE(volume.size() == 2);
          if (volume[0] > volume[1]) std::swap(volume[0], volume[1]);
          // Over the unit square and cube the mean height is that in the middle.
          const double below = height + slope * (dim == 2 ? 0.5 : 0.85), above = 1 - below - thickness;
          CHECK(volume[0] == Approx(std::min(below, above)).epsilon(1e-11));
          CHECK(volume[1] == Approx(std::max(below, above)).epsilon(1e-11));
        }
  }
}

TEST_CASE("A hole in a cell does not part it, and fluid joins round the edge of a plate",
          "[cut][parts_of_cells]") {
  for (const CellType type : {CellType::quadrilateral, CellType::hexahedron}) {
    const Mesh mesh = grid(type, {4, 4, 4}, unmoved());
    CutMesh cut(mesh);
    const bool flat = type == CellType::quadrilateral;
    const std::vector<Surface> bodies{
        flat ? circle({0.375, 0.375, 0}, 0.06, 9) : box({0.3, 0.3, 0.3}, {0.4, 0.4, 0.4}),
        flat ? polygon({{0.3, 0.61, 0}, {0.9, 0.61, 0}, {0.9, 0.62, 0}, {0.3, 0.62, 0}})
             : box({0.3, 0.1, 0.61}, {0.9, 0.9, 0.62})};
    cut.cut(bodies);
    cut.separate_parts();
    check_parts(cut);
    CHECK(volumes_by_walking(cut).size() == 1);
    int parted = 0;
    for (const int c : cut.cut_cells()) parted += cut.parts(c) > 1 ? 1 : 0;
    // Only where the plate passes right through: cells between 0.5 and 0.75 in x, in space between 0.25 and
    // 0.75 in y.
    CHECK(parted == (flat ? 1 : 2));
  }
}

TEST_CASE("Parts of cells join through what is far narrower than a cell", "[cut][parts_of_cells]") {
  // Between two plates; the diagonals of their sides lie in those of cells.
  for (const CellType type : {CellType::quadrilateral, CellType::hexahedron}) {
    const int dim = type == CellType::quadrilateral ? 2 : 3;
    const Mesh mesh = grid(type, {4, 4, 4}, unmoved());
    CutMesh cut(mesh);
    for (double gap = 1e-11; gap < 1e-2; gap *= 1.7) {
      CAPTURE(name(type), gap * 1e12);
      cut.cut(std::vector{plate(dim, 0.53, 0, 0.05), plate(dim, 0.58 + gap, 0, 0.05)});
      cut.separate_parts();
      auto volume = volumes_by_walking(cut);
      REQUIRE(volume.size() == 3);
      CHECK(*std::min_element(volume.begin(), volume.end()) / gap == Approx(1).epsilon(1e-3));
    }
  }
}
