// SPDX-License-Identifier: BSD-3-Clause
// Cuts in the plane.
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <numbers>

#include "cut/cut_test.hpp"
#include "cut/polygon_integral.hpp"

using namespace seam;

namespace {

Placement bent(double by) {
  return [by](const Point& x) {
    return Point{x[0] + by * std::sin(3 * x[1]), x[1] + by * std::sin(2 * x[0] + 0.5), x[2]};
  };
}

/// Largest error of the integrals of monomials of an affine cell's coordinates, relative to its area.
double monomial_error(const CutMesh& cut, const Surface& body, int cell, int degree) {
  const Mesh& mesh = cut.mesh();
  const double* x = mesh.geometry(cell);
  const int last = mesh.type() == CellType::triangle ? 2 : 3;
  const Precise a[2] = {x[2] - Precise(x[0]), x[3] - Precise(x[1])};
  const Precise b[2] = {x[2 * last] - Precise(x[0]), x[2 * last + 1] - Precise(x[1])};
  const Precise determinant = a[0] * b[1] - a[1] * b[0];
  std::vector<PlanePoint> covered;
  for (int v = 0; v < body.point_count(); ++v) {
    const Precise dx = body.points[2 * v] - Precise(x[0]), dy = body.points[2 * v + 1] - Precise(x[1]);
    covered.push_back({(dx * b[1] - dy * b[0]) / determinant, (a[0] * dy - a[1] * dx) / determinant});
  }
  std::vector<PlanePoint> whole{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  if (mesh.type() == CellType::triangle) whole = {{0, 0}, {1, 0}, {0, 1}};
  for (std::size_t k = 0; k < whole.size(); ++k)
    covered = left_of(covered, whole[k], whole[(k + 1) % whole.size()]);
  CutRule rule;
  cut.volume_rule(cell, degree, rule);
  double worst = 0;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; j <= degree; ++j) {
      const Precise exact = determinant * (monomial_integral(whole, i, j) - monomial_integral(covered, i, j));
      double sum = 0;
      for (int q = 0; q < rule.count(); ++q)
        sum += rule.weight[q] * std::pow(rule.reference[2 * q], i) * std::pow(rule.reference[2 * q + 1], j);
      worst = std::max(worst, static_cast<double>(std::abs(sum - exact) / determinant));
    }
  return worst;
}

std::vector<Mesh> plane_meshes() {
  std::vector<Mesh> meshes;
  for (const CellType type : {CellType::quadrilateral, CellType::triangle}) {
    meshes.push_back(grid(type, {7, 6, 0}, unmoved()));
    meshes.push_back(grid(type, {7, 6, 0}, rotated(2, 0.3, {1.2, 0.8, 1}, {3, -2, 0})));
    meshes.push_back(grid(type, {7, 6, 0}, bent(0.1)));
    meshes.push_back(grid(type, {7, 6, 0}, bent(0.1), 2));
    meshes.push_back(grid(type, {7, 6, 0}, unmoved(), 2));
  }
  return meshes;
}

/// A point of the mesh's domain near the given fractions of its box.
Point place_in(const Mesh& mesh, double s, double t) {
  const auto& x = mesh.whole().coordinates;
  Point low{1e9, 1e9, 0}, high{-1e9, -1e9, 0};
  for (std::size_t k = 0; k < x.size(); ++k) {
    low[k % 2] = std::min(low[k % 2], x[k]);
    high[k % 2] = std::max(high[k % 2], x[k]);
  }
  return {low[0] + s * (high[0] - low[0]), low[1] + t * (high[1] - low[1]), 0};
}

}  // namespace

TEST_CASE("A circle is cut out of a grid of quadrilaterals", "[cut][plane]") {
  const Mesh mesh = grid(CellType::quadrilateral, {20, 20, 0}, unmoved());
  CutMesh cut(mesh);
  const Surface body = circle({0.5, 0.48, 0}, 0.3, 100);
  cut.cut(std::span(&body, 1));
  const double n = 100, area = 0.5 * n * 0.09 * std::sin(2 * std::numbers::pi / n);
  CHECK(total_fluid(cut) == Approx(1 - area).epsilon(1e-13));
  CHECK(total_interface(cut) == Approx(2 * n * 0.3 * std::sin(std::numbers::pi / n)).epsilon(1e-13));
  CHECK(check_closure(cut) > 30);
}

TEST_CASE("Random outlines in the plane: fluid and body add up, boundaries close", "[cut][plane]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  long cuts = 0;
  for (const Mesh& mesh : plane_meshes()) {
    CutMesh cut(mesh), complement(mesh);
    for (int k = 0; k < 450 * effort(); ++k) {
      const double radius = std::pow(10.0, -1.5 * unit(random)) * 0.6;
      const Surface body =
          star(random, place_in(mesh, unit(random), unit(random)), radius, 3 + random() % 20);
      const Surface inverse = reversed(body);
      cut.cut(std::span(&body, 1));
      complement.cut(std::span(&inverse, 1));
      cuts += check_closure(cut) + check_closure(complement);
      check_complement(cut, complement);
    }
  }
  CHECK(cuts > 40000 * effort());
}

TEST_CASE("Monomials are integrated exactly over cut affine cells of the plane", "[cut][plane]") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  double worst = 0;
  int cells = 0;
  for (const CellType type : {CellType::quadrilateral, CellType::triangle}) {
    const Mesh mesh = grid(type, {5, 4, 0}, rotated(2, 0.3, {1.2, 0.8, 1}, {3, -2, 0}));
    CutMesh cut(mesh);
    for (int k = 0; k < 40; ++k) {
      const Surface body =
          star(random, place_in(mesh, unit(random), unit(random)), 0.5 * unit(random), 3 + random() % 9);
      cut.cut(std::span(&body, 1));
      for (const int c : cut.cut_cells()) {
        worst = std::max({worst, monomial_error(cut, body, c, 3), monomial_error(cut, body, c, 6)});
        ++cells;
      }
    }
  }
  INFO(cells << " cells");
  CHECK(worst < 1e-12);
}

TEST_CASE("A wall on mesh lines, moved by steps from 1e-16 to 1e-1 of a cell", "[cut][plane]") {
  const double h = 1.0 / 8;
  long cuts = 0;
  for (const CellType type : {CellType::quadrilateral, CellType::triangle}) {
    const Mesh mesh = grid(type, {8, 8, 0}, unmoved());
    CutMesh cut(mesh), complement(mesh);
    for (const Point direction :
         {Point{1, 0, 0}, Point{0, 1, 0}, Point{1, 1, 0}, Point{-1, 0.3, 0}, Point{0, -1, 0}})
      for (int exponent = -160; exponent <= -10; ++exponent) {
        const double step = std::pow(10.0, exponent / 10.0) * h;
        std::vector<Point> corners;
        for (const Point& p :
             {Point{2 * h, 3 * h, 0}, Point{5 * h, 3 * h, 0}, Point{5 * h, 6 * h, 0}, Point{2 * h, 6 * h, 0}})
          corners.push_back({p[0] + step * direction[0], p[1] + step * direction[1], 0});
        const Surface body = polygon(corners), inverse = reversed(body);
        cut.cut(std::span(&body, 1));
        complement.cut(std::span(&inverse, 1));
        cuts += check_closure(cut) + check_closure(complement);
        check_complement(cut, complement);
        // Everything is on one side or the other: nothing is lost and nothing counted twice. A corner of
        // 1e-11 of a cell that is not kept has sides of up to 1e-5 of the cell's.
        CHECK(std::abs(total_interface(cut) - 12 * h) < 4e-5 * h);
        CHECK(std::abs(total_fluid(cut) - (1 - 9 * h * h)) < 12 * 2e-11 * h * h);
      }
  }
  CHECK(cuts > 35000);
}

TEST_CASE("A wall exactly on mesh lines belongs to the cells on the fluid side", "[cut][plane]") {
  const double h = 1.0 / 8;
  const Mesh mesh = grid(CellType::quadrilateral, {8, 8, 0}, unmoved());
  CutMesh cut(mesh);
  const Surface body = polygon({{2 * h, 3 * h, 0}, {5 * h, 3 * h, 0}, {5 * h, 6 * h, 0}, {2 * h, 6 * h, 0}});
  for (const Surface& s : {body, reversed(body)}) {
    cut.cut(std::span(&s, 1));
    const bool inside = &s != &body && total_fluid(cut) < 0.5;
    // Around the square 12 cells touch it with a whole side; inside 8 do, its corners with two.
    CHECK(static_cast<int>(cut.cut_cells().size()) == (inside ? 8 : 12));
    InterfaceRule rule;
    for (const int c : cut.cut_cells()) {
      CHECK(cut.wet_volume(c) == Approx(h * h).epsilon(1e-13));
      const double sides = cut.interface_area(c) / h;
      CHECK(std::abs(sides - std::round(sides)) < 1e-13);
      cut.interface_rule(c, 2, rule);
      for (int q = 0; q < rule.count(); ++q)
        for (int i = 0; i < 2; ++i) {
          CHECK(rule.reference[2 * q + i] >= 0);
          CHECK(rule.reference[2 * q + i] <= 1);
        }
    }
  }
}

TEST_CASE("Interface points know their cell, their facet and both coordinates", "[cut][plane]") {
  for (const Mesh& mesh : plane_meshes()) {
    CutMesh cut(mesh);
    const Point centre = place_in(mesh, 0.5, 0.5);
    const Surface body = circle(centre, 0.23, 17);
    cut.cut(std::span(&body, 1));
    InterfaceRule rule;
    double length = 0, flux = 0;
    for (const int c : cut.cut_cells()) {
      cut.interface_rule(c, 3, rule);
      for (int q = 0; q < rule.count(); ++q) {
        const double* p = &body.points[2 * body.facets[2 * rule.facet[q]]];
        const double* r = &body.points[2 * body.facets[2 * rule.facet[q] + 1]];
        const Point x = position(mesh, c, &rule.reference[2 * q]);
        for (int i = 0; i < 2; ++i) {
          CHECK(x[i] == Approx(rule.position[2 * q + i]).epsilon(0).margin(1e-13));
          CHECK(p[i] + rule.facet_reference[q] * (r[i] - p[i]) == Approx(x[i]).epsilon(0).margin(1e-13));
          flux += rule.weight[q] * rule.normal[2 * q + i] * (x[i] - centre[i]);
        }
        length += rule.weight[q];
      }
    }
    const double half = std::numbers::pi / 17;
    CHECK(length == Approx(2 * 17 * 0.23 * std::sin(half)).epsilon(1e-12));
    // The normal points into the body: the flux of the position is minus twice its area.
    CHECK(flux == Approx(-17 * 0.23 * 0.23 * std::sin(2 * half)).epsilon(1e-12));
  }
}

TEST_CASE("The fluid part follows a moving body continuously", "[cut][plane]") {
  std::mt19937 random(5);
  const Mesh mesh = grid(CellType::quadrilateral, {6, 6, 0}, rotated(2, 0.2, {1, 1, 1}, {0, 0, 0}));
  CutMesh cut(mesh);
  const Surface body = star(random, {0.4, 0.6, 0}, 0.3, 9);
  const double step = 1e-5, length = 2.5;  // of the outline, at most
  std::vector<double> before;
  for (int k = 0; k < 2000; ++k) {
    const Surface now = moved(body, [&](const Point& x) {
      return Point{x[0] + k * step, x[1] - 0.5 * k * step, 0};
    });
    cut.cut(std::span(&now, 1));
    std::vector<double> fluid;
    for (int c = 0; c < mesh.cells(); ++c)
      fluid.push_back(cut.state(c) == CellState::cut    ? cut.wet_volume(c)
                      : cut.state(c) == CellState::body ? 0.0
                                                        : whole_volume(mesh, c));
    for (std::size_t c = 0; c < before.size(); ++c)
      CHECK(std::abs(fluid[c] - before[c]) <= length * 1.2 * step);
    before = fluid;
  }
}

TEST_CASE("1000 facets cut 776 of 100,000 cells; how fast is a benchmark's business", "[cut][plane]") {
  const Mesh mesh = grid(CellType::quadrilateral, {400, 250, 0}, unmoved());
  CutMesh cut(mesh);
  const Surface body = circle({0.5, 0.48, 0}, 0.3, 1000);
  cut.cut(std::span(&body, 1));
  CHECK(cut.cut_cells().size() == 776);
}

TEST_CASE("Cutting 100,000 cells with 1000 facets", "[.speed]") {
  const Mesh mesh = grid(CellType::quadrilateral, {400, 250, 0}, unmoved());
  CutMesh cut(mesh);
  const Surface body = circle({0.5, 0.48, 0}, 0.3, 1000);
  const auto start = std::chrono::steady_clock::now();
  cut.cut(std::span(&body, 1));
  CutRule rule;
  InterfaceRule interface;
  for (const int c : cut.cut_cells()) {
    cut.volume_rule(c, 3, rule);
    cut.interface_rule(c, 3, interface);
    for (int f = 0; f < 4; ++f) cut.face_rule(c, f, 3, rule);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  WARN(seconds << " s for " << cut.cut_cells().size() << " cut cells");
}
