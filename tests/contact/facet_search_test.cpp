// SPDX-License-Identifier: BSD-3-Clause
#include "seam/contact/facet_search.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

using namespace seam;

namespace {

/// A regular polygon about the origin, counter-clockwise.
Surface polygon(int corners, double radius) {
  Surface surface;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    surface.points.insert(surface.points.end(), {radius * std::cos(angle), radius * std::sin(angle)});
    surface.facets.insert(surface.facets.end(), {k, (k + 1) % corners});
  }
  return surface;
}

/// The faces of an octahedron about the origin, normals outwards.
Surface octahedron(double radius) {
  Surface surface;
  surface.dimension = 3;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0})
      for (int d = 0; d < 3; ++d) surface.points.push_back(d == axis ? sign * radius : 0.0);
  for (int x = 0; x < 2; ++x)
    for (int y = 0; y < 2; ++y)
      for (int z = 0; z < 2; ++z) {
        const bool mirrored = (x + y + z) % 2 == 1;
        surface.facets.insert(surface.facets.end(), {x, mirrored ? 4 + z : 2 + y, mirrored ? 2 + y : 4 + z});
      }
  return surface;
}

std::array<double, 3> place(const Surface& surface, const FacetSearch::Hit& hit) {
  std::array<double, 3> x{};
  const int dim = surface.dimension;
  const double share[3] = {1 - hit.on_facet[0] - hit.on_facet[1], hit.on_facet[0], hit.on_facet[1]};
  for (int k = 0; k < dim; ++k)
    for (int d = 0; d < dim; ++d)
      x[d] += share[k] * surface.points[surface.facets[hit.facet * dim + k] * dim + d];
  return x;
}

}  // namespace

TEST_CASE("a ray meets the side of a body that faces it, from outside and from within") {
  const FacetSearch search(polygon(7, 1));
  const double inside = std::cos(std::numbers::pi / 7);  // distance of the sides
  for (const double distance : {2.0, 0.999, 0.7}) {
    const double x[] = {-distance, 0.01}, direction[] = {1, 0};
    const auto hit = search.find(x, direction, 0.5, 3);
    REQUIRE(hit);
    CHECK(hit->gap == Approx(distance - inside).epsilon(0).margin(1e-12));
    CHECK(place(search.surface(), *hit)[1] == Approx(0.01));
  }
  SECTION("not beyond reach or depth, nor the far side") {
    const double ahead[] = {-2, 0}, within[] = {-0.2, 0}, direction[] = {1, 0};
    CHECK_FALSE(search.find(ahead, direction, 0.5, 1));
    CHECK_FALSE(search.find(within, direction, 0.5, 3));
    CHECK_FALSE(search.find(ahead, direction, 0.5, 3, [](int) { return true; }));
  }
}

TEST_CASE("where a ray meets two facets in their common vertex the first of them counts, on every rank") {
  for (const int turn : {0, 1, 2, 3}) {
    Surface square = polygon(4, 1);
    square.points = {1, 0, 0, 1, -1, 0, 0, -1};  // without rounding
    std::rotate(square.facets.begin(), square.facets.begin() + 2 * turn, square.facets.end());
    // Those that end and begin at the corner in the west.
    int first = 0;
    while (square.facets[2 * first] != 2 && square.facets[2 * first + 1] != 2) ++first;
    const double x[] = {-2, 0}, direction[] = {1, 0};
    const auto hit = FacetSearch(square).find(x, direction, 0.5, 3);
    REQUIRE(hit);
    CHECK(hit->gap == Approx(1));
    CHECK(hit->facet == first);
  }
}

TEST_CASE("of several surfaces that face a ray the nearest counts, ahead or behind") {
  // Two edges across the ray, their outsides towards it, as of two thin bodies one of which is entered.
  const auto edges_at = [](double first, double second) {
    Surface surface;
    for (const double x : {first, second}) {
      const int n = static_cast<int>(surface.points.size()) / 2;
      surface.points.insert(surface.points.end(), {x, 1, x, -1});
      surface.facets.insert(surface.facets.end(), {n, n + 1});
    }
    return FacetSearch(surface);
  };
  const double x[] = {0, 0.1}, direction[] = {1, 0};
  struct Case {
    double first, second, nearest;
  };
  for (const Case& c : {Case{-0.4, 0.1, 0.1}, {-0.1, 0.4, -0.1}, {0.2, 0.3, 0.2}, {-0.3, -0.2, -0.2}})
    for (const bool swapped : {false, true}) {
      const auto hit =
          edges_at(swapped ? c.second : c.first, swapped ? c.first : c.second).find(x, direction, 0.5, 0.5);
      REQUIRE(hit);
      CHECK(hit->gap == Approx(c.nearest));
    }
}

TEST_CASE("no ray slips through between facets") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  const Surface body = octahedron(1);
  const FacetSearch search(body);
  for (int k = 0; k < 2000; ++k) {
    // Towards the centre from all sides, every other time exactly through an edge or a corner.
    double n[3] = {any(random), any(random), any(random)};
    if (k % 2 == 1) n[k / 2 % 3] = 0;
    if (k % 4 == 3) n[(k / 2 + 1) % 3] = 0;
    const double length = std::hypot(n[0], n[1], n[2]);
    double x[3];
    for (int d = 0; d < 3; ++d) {
      n[d] /= length;
      x[d] = -2 * n[d];
    }
    const auto hit = search.find(x, n, 0.1, 3);
    REQUIRE(hit);
    // The surface is |x| + |y| + |z| = 1.
    const auto at = place(body, *hit);
    CHECK(std::abs(at[0]) + std::abs(at[1]) + std::abs(at[2]) == Approx(1).epsilon(1e-9));
    CHECK(hit->gap == Approx(2 - 1 / (std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]))).epsilon(1e-9));
  }
}

TEST_CASE("a surface encloses the points that lie deep inside of it") {
  const FacetSearch ring(polygon(40, 1));
  const double direction[] = {0.6, 0.8}, middle[] = {0.1, -0.2}, edge[] = {0.999, 0.0},
               outside[] = {-1.3, 0.2};
  CHECK(ring.encloses(middle, direction, 0.1));
  CHECK_FALSE(ring.encloses(edge, direction, 0.1));
  CHECK_FALSE(ring.encloses(outside, direction, 0.1));
  CHECK_FALSE(ring.encloses(middle, direction, 0.1, [](int) { return true; }));
}

TEST_CASE("what a surface encloses does not depend on how it is turned", "[sanitized]") {
  // Its sides are long: boxes around them hold most of what is inside of it.
  for (const double angle : {0.0, 0.1, 0.2, 0.5, 1.0, -0.7, 1.5707963267948966}) {
    const double c = std::cos(angle), s = std::sin(angle);
    Surface box;
    for (const auto& [x, y] : {std::pair{-5.0, -1.0}, {5.0, -1.0}, {5.0, 0.0}, {-5.0, 0.0}})
      box.points.insert(box.points.end(), {c * x - s * y, s * x + c * y});
    box.facets = {0, 1, 1, 2, 2, 3, 3, 0};
    const FacetSearch search(box);
    const auto encloses = [&](double x, double y, double margin) {
      const double at[] = {c * x - s * y, s * x + c * y}, down[] = {s, -c};
      return search.encloses(at, down, margin);
    };
    CAPTURE(angle);
    CHECK(encloses(0, -0.09, 0));
    CHECK(encloses(0, -0.11, 0.1));
    CHECK_FALSE(encloses(0, -0.09, 0.1));
    CHECK(encloses(4.89, -0.5, 0.1));
    CHECK_FALSE(encloses(4.91, -0.5, 0.1));
    CHECK_FALSE(encloses(0, 0.01, 0));
  }
}

TEST_CASE("how deep in a body of triangles a point lies is measured to them, not to their boxes") {
  const FacetSearch search(octahedron(1));
  const double direction[] = {0, 0, 1};
  // The distance of the centre from the faces is 1/sqrt(3), far inside of their boxes.
  const double centre[] = {0.001, 0.002, 0.003};
  CHECK(search.encloses(centre, direction, 0.57));
  CHECK_FALSE(search.encloses(centre, direction, 0.58));
  const double near_a_corner[] = {0.9, 0.0, 0.001};  // 0.1/sqrt(3) from four of them
  CHECK(search.encloses(near_a_corner, direction, 0.05));
  CHECK_FALSE(search.encloses(near_a_corner, direction, 0.06));
}
