// SPDX-License-Identifier: BSD-3-Clause
// Several bodies in space.
#include <catch2/catch.hpp>
#include <cmath>

#include "cut/cut_test.hpp"

using namespace seam;

TEST_CASE("In space the fluid lies outside of all bodies", "[cut][contact]") {
  struct Case {
    const char* name;
    std::vector<Surface> bodies;
    double body, interface;
  };
  const auto cube = [](double x, double y, double z, double size) {
    return box({x, y, z}, {x + size, y + size, z + size});
  };
  const std::vector<Case> cases{
      {"apart", {cube(.1, .1, .1, .2), cube(.5, .5, .5, .3)}, .008 + .027, .24 + .54},
      {"overlapping", {cube(.1, .1, .1, .4), cube(.3, .3, .3, .4)}, .128 - .008, 1.92 - .24},
      {"touching in a face", {cube(.1, .1, .1, .2), cube(.3, .1, .1, .2)}, .016, .48 - .08},
      {"touching in a part of a face", {cube(.1, .1, .1, .2), cube(.3, .2, .2, .2)}, .016, .48 - .02},
      {"touching on a mesh plane", {cube(.3, .3, .3, .2), cube(.5, .4, .4, .2)}, .016, .48 - .02},
      {"touching in an edge", {cube(.1, .1, .1, .2), cube(.3, .3, .1, .2)}, .016, .48},
      {"touching in a corner", {cube(.1, .1, .1, .2), cube(.3, .3, .3, .2)}, .016, .48},
      {"one inside the other", {cube(.1, .1, .1, .7), cube(.3, .3, .3, .2)}, .343, 6 * .49},
      {"the same twice", {cube(.1, .1, .1, .2), cube(.1, .1, .1, .2)}, .008, .24},
      {"filling a part of a hole",
       {reversed(cube(.2, .2, .2, .6)), box({.2, .2, .2}, {.5, .8, .8})},
       1 - .108,
       1.44},
  };
  for (const auto& [type, n] : {std::pair(CellType::hexahedron, 10), std::pair(CellType::hexahedron, 3),
                                std::pair(CellType::tetrahedron, 4)}) {
    const Mesh mesh = grid(type, {n, n, n}, unmoved());
    CutMesh cut(mesh);
    for (const Case& c : cases) {
      INFO(c.name << ", " << name(type) << ", " << n);
      cut.cut(c.bodies);
      check_closure(cut);
      CHECK(total_fluid(cut) == Approx(1 - c.body).epsilon(0).margin(1e-11));
      CHECK(total_interface(cut) == Approx(c.interface).epsilon(1e-10));
    }
  }
}

TEST_CASE("Random overlapping bodies in space: volume by inclusion and exclusion", "[cut][contact]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  long cuts = 0;
  const auto bent = [](const Point& x) {
    return Point{x[0] + 0.05 * x[1] * x[1], x[1], x[2] + 0.1 * x[0] * x[1]};
  };
  std::vector<Mesh> meshes;
  meshes.push_back(grid(CellType::hexahedron, {3, 3, 3}, rotated(3, 0.2, {1, 1, 1}, {0, 0, 0})));
  meshes.push_back(grid(CellType::tetrahedron, {2, 2, 2}, rotated(3, 0.2, {1, 1, 1}, {0, 0, 0})));
  meshes.push_back(grid(CellType::hexahedron, {3, 3, 3}, bent));
  for (const Mesh& mesh : meshes) {
    CutMesh cut(mesh);
    for (int k = 0; k < 10 * effort(); ++k) {
      const auto body = [&] {
        const Point centre{0.2 + 0.6 * unit(random), 0.2 + 0.6 * unit(random), 0.2 + 0.6 * unit(random)};
        return moved(sphere({0, 0, 0}, 0.4, static_cast<int>(random() % 2)), [&](const Point& x) {
          const double s = 0.5 + 0.5 * unit(random);
          return Point{centre[0] + s * x[0], centre[1] + s * x[1], centre[2] + s * x[2]};
        });
      };
      const Surface a = body(), b = body();
      const auto fluid = [&](const std::vector<Surface>& bodies) {
        cut.cut(bodies);
        cuts += check_closure(cut);
        return total_fluid(cut);
      };
      const double whole = fluid({}), left = fluid({a, b}), common = fluid({reversed(a), reversed(b)});
      CHECK(whole - left == Approx(2 * whole - fluid({a}) - fluid({b}) - common).epsilon(0).margin(1e-11));
    }
  }
  CHECK(cuts > 1000 * effort());
}

TEST_CASE("Boxes that touch in space, moved against each other by steps from 1e-16 to 1e-1",
          "[cut][contact]") {
  for (const CellType type : {CellType::hexahedron, CellType::tetrahedron}) {
    const Mesh mesh = grid(type, {4, 4, 4}, unmoved());
    CutMesh cut(mesh);
    for (const double sign : {1.0, -1.0})
      for (int exponent = -160; exponent <= -10; exponent += 10) {
        const double gap = sign * 0.1 * std::pow(10.0, exponent / 10.0), right = 0.5 + gap;
        INFO(gap);
        cut.cut(std::vector{box({.1, .1, .25}, {.5, .6, .5}), box({right, .2, .25}, {.9, .7, .5})});
        check_closure(cut);
        const double body = .4 * .5 * .25 + (.9 - right) * .5 * .25 - std::max(0.0, -gap) * .4 * .25;
        CHECK(total_fluid(cut) == Approx(1 - body).epsilon(1e-11));
      }
  }
}

TEST_CASE("In space a side on a plane of the mesh has an area only where no other body covers it",
          "[cut][contact]") {
  for (const CellType type : {CellType::hexahedron, CellType::tetrahedron})
    for (const int n : {2, 6}) {
      const Mesh mesh = grid(type, {n, n, n}, unmoved());
      CutMesh cut(mesh);
      for (const double edge : {0.2, 0.3, 0.335, 0.6})
        for (const double top : {0.51, 0.6}) {
          INFO(name(type) << ", " << n << ", a step from " << edge << " to a height of " << top);
          // A box that stands on z = 1/2, and a step that it has sunk into, which reaches out of the mesh.
          cut.cut(std::vector{box({.25, .25, .5}, {.75, .75, .85}), box({edge, -.5, -.5}, {1.5, 1.5, top})});
          check_closure(cut);
          const double within = .75 - std::max(edge, .25), sunk = top - .5;
          CHECK(total_fluid(cut) ==
                Approx(1 - (1 - edge) * top - .25 * .35 + within * .5 * sunk).epsilon(1e-11));
          const double step = (1 - edge) - within * .5 + (edge > .25 ? top - .5 * sunk : top);
          const double sides = 2 * .35 - sunk * (2 * within + .5 * (edge > .25 ? 1 : 2));
          CHECK(total_interface(cut) == Approx(step + sides + .25 + .5 * (.5 - within)).epsilon(1e-10));
        }
    }
}
