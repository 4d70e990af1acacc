// SPDX-License-Identifier: BSD-3-Clause
// Cuts in space.
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <numbers>

#include "cut/cut_test.hpp"
#include "seam/mesh/quadrature.hpp"
#include "seam/surface/moving_facet.hpp"

using namespace seam;

namespace {

Placement bent(double by) {
  return [by](const Point& x) {
    return Point{x[0] + by * std::sin(3 * x[1] + x[2]), x[1] + by * std::sin(2 * x[0] + 0.5),
                 x[2] + by * x[0] * x[1]};
  };
}

double volume_of(const Surface& s) {
  double sum = 0;
  for (int f = 0; f < s.facet_count(); ++f) {
    const double *a = &s.points[3 * s.facets[3 * f]], *b = &s.points[3 * s.facets[3 * f + 1]],
                 *c = &s.points[3 * s.facets[3 * f + 2]];
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}

double area_of(const Surface& s) {
  double sum = 0;
  for (int f = 0; f < s.facet_count(); ++f) {
    const double *a = &s.points[3 * s.facets[3 * f]], *b = &s.points[3 * s.facets[3 * f + 1]],
                 *c = &s.points[3 * s.facets[3 * f + 2]];
    double n[3];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      n[i] = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
    }
    sum += 0.5 * std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  }
  return sum;
}

std::vector<Mesh> space_meshes() {
  std::vector<Mesh> meshes;
  for (const CellType type : {CellType::hexahedron, CellType::tetrahedron}) {
    meshes.push_back(grid(type, {4, 3, 4}, unmoved()));
    meshes.push_back(grid(type, {4, 3, 4}, rotated(3, 0.3, {1.2, 0.8, 1}, {3, -2, 1})));
    meshes.push_back(grid(type, {4, 3, 4}, bent(0.1)));
    meshes.push_back(grid(type, {3, 3, 3}, bent(0.1), 2));
  }
  return meshes;
}

Point place_in(const Mesh& mesh, const Point& share) {
  const auto& x = mesh.whole().coordinates;
  Point low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  for (std::size_t k = 0; k < x.size(); ++k) {
    low[k % 3] = std::min(low[k % 3], x[k]);
    high[k % 3] = std::max(high[k % 3], x[k]);
  }
  Point p{};
  for (int i = 0; i < 3; ++i) p[i] = low[i] + share[i] * (high[i] - low[i]);
  return p;
}

/// A sphere with bumps.
Surface rock(std::mt19937& random, const Point& centre, double radius, int refinements) {
  std::uniform_real_distribution<double> unit(0, 1);
  return moved(sphere({0, 0, 0}, radius, refinements), [&](const Point& x) {
    const double s = 0.4 + 0.6 * unit(random);
    return Point{centre[0] + s * x[0], centre[1] + s * x[1], centre[2] + s * x[2]};
  });
}

using Corners = std::array<Point, 4>;

/// Splits tetrahedra by a plane and keeps what lies where normal . x <= offset.
std::vector<Corners> below(const std::vector<Corners>& tetrahedra, const Point& normal, double offset) {
  std::vector<Corners> kept;
  for (const Corners& t : tetrahedra) {
    // Vertices inside first; an odd permutation would turn the tetrahedron inside out.
    std::array<double, 4> height{};
    std::vector<int> in, out;
    for (int v = 0; v < 4; ++v) {
      height[v] = normal[0] * t[v][0] + normal[1] * t[v][1] + normal[2] * t[v][2] - offset;
      (height[v] <= 0 ? in : out).push_back(v);
    }
    const auto cut = [&](int a, int b) {
      const double s = height[a] / (height[a] - height[b]);
      Point p{};
      for (int i = 0; i < 3; ++i) p[i] = t[a][i] + s * (t[b][i] - t[a][i]);
      return p;
    };
    std::vector<int> order = in;
    order.insert(order.end(), out.begin(), out.end());
    int swaps = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) swaps += order[i] > order[j] ? 1 : 0;
    const auto keep = [&](Corners c) {
      if (swaps % 2 != 0) std::swap(c[0], c[1]);
      kept.push_back(c);
    };
    const auto at = [&](int k) { return t[order[k]]; };
    const auto edge = [&](int k, int l) { return cut(order[k], order[l]); };
    if (in.size() == 4) keep({at(0), at(1), at(2), at(3)});
    if (in.size() == 1) keep({at(0), edge(0, 1), edge(0, 2), edge(0, 3)});
    if (in.size() == 2) {
      keep({at(0), at(1), edge(1, 2), edge(1, 3)});
      keep({at(0), edge(0, 2), edge(1, 3), edge(1, 2)});
      keep({at(0), edge(0, 2), edge(0, 3), edge(1, 3)});
    }
    if (in.size() == 3) {
      keep({at(0), at(1), at(2), edge(0, 3)});
      keep({edge(0, 3), at(1), at(2), edge(2, 3)});
      keep({edge(0, 3), at(1), edge(2, 3), edge(1, 3)});
    }
  }
  return kept;
}

/// Six times the signed volume.
double sixfold(const Corners& t) {
  double e[3][3];
  for (int v = 0; v < 3; ++v)
    for (int i = 0; i < 3; ++i) e[v][i] = t[v + 1][i] - t[0][i];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
         e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/// Largest error of the integrals of monomials of an affine cell's coordinates, relative to its volume; the
/// reference clips the cones over the body's facets, tetrahedron by tetrahedron.
double monomial_error(const CutMesh& cut, const Surface& body, int cell, int degree) {
  const Mesh& mesh = cut.mesh();
  const double* x = mesh.geometry(cell);
  const bool simplex = mesh.type() == CellType::tetrahedron;
  const int corner[3] = {1, simplex ? 2 : 3, simplex ? 3 : 4};
  Corners frame{};
  for (int i = 0; i < 3; ++i) {
    frame[0][i] = x[i];
    for (int d = 0; d < 3; ++d) frame[d + 1][i] = x[3 * corner[d] + i];
  }
  const double determinant = sixfold(frame);
  const auto local = [&](const double* p) {
    Point r{};
    for (int d = 0; d < 3; ++d) {
      Corners t = frame;
      for (int i = 0; i < 3; ++i) t[d + 1][i] = p[i];
      r[d] = sixfold(t) / determinant;
    }
    return r;
  };
  const Quadrature& fine = quadrature(CellType::tetrahedron, 3 * degree);
  std::vector<double> exact((degree + 1) * (degree + 1) * (degree + 1), 0.0);
  const auto power = [](double base, int e) { return std::pow(base, e); };
  const auto add = [&](const Point& p, double weight) {
    for (int i = 0, m = 0; i <= degree; ++i)
      for (int j = 0; j <= degree; ++j)
        for (int k = 0; k <= degree; ++k)
          exact[m++] += weight * power(p[0], i) * power(p[1], j) * power(p[2], k);
  };
  const Quadrature& whole = quadrature(mesh.type(), simplex ? 3 * degree : degree);
  for (int q = 0; q < whole.count(); ++q)
    add({whole.points[3 * q], whole.points[3 * q + 1], whole.points[3 * q + 2]},
        whole.weights[q] * determinant);
  const Point apex = local(body.points.data());
  for (int f = 0; f < body.facet_count(); ++f) {
    const int* v = &body.facets[3 * f];
    std::vector<Corners> parts{
        {apex, local(&body.points[3 * v[0]]), local(&body.points[3 * v[1]]), local(&body.points[3 * v[2]])}};
    for (int d = 0; d < 3; ++d) {
      Point n{};
      n[d] = -1;
      parts = below(parts, n, 0);
      n[d] = 1;
      if (!simplex) parts = below(parts, n, 1);
    }
    if (simplex) parts = below(parts, {1, 1, 1}, 1);
    for (const Corners& t : parts)
      for (int q = 0; q < fine.count(); ++q) {
        Point p = t[0];
        for (int d = 0; d < 3; ++d)
          for (int i = 0; i < 3; ++i) p[i] += fine.points[3 * q + d] * (t[d + 1][i] - t[0][i]);
        add(p, -sixfold(t) * fine.weights[q] * determinant);
      }
  }
  CutRule rule;
  cut.volume_rule(cell, degree, rule);
  double worst = 0;
  for (int i = 0, m = 0; i <= degree; ++i)
    for (int j = 0; j <= degree; ++j)
      for (int k = 0; k <= degree; ++k, ++m) {
        double sum = 0;
        for (int q = 0; q < rule.count(); ++q)
          sum += rule.weight[q] * power(rule.reference[3 * q], i) * power(rule.reference[3 * q + 1], j) *
                 power(rule.reference[3 * q + 2], k);
        worst = std::max(worst, std::abs(sum - exact[m]) / determinant);
      }
  return worst;
}

}  // namespace

TEST_CASE("A sphere is cut out of a grid of hexahedra", "[cut][space]") {
  const Mesh mesh = grid(CellType::hexahedron, {9, 9, 9}, unmoved());
  CutMesh cut(mesh);
  const Surface body = sphere({0.5, 0.48, 0.51}, 0.3, 3);
  cut.cut(std::span(&body, 1));
  CHECK(total_fluid(cut) == Approx(1 - volume_of(body)).epsilon(1e-13));
  CHECK(total_interface(cut) == Approx(area_of(body)).epsilon(1e-13));
  CHECK(check_closure(cut) > 100);
}

TEST_CASE("Random bodies in space: fluid and body add up, boundaries close", "[cut][space]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  long cuts = 0;
  for (const Mesh& mesh : space_meshes()) {
    CutMesh cut(mesh), complement(mesh);
    for (int k = 0; k < 80 * effort(); ++k) {
      const double radius = std::pow(10.0, -1.5 * unit(random)) * 0.7;
      const Point centre = place_in(mesh, {unit(random), unit(random), unit(random)});
      const Surface body = rock(random, centre, radius, static_cast<int>(random() % 3)),
                    inverse = reversed(body);
      cut.cut(std::span(&body, 1));
      complement.cut(std::span(&inverse, 1));
      cuts += check_closure(cut) + check_closure(complement);
      check_complement(cut, complement);
    }
  }
  CHECK(cuts > 10000 * effort());
}

TEST_CASE("A box on mesh planes, moved by steps from 1e-16 to 1e-1 of a cell", "[cut][space]") {
  const double h = 1.0 / 5;
  long cuts = 0;
  for (const CellType type : {CellType::hexahedron, CellType::tetrahedron}) {
    const Mesh mesh = grid(type, {5, 5, 5}, unmoved());
    CutMesh cut(mesh), complement(mesh);
    for (const Point direction : {Point{1, 0, 0}, Point{1, 1, 0}, Point{-1, -1, -1}, Point{0.3, -0.7, 0.1}})
      for (int exponent = -160; exponent <= -10; exponent += 5) {
        const double step = std::pow(10.0, exponent / 10.0) * h;
        const auto shift = [&](const Point& p) {
          return Point{p[0] + step * direction[0], p[1] + step * direction[1], p[2] + step * direction[2]};
        };
        const Surface body = moved(box({h, h, h}, {3 * h, 4 * h, 3 * h}), shift), inverse = reversed(body);
        cut.cut(std::span(&body, 1));
        complement.cut(std::span(&inverse, 1));
        cuts += check_closure(cut) + check_closure(complement);
        check_complement(cut, complement);
        INFO(step);
        CHECK(std::abs(total_fluid(cut) - (1 - 12 * h * h * h)) < 100 * 2e-11 * h * h * h);
        // Along an edge a part of 1e-11 of a cell that is not kept has sides of up to 1e-5 of the cell's; 32
        // cells lie along the edges of the box.
        CHECK(std::abs(total_interface(cut) - 32 * h * h) < 32e-5 * h * h);
      }
  }
  CHECK(cuts > 10000);
}

TEST_CASE("Monomials are integrated exactly over cut affine cells in space", "[cut][space]") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  double worst = 0;
  int cells = 0;
  for (const CellType type : {CellType::hexahedron, CellType::tetrahedron}) {
    const Mesh mesh = grid(type, {2, 2, 2}, rotated(3, 0.3, {1.2, 0.8, 1}, {3, -2, 1}));
    CutMesh cut(mesh);
    for (int k = 0; k < 6; ++k) {
      const Surface body = rock(random, place_in(mesh, {unit(random), unit(random), unit(random)}),
                                0.2 + 0.5 * unit(random), k % 2);
      cut.cut(std::span(&body, 1));
      for (const int c : cut.cut_cells()) {
        worst = std::max(worst, monomial_error(cut, body, c, 3));
        ++cells;
      }
    }
  }
  CHECK(cells > 50);
  CHECK(worst < 1e-12);
}

TEST_CASE("Interface points in space know their cell, their facet and both coordinates", "[cut][space]") {
  for (const Mesh& mesh : space_meshes()) {
    CutMesh cut(mesh);
    const Surface body = sphere(place_in(mesh, {0.5, 0.5, 0.5}), 0.23, 2);
    cut.cut(std::span(&body, 1));
    InterfaceRule rule;
    double area = 0, flux = 0;
    for (const int c : cut.cut_cells()) {
      cut.interface_rule(c, 2, rule);
      for (int q = 0; q < rule.count(); ++q) {
        const int* v = &body.facets[3 * rule.facet[q]];
        const double s = rule.facet_reference[2 * q], t = rule.facet_reference[2 * q + 1];
        const Point x = position(mesh, c, &rule.reference[3 * q]);
        for (int i = 0; i < 3; ++i) {
          CHECK(x[i] == Approx(rule.position[3 * q + i]).epsilon(0).margin(1e-13));
          const double a = body.points[3 * v[0] + i], b = body.points[3 * v[1] + i],
                       d = body.points[3 * v[2] + i];
          CHECK(a + s * (b - a) + t * (d - a) == Approx(x[i]).epsilon(0).margin(1e-13));
          flux += rule.weight[q] * rule.normal[3 * q + i] * x[i];
        }
        area += rule.weight[q];
      }
    }
    CHECK(area == Approx(area_of(body)).epsilon(1e-12));
    CHECK(flux == Approx(-3 * volume_of(body)).epsilon(1e-11));
  }
}

TEST_CASE("Cutting a sphere out of 125,000 hexahedra", "[.speed]") {
  const Mesh mesh = grid(CellType::hexahedron, {50, 50, 50}, unmoved());
  const auto start0 = std::chrono::steady_clock::now();
  CutMesh cut(mesh);
  const Surface body = sphere({0.5, 0.48, 0.51}, 0.3, 5);
  const auto start = std::chrono::steady_clock::now();
  cut.cut(std::span(&body, 1));
  const auto middle = std::chrono::steady_clock::now();
  CutRule rule;
  InterfaceRule interface;
  const auto seconds = [](auto d) { return std::chrono::duration<double>(d).count(); };
  double volume = 0, faces = 0, points = 0;
  for (const int c : cut.cut_cells()) {
    auto s = std::chrono::steady_clock::now();
    cut.volume_rule(c, 3, rule);
    volume += seconds(std::chrono::steady_clock::now() - s);
    s = std::chrono::steady_clock::now();
    for (int f = 0; f < 6; ++f) cut.face_rule(c, f, 3, rule);
    faces += seconds(std::chrono::steady_clock::now() - s);
    cut.interface_rule(c, 3, interface);
    points += interface.count();
  }
  WARN("set up " << seconds(start - start0) << " s, cut " << seconds(middle - start) << " s, volume rules "
                 << volume << " s, face rules " << faces << " s, " << cut.cut_cells().size() << " cells, "
                 << points << " points");
}
