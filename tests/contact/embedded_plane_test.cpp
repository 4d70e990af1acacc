// SPDX-License-Identifier: BSD-3-Clause
// In the plane: flat bodies in touch, between which films of rounding come and go.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "seam/contact/embedded_surface.hpp"
#include "seam/cut/cut_boundary.hpp"
#include "seam/cut/interface_motion.hpp"
#include "seam/mesh/input/grid.hpp"
#include "seam/state/state_store.hpp"

using namespace seam;

namespace {

std::unique_ptr<Mesh> block(std::array<double, 2> low, std::array<double, 2> high, std::array<int, 2> cells) {
  Grid grid;
  grid.cell = CellType::quadrilateral;
  for (int d = 0; d < 2; ++d) grid.lines[d] = graded_lines(low[d], high[d], cells[d]);
  return std::make_unique<Mesh>("block", std::make_shared<MeshData>(make_grid(grid)), Communicator());
}

/// A plug of finer facets than the water's cells stands on the floor. @param height of nodes of its foot
struct Plug {
  template <class Height>
  explicit Plug(const Height& height)
      : water_mesh(block({-0.5013, -0.1487}, {1.0987, 0.6513}, {16, 8})),
        plug_mesh(block({0, 0}, {0.6, 0.5}, {12, 12})),
        floor_mesh(block({-0.6, -0.2}, {1.2, 0}, {18, 2})),
        water("water", *water_mesh, {{"p", 1, 1, 0, ""}}),
        plug("plug", *plug_mesh, {{"displacement", 2, 1, 0, "m"}}),
        floor("floor", *floor_mesh, {{"displacement", 2, 1, 0, "m"}}),
        cut(water),
        plug_surface(std::make_shared<BodySurface>(plug, std::vector<std::string>{}, "displacement")),
        floor_surface(std::make_shared<BodySurface>(floor, std::vector<std::string>{}, "displacement")),
        surface(water, cut, cut.add_body([this](double) { return plug_surface->now(); }), plug_surface,
                floor_surface, {0.05, 0.05}, 4) {
    cut.add_body([this](double) { return floor_surface->now(); });
    water.blocks()[0].known.assign(water.blocks()[0].known.size(), 1);
    surface.begin_step();
    move(height);
  }
  /// Within the step: what was dropped from the cut stays out.
  template <class Height>
  void move(const Height& height) {
    Block& of_plug = plug.blocks()[0];
    for (int node = 0; node < of_plug.space->nodes(); ++node) {
      const double* x = of_plug.space->position(node);
      if (x[1] < 1e-9) of_plug.now.value[static_cast<std::size_t>(node) * 2 + 1] = height(x[0]);
    }
    cut.update(0);
    water.occupy(cut.active_cells(), &cut.mesh());
    surface.follow();
  }
  std::unique_ptr<Mesh> water_mesh, plug_mesh, floor_mesh;
  Field water, plug, floor;
  FieldCut cut;
  std::shared_ptr<BodySurface> plug_surface, floor_surface;
  EmbeddedSurface surface;
};

/// The rule and how it moves speak of the same places: ends of stretches, and points, on facets.
void check_motion(const Plug& plug) {
  InterfaceRule rule;
  InterfaceMotion motion;
  for (const int cell : plug.water.cut()->cut_cells())
    for (int part = 0; part < plug.water.parts(cell); ++part) {
      plug.water.cut()->interface_rule(cell, 4, rule, &motion, part);
      for (int q = 0; q < rule.count(); ++q) {
        const MovingPoint<2, 1>& point = motion.in_plane[static_cast<std::size_t>(q)];
        CHECK(std::abs(point.on_facet[0].v - rule.facet_reference[q]) < 1e-9);
        for (const int end : {0, 1}) CHECK(std::abs(point.span[end].v - rule.span[2 * q + end]) < 1e-9);
      }
    }
}

constexpr EmbeddedSurface::Zone zones[] = {EmbeddedSurface::free, EmbeddedSurface::near,
                                           EmbeddedSurface::closed, EmbeddedSurface::covered,
                                           EmbeddedSurface::shut};

}  // namespace

TEST_CASE(
    "points of flat bodies that films of rounding part lie on their facets, and what is dry weighs no more") {
  std::mt19937 random(7);
  for (int k = 0; k < 60; ++k) {
    const double size = std::pow(10.0, -4 - k % 5);
    std::uniform_real_distribution<double> heights(-size, size), apart(0, size);
    Plug body([&](double) { return heights(random); });
    body.move([&](double) { return apart(random); });
    check_motion(body);
    double dry = 0, wet = 0;
    for (const EmbeddedSurface::Zone zone : zones)
      for (const EmbeddedSurface::Element& element : body.surface.elements(zone))
        for (std::size_t q = 0; q < element.own.weight.size(); ++q) {
          if (zone == EmbeddedSurface::near || zone == EmbeddedSurface::closed)
            CHECK(std::abs(element.gap[q]) < 1.01 * size);
          for (const std::size_t d : {0, 1})
            CHECK(std::abs(element.own.reference[2 * q + d] - 0.5) < 0.5 + 1e-6);
          if (element.normal[2 * q + 1] < 0.99) continue;
          const bool is_wet = zone == EmbeddedSurface::free || zone == EmbeddedSurface::near;
          (is_wet ? wet : dry) += element.own.weight[q];
        }
    INFO("heights of " << size << ", case " << k << ": wet " << wet << ", dry " << dry);
    CHECK(dry < 0.6 + 1e-6);
    CHECK(std::abs(wet + dry - 0.6) < 1e-6);
  }
}
