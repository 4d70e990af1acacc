// SPDX-License-Identifier: BSD-3-Clause
// Several bodies in the plane, and surfaces that are not closed.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "cut/cut_test.hpp"

using namespace seam;

namespace {

Surface rectangle(double x0, double y0, double x1, double y1) {
  return polygon({{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}});
}

Surface open_line(const std::vector<Point>& points) {
  Surface s = polygon(points);
  s.facets.resize(s.facets.size() - 2);
  s.closed = false;
  return s;
}

}  // namespace

TEST_CASE("The fluid lies outside of all bodies", "[cut][bodies]") {
  const Mesh mesh = grid(CellType::quadrilateral, {9, 7, 0}, unmoved());
  CutMesh cut(mesh);
  struct Case {
    const char* name;
    std::vector<Surface> bodies;
    double body, interface;
  };
  const std::vector<Case> cases{
      {"apart", {rectangle(.1, .1, .3, .3), rectangle(.5, .5, .6, .7)}, .06, 1.4},
      {"overlapping", {rectangle(.1, .1, .5, .5), rectangle(.3, .3, .7, .8)}, .32, 1.6 + 1.8 - .8},
      {"touching along a side", {rectangle(.1, .1, .3, .3), rectangle(.3, .1, .5, .3)}, .08, 1.2},
      {"touching along a part of a side",
       {rectangle(.1, .1, .3, .3), rectangle(.3, .2, .5, .5)},
       .10,
       1.8 - .2},
      {"touching in a corner", {rectangle(.1, .1, .3, .3), rectangle(.3, .3, .5, .5)}, .08, 1.6},
      {"one inside the other", {rectangle(.1, .1, .9, .9), rectangle(.3, .3, .5, .5)}, .64, 3.2},
      {"the same twice", {rectangle(.1, .1, .3, .3), rectangle(.1, .1, .3, .3)}, .04, .8},
      {"filling a hole", {reversed(rectangle(.2, .2, .8, .8)), rectangle(.2, .2, .5, .8)}, 1 - .18, 1.8},
      {"crossing itself",
       {polygon({{.1, .1, 0},
                 {.7, .1, 0},
                 {.7, .5, 0},
                 {.3, .5, 0},
                 {.3, .3, 0},
                 {.5, .3, 0},
                 {.5, .7, 0},
                 {.1, .7, 0}})},
       // The loop winds twice round a square of 0.2 by 0.2 and encloses no hole.
       .6 * .4 + .4 * .2,
       2.4},
  };
  for (const Case& c : cases) {
    INFO(c.name);
    cut.cut(c.bodies);
    check_closure(cut);
    CHECK(total_fluid(cut) == Approx(1 - c.body).epsilon(1e-12));
    CHECK(total_interface(cut) == Approx(c.interface).epsilon(1e-12));
  }
}

TEST_CASE("What a part of a surface turned inside out encloses is no body", "[cut][bodies]") {
  // As where cells of a body have turned over: of winding -1, in one surface with a larger part of winding 1.
  const auto joined = [](Surface a, const Surface& b) {
    const int first = static_cast<int>(a.points.size()) / a.dimension;
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (const int v : b.facets) a.facets.push_back(first + v);
    return a;
  };
  for (const CellType type : {CellType::quadrilateral, CellType::hexahedron}) {
    CAPTURE(name(type));
    const bool plane = type == CellType::quadrilateral;
    const Mesh mesh = grid(type, {10, 10, plane ? 0 : 10}, unmoved());
    CutMesh cut(mesh);
    const Surface body = plane ? rectangle(.05, .05, .45, .45) : box({.05, .05, .05}, {.45, .45, .45}),
                  loop = plane ? rectangle(.53, .53, .87, .87) : box({.53, .53, .53}, {.87, .87, .87});
    cut.cut(std::vector{joined(body, reversed(loop))});
    check_closure(cut);
    const double side = .4, sides = plane ? 4 : 6;
    CHECK(total_fluid(cut) == Approx(1 - std::pow(side, plane ? 2 : 3)).epsilon(1e-12));
    CHECK(total_interface(cut) == Approx(sides * std::pow(side, plane ? 1 : 2)).epsilon(1e-12));
    // The same of two bodies.
    cut.cut(std::vector{joined(body, reversed(loop)), body});
    check_closure(cut);
    CHECK(total_fluid(cut) == Approx(1 - std::pow(side, plane ? 2 : 3)).epsilon(1e-12));
  }
}

TEST_CASE("Random overlapping outlines: area by inclusion and exclusion", "[cut][bodies]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  const Mesh mesh = grid(CellType::triangle, {6, 5, 0}, rotated(2, 0.4, {1, 1.3, 1}, {0, 0, 0}));
  CutMesh cut(mesh), complement(mesh);
  long cuts = 0;
  for (int k = 0; k < 300 * effort(); ++k) {
    const auto near = [&] { return Point{-0.2 + 0.6 * unit(random), 0.4 + 0.5 * unit(random), 0}; };
    const Surface a = star(random, near(), 0.4, 3 + random() % 9),
                  b = star(random, near(), 0.4, 3 + random() % 9);
    const auto fluid = [&](const std::vector<Surface>& bodies) {
      cut.cut(bodies);
      cuts += check_closure(cut);
      return total_fluid(cut);
    };
    // |A u B| = |A| + |B| - |A n B|, and A n B is what the union of both complements leaves.
    const double whole = fluid({}), left = fluid({a, b}), common = fluid({reversed(a), reversed(b)});
    CHECK(whole - left ==
          Approx(2 * whole - fluid({a}) - fluid({b}) - common).epsilon(0).margin(1e-11 * whole));
  }
  CHECK(cuts > 10000 * effort());
}

TEST_CASE("Bodies that touch, moved against each other by steps from 1e-16 to 1e-1", "[cut][bodies]") {
  const Mesh mesh = grid(CellType::quadrilateral, {8, 8, 0}, unmoved());
  CutMesh cut(mesh);
  for (const double sign : {1.0, -1.0})
    for (int exponent = -160; exponent <= -10; ++exponent) {
      const double gap = sign * 0.1 * std::pow(10.0, exponent / 10.0);
      const double left = 0.1 + 0.3, right = left + gap;
      cut.cut(std::vector{rectangle(.1, .1, left, .6), rectangle(right, .2, .9, .7)});
      check_closure(cut);
      const double body = .3 * .5 + (.9 - right) * .5 - std::max(0.0, -gap) * .4;
      CHECK(total_fluid(cut) == Approx(1 - body).epsilon(1e-11));
    }
}

TEST_CASE("Open surfaces cut off what lies behind them", "[cut][bodies]") {
  for (const CellType type : {CellType::quadrilateral, CellType::triangle}) {
    const Mesh mesh = grid(type, {8, 6, 0}, unmoved());
    CutMesh cut(mesh);
    // Ends on the boundary, outside, and on a mesh line; the body lies to the left.
    for (const auto& [points, fluid] : std::vector<std::pair<std::vector<Point>, double>>{
             {{{0, .4, 0}, {1, .4, 0}}, .4},
             {{{1, .4, 0}, {0, .4, 0}}, .6},
             {{{-.3, .4, 0}, {.5, .2, 0}, {1.3, .4, 0}}, (.325 + .2) / 2},
             {{{0, .5, 0}, {.5, .5, 0}, {1, .5, 0}}, .5},
             {{{0, 2, 0}, {1, 2, 0}}, 1},
             {{{1, 2, 0}, {0, 2, 0}}, 0}}) {
      const Surface s = open_line(points);
      cut.cut(std::span(&s, 1));
      check_closure(cut);
      CHECK(total_fluid(cut) == Approx(fluid).epsilon(0).margin(1e-12));
    }
  }
}

TEST_CASE("What an open surface leaves open behind the border says nothing of its overlap with another body",
          "[cut][bodies]") {
  const Mesh mesh = grid(CellType::quadrilateral, {8, 6, 0}, unmoved());
  CutMesh cut(mesh);
  for (const bool mirrored : {false, true})
    for (const double beyond : {0.0, 1e-12, 1e-3, 0.2})
      for (const double ground : {0.0, 1e-12, 1e-3, 0.1, 0.3})
        for (const auto& [depth, tilt] :
             {std::pair(-0.05, 0.0), {0.0, 0.0}, {1e-9, 0.0}, {0.05, 0.0}, {-0.001, 0.05}, {0.001, 0.05}})
          for (int start = 0; start < 4; ++start) {
            INFO(mirrored << ", " << beyond << ", " << ground << ", " << depth << ", " << tilt << ", "
                          << start);
            const auto placed = [&](std::vector<Point> points) {
              if (!mirrored) return points;
              for (Point& x : points) x[0] = 1 - x[0];
              std::reverse(points.begin(), points.end());
              return points;
            };
            // A body from x = 0.3 on, above 0.1 - depth, and one below 0.1, whose outline begins at any
            // corner.
            const Surface foot =
                open_line(placed({{.3, 1.2, 0}, {.3, .1 - depth + tilt, 0}, {1 + beyond, .1 - depth, 0}}));
            std::vector<Point> corners{
                {-.1, -.1, 0}, {1 + ground, -.1, 0}, {1 + ground, .1, 0}, {-.1, .1, 0}};
            std::rotate(corners.begin(), corners.begin() + start, corners.end());
            const Surface block = polygon(placed(corners));
            const double left = tilt - depth, right = tilt * beyond / (.7 + beyond) - depth;
            const double film =
                left <= 0 ? 0 : .35 * (right >= 0 ? left + right : left * left / (left - right));
            for (const auto& bodies : {std::vector{foot, block}, std::vector{block, foot}}) {
              cut.cut(bodies);
              check_closure(cut);
              CHECK(total_fluid(cut) == Approx(.3 * .9 + film).epsilon(0).margin(1e-9));
            }
          }
}

TEST_CASE("Surfaces that are torn are refused on all ranks, or cut alike", "[cut][bodies][ranks]") {
  // Half of a stamp as an iteration has thrown it about: its foot and side, open at both ends, leave the mesh
  // where they should not.
  const Surface foot = open_line({{-1.041, 0.645, 0},
                                  {-0.565, 0.368, 0},
                                  {-0.654, 0.284, 0},
                                  {-0.640, 0.247, 0},
                                  {-0.619, 0.222, 0},
                                  {-0.468, 0.081, 0},
                                  {-0.358, -0.009, 0},
                                  {-0.313, -0.005, 0},
                                  {-0.049, 0.015, 0},
                                  {-0.110, 0.045, 0},
                                  {0.000, -0.015, 0}});
  const Surface side = open_line({{-0.662, 1.659, 0},
                                  {-0.681, 1.588, 0},
                                  {-0.693, 1.519, 0},
                                  {-0.696, 1.462, 0},
                                  {-0.686, 1.454, 0},
                                  {-0.784, 1.353, 0},
                                  {-0.868, 1.087, 0},
                                  {-0.793, 1.156, 0},
                                  {-0.709, 0.866, 0},
                                  {-0.725, 0.844, 0},
                                  {-0.779, 0.856, 0},
                                  {-0.807, 0.910, 0},
                                  {-0.749, 0.656, 0},
                                  {-0.746, 0.716, 0},
                                  {-0.938, 0.777, 0},
                                  {-0.866, 0.631, 0},
                                  {-0.973, 0.578, 0},
                                  {-1.041, 0.645, 0}});
  const Surface ground = polygon({{-1.05, -.3, 0}, {.05, -.3, 0}, {.05, 0, 0}, {-1.05, 0, 0}});
  const Mesh mesh = grid(CellType::quadrilateral, {12, 18, 0}, [](const Point& x) {
    return Point{x[0] - 1, 1.5 * x[1] - .25, 0};
  });
  const Communicator all;
  CutMesh cut(mesh);
  bool is_cut = true;
  try {
    cut.cut(std::vector{foot, side, ground});
  } catch (const Error& error) {
    is_cut = false;
    CHECK_THAT(error.what(), Catch::Contains("not closed inside of it"));
  }
  REQUIRE(all.sum(static_cast<long long>(is_cut)) % all.size() == 0);
  if (!is_cut) return;
  std::vector<std::array<int, 2>> mine;
  for (int c = 0; c < mesh.cells(); ++c)
    mine.push_back({mesh.global_cell(c), static_cast<int>(cut.state(c))});
  std::map<int, int> state;
  for (const auto& [cell, is] : all.gather_all(mine)) {
    INFO("cell " << cell);
    CHECK(state.try_emplace(cell, is).first->second == is);
  }
}

TEST_CASE("An open surface that ends on the border cuts in any unit, turned, and of short facets",
          "[cut][bodies]") {
  for (const double size : {1.0, 1e-9})
    for (const int facets : {1, 4000}) {
      const Placement placed = rotated(2, 0.3, {size, size, size}, {0, 0, 0});
      const Mesh mesh = grid(CellType::quadrilateral, {8, 6, 0}, placed);
      std::vector<Point> points;
      for (int k = 0; k <= facets; ++k) points.push_back(placed({static_cast<double>(k) / facets, .4, 0}));
      const Surface s = open_line(points);
      CutMesh cut(mesh);
      INFO(size << ", " << facets);
      cut.cut(std::span(&s, 1));
      check_closure(cut);
      CHECK(total_fluid(cut) / (size * size) == Approx(.4).epsilon(1e-9));
    }
}

TEST_CASE("Both walls of a channel in one open surface, and a body touching a wall", "[cut][bodies]") {
  const Mesh mesh = grid(CellType::quadrilateral, {8, 6, 0}, unmoved());
  CutMesh cut(mesh);
  Surface walls = open_line({{0, .8, 0}, {1, .8, 0}});
  walls.points.insert(walls.points.end(), {1, .1, 0, .1});
  walls.facets.insert(walls.facets.end(), {2, 3});
  cut.cut(std::vector{walls, rectangle(.3, .1, .5, .4)});
  check_closure(cut);
  CHECK(total_fluid(cut) == Approx(.7 - .06).epsilon(1e-12));
  CHECK(total_interface(cut) == Approx(1 + 1 - .2 + .8).epsilon(1e-12));
}

TEST_CASE("The surface of one body in several parts is one surface", "[cut][bodies]") {
  const auto part = [](const Surface& whole, const std::vector<int>& facets) {
    Surface s = whole;
    s.closed = false;
    s.facets.clear();
    for (const int f : facets)
      s.facets.insert(s.facets.end(), &whole.facets[f * whole.dimension],
                      &whole.facets[f * whole.dimension] + whole.dimension);
    return s;
  };
  for (const CellType type : {CellType::quadrilateral, CellType::triangle, CellType::hexahedron}) {
    const bool plane = type != CellType::hexahedron;
    const Mesh mesh = grid(type, {5, 5, plane ? 0 : 5}, unmoved());
    CutMesh whole(mesh), parts(mesh);
    const Surface body = plane ? rectangle(.13, .22, .71, .64) : box({.13, .22, .31}, {.71, .64, .83});
    // Opposite sides in one of the parts; a body of its own between them in the order.
    std::vector<int> first, second;
    for (int f = 0; f < body.facet_count(); ++f) ((plane ? f : f / 4) % 2 == 0 ? first : second).push_back(f);
    const Surface other = plane ? rectangle(.8, .1, .9, .9) : box({.8, .1, .1}, {.9, .9, .9});
    whole.cut(std::vector{body, other});
    parts.cut(std::vector{part(body, first), other, part(body, second)});
    check_closure(parts);
    REQUIRE(parts.cut_cells() == whole.cut_cells());
    CHECK(total_fluid(parts) == Approx(total_fluid(whole)).epsilon(1e-14));
    CHECK(total_interface(parts) == Approx(total_interface(whole)).epsilon(1e-14));
    // Points know of which part they are.
    InterfaceRule rule;
    std::vector<double> area(3, 0.0), known(3, 0.0);
    for (const int c : parts.cut_cells()) {
      parts.interface_rule(c, 1, rule);
      for (int q = 0; q < rule.count(); ++q) area[rule.body[q]] += rule.weight[q];
      whole.interface_rule(c, 1, rule);
      for (int q = 0; q < rule.count(); ++q) {
        const bool is_first = std::find(first.begin(), first.end(), rule.facet[q]) != first.end();
        known[rule.body[q] == 1 ? 1 : is_first ? 0 : 2] += rule.weight[q];
      }
    }
    for (int b = 0; b < 3; ++b) CHECK(area[b] == Approx(known[b]).epsilon(1e-13));
  }
}

TEST_CASE("One part of a body's surface alone is refused beside another body", "[cut][bodies]") {
  const Mesh mesh = grid(CellType::quadrilateral, {4, 4, 0}, unmoved());
  CutMesh cut(mesh);
  Surface part = rectangle(.2, .2, .5, .5);
  part.facets.resize(4);
  part.closed = false;
  CHECK_THROWS_WITH(cut.cut(std::vector{rectangle(.6, .6, .8, .8), part}),
                    Catch::Contains("not closed inside of it"));
}

TEST_CASE("Broken surfaces are refused with a reason", "[cut][bodies]") {
  const Mesh mesh = grid(CellType::quadrilateral, {4, 4, 0}, unmoved());
  CutMesh cut(mesh);
  const auto message = [&](const Surface& s) -> std::string {
    try {
      cut.cut(std::vector{rectangle(.1, .1, .2, .2), s});
    } catch (const std::exception& e) {
      return e.what();
    }
    return "";
  };
  Surface s = rectangle(.4, .4, .7, .7);
  CHECK(message(s).empty());
  s.points[3] = NAN;
  CHECK_THAT(message(s), Catch::Contains("body 1, facet 0: vertex 1 has the coordinate nan"));
  s = rectangle(.4, .4, .7, .7);
  s.facets[4] = 9;
  CHECK_THAT(message(s),
             Catch::Contains("body 1, facet 2: vertex 9 does not exist; the surface has 4 vertices"));
  s = rectangle(.4, .4, .7, .7);
  s.facets.resize(6);
  CHECK_THAT(message(s), Catch::Contains("body 1: its surface is not closed at facet"));
  s.closed = false;
  CHECK_THAT(message(s), Catch::Contains("not closed inside of it"));
  s.facets.clear();
  CHECK_THAT(message(s), Catch::Contains("body 1: its surface has no facet"));
}

TEST_CASE("What a surface runs round the wrong way is no part of its body", "[cut][bodies]") {
  // A figure of eight: its left half is counter-clockwise, its right half clockwise.
  const Surface eight = polygon({{.2, .3, 0}, {.8, .7, 0}, {.8, .3, 0}, {.2, .7, 0}});
  const double half = .5 * .4 * .3;
  for (const CellType type : {CellType::quadrilateral, CellType::triangle})
    for (const int n : {3, 9}) {
      const Mesh mesh = grid(type, {n, n, 0}, unmoved());
      CutMesh cut(mesh);
      INFO(name(type) << ", " << n);
      cut.cut(std::vector{eight});
      CHECK(total_fluid(cut) == Approx(1 - half).epsilon(1e-11));
      // Beside a body that covers some of both halves.
      cut.cut(std::vector{eight, rectangle(.1, .1, .9, .35)});
      const double slope = .4 / .6,
                   low = .05;  // each half has a triangle of this height below the other's side
      const double covered = low * low / slope / 2;
      CHECK(total_fluid(cut) == Approx(1 - half - .8 * .25 + covered).epsilon(1e-11));
    }
}
