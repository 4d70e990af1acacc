// SPDX-License-Identifier: BSD-3-Clause
// Bodies that stand on the border of a fluid's mesh.
#include <fmt/format.h>

#include <cmath>

#include "cli/run_command.hpp"
#include "series.hpp"

using namespace seam_cli_test;
using Catch::Matchers::Contains;

namespace {

struct Bed {
  bool upright;  ///< the channel runs along y, the bed is beside it
  bool high;     ///< the bed lies at the higher side
  double shift;  ///< how far the fluid's mesh begins from the bed's surface, m
};

/// A channel of the width 1 on a porous bed with a slip length of 0.1: a strip that is 0.2 long.
std::string channel(const Bed& bed) {
  const auto vector = [&](const std::string& along, const std::string& across) {
    return bed.upright ? fmt::format("[{}, {}]", across, along) : fmt::format("[{}, {}]", along, across);
  };
  const auto number = [](double x) { return fmt::format("{:.17g}", x); };
  const auto grid = [&](double from, double to, const std::string& cells) {
    return fmt::format("{{grid: {{from: {}, to: {}, cells: {}}}}}", vector("0", number(from)),
                       vector("0.2", number(to)), vector("4", cells));
  };
  const std::string along = bed.upright ? "y" : "x", across = bed.upright ? "x" : "y";
  const std::string wall = across + (bed.high ? "_min" : "_max"),
                    bottom = across + (bed.high ? "_max" : "_min");
  const double s = bed.shift, up = bed.high ? -1 : 1;
  return fmt::format(
      R"(
title: A channel over a porous bed whose surface is the last line of the channel's mesh
dimension: 2
plugins: [cutfem_fluid, solid, poroelasticity, nitsche_fsci]
parameters: {{n: 20, mu: 0.1, G: 0.1}}
meshes:
  channel: {channel}
  bed: {bed}
fields:
  water:
    type: cutfem_fluid
    mesh: channel
    density: 1
    viscosity: ${{mu}}
    convection: false
    boundary:
      - {{on: {wall}, velocity: [0, 0]}}
      - {{on: [{along}_min, {along}_max], velocity: {across_only}}}
      - {{on: {along}_min, traction: {push}}}
    fix_pressure: never
  bed:
    type: porous_solid
    mesh: bed
    material: {{type: neo_hookean, young: 1e6, poisson: 0}}
    viscosity: ${{mu}}
    porosity: {{initial: 0.5}}
    permeability: [0.01]
    boundary:
      - {{on: {bottom}, displacement: [0, 0], velocity: {across_zero}}}
      - {{on: [{along}_min, {along}_max, {top}], displacement: [0, 0]}}
      - {{on: {along}_min, pore_pressure: 0.2*G}}
interfaces:
  surface: {{type: embedded, field: water, body: bed}}
coupling:
  - {{type: fpi, on: surface}}
output:
  fields: false
  probes:
    near: {{field: water, at: {near}, quantity: velocity, component: {along}}}
    far: {{field: water, at: {far}, quantity: velocity, component: {along}}}
)",
      fmt::arg("channel", bed.high ? grid(-1, -s, "n") : grid(s, 1, "n")),
      fmt::arg("bed", bed.high ? grid(0, 0.4, "8") : grid(-0.4, 0, "8")), fmt::arg("wall", wall),
      fmt::arg("bottom", bottom), fmt::arg("along", along),
      fmt::arg("top", across + (bed.high ? "_min" : "_max")), fmt::arg("across_only", vector("null", "0")),
      fmt::arg("across_zero", vector("null", "0")), fmt::arg("push", vector("0.2*G", "0")),
      fmt::arg("near", vector("0.1", number(up * 0.05))), fmt::arg("far", vector("0.1", number(up * 0.45))));
}

/// Water of the pressure 3 in a box, on one side of which a solid block stands that is held.
std::string pressed(int dimension, int axis, bool high, double shift) {
  const int open = axis == 0 ? 1 : 0;  // the axis along which it is pressed
  const auto vector = [&](const std::string& all, int at, const std::string& there) {
    std::string text = "[";
    for (int d = 0; d < dimension; ++d) text += (d > 0 ? ", " : "") + (d == at ? there : all);
    return text + "]";
  };
  const auto number = [](double x) { return fmt::format("{:.17g}", x); };
  const std::string names = "xyz";
  const auto side = [&](int d, bool end) { return std::string(1, names[d]) + (end ? "_max" : "_min"); };
  std::string walls;
  for (int d = 0; d < dimension; ++d)
    for (const bool end : {false, true})
      if (std::pair(d, end) != std::pair(open, false) && std::pair(d, end) != std::pair(axis, high))
        walls += (walls.empty() ? "" : ", ") + side(d, end);
  return fmt::format(R"(
title: A block that stands on the border of a box of water under pressure
dimension: {dimension}
plugins: [cutfem_fluid, solid, nitsche_fsci]
meshes:
  box: {{grid: {{from: {box_from}, to: {box_to}, cells: {three}}}}}
  block: {{grid: {{from: {block_from}, to: {block_to}, cells: {two}}}}}
fields:
  water:
    type: cutfem_fluid
    mesh: box
    density: 1
    viscosity: 0.1
    convection: false
    boundary:
      - {{on: [{walls}], velocity: {zero}}}
      - {{on: {open}, traction: {push}}}
    fix_pressure: never
  block:
    type: solid
    mesh: block
    material: {{type: neo_hookean, young: 1e6, poisson: 0.3}}
    boundary:
      - {{on: [{sides}], displacement: {zero}}}
interfaces:
  surface: {{type: embedded, field: water, body: block}}
coupling:
  - {{type: fsi, on: surface}}
output:
  fields: false
  probes:
    f: {{interface: surface, quantity: force}}
)",
                     fmt::arg("dimension", dimension),
                     fmt::arg("box_from", vector("0", axis, number(high ? -1 : shift))),
                     fmt::arg("box_to", vector("1", axis, number(high ? -shift : 1))),
                     fmt::arg("block_from", vector("-0.2", axis, number(high ? 0 : -0.5))),
                     fmt::arg("block_to", vector("1.3", axis, number(high ? 0.5 : 0))),
                     fmt::arg("three", vector("3", 0, "3")), fmt::arg("two", vector("2", 0, "2")),
                     fmt::arg("walls", walls), fmt::arg("zero", vector("0", 0, "0")),
                     fmt::arg("open", side(open, false)), fmt::arg("push", vector("0", open, "3")),
                     fmt::arg("sides", dimension == 2 ? "x_min, x_max, y_min, y_max"
                                                      : "x_min, x_max, y_min, y_max, z_min, z_max"));
}

double closed_form(double y) { return -0.5 * y * y + 0.4454545454545 * y + 0.0545454545455; }

}  // namespace

TEST_CASE("A porous bed that stands on the last line of the fluid's mesh is an interface") {
  for (const bool upright : {false, true})
    for (const bool high : {false, true}) {
      double first = 0;
      for (const double shift : {0.0, 1e-15, -1e-15, 4e-11}) {
        INFO("upright " << upright << ", high " << high << ", shift " << shift);
        const Folder folder;
        const Result run = seam("run " + folder.file("bed.yaml", channel({upright, high, shift})) +
                                " --quiet --no-picture --folder " + (folder.path / "results").string());
        INFO(run.output);
        REQUIRE(run.code == 0);
        const std::string series = folder.read("results/series.csv");
        const double near = column(series, "near").back(), far = column(series, "far").back();
        CHECK(near == Approx(closed_form(0.05)).epsilon(0.01));
        CHECK(far == Approx(closed_form(0.45)).epsilon(0.01));
        if (first == 0) first = far;
        CHECK(far == Approx(first).epsilon(1e-6));
      }
    }
}

TEST_CASE("A solid block that stands on the border of the fluid's mesh is pressed by the fluid") {
  for (const int dimension : {2, 3})
    for (int axis = 0; axis < dimension; ++axis)
      for (const bool high : {false, true})
        for (const double shift :
             dimension == 2 ? std::vector{0.0, 1e-15, -1e-15, 3e-10} : std::vector{1e-15}) {
          CAPTURE(dimension, axis, high, shift);
          const Folder folder;
          const Result run = seam("run " + folder.file("block.yaml", pressed(dimension, axis, high, shift)) +
                                  " --quiet --no-picture --folder " + (folder.path / "results").string());
          INFO(run.output);
          REQUIRE(run.code == 0);
          const std::string names = "xyz", series = folder.read("results/series.csv");
          for (int d = 0; d < dimension; ++d)
            CHECK(column(series, std::string("f.") + names[d]).back() ==
                  Approx(d == axis ? (high ? 3.0 : -3.0) : 0.0).epsilon(0).margin(1e-9));
        }
}

TEST_CASE("what is hardly meant beside the border is warned of, what is meant is not") {
  const auto said = [](const std::string& scene) {
    const Folder folder;
    return seam("run " + folder.file("block.yaml", scene) + " --no-picture --folder " +
                (folder.path / "results").string())
        .output;
  };
  const auto with = [](std::string scene, const std::string& what, const std::string& instead) {
    const std::size_t at = scene.find(what);
    REQUIRE(at != std::string::npos);
    return scene.replace(at, what.size(), instead);
  };
  const std::string is_short = "short of the border of mesh 'box'",
                    in_part = "covers a cell's side only in part",
                    conditioned = "a body stands on boundary 'y_min' of field 'water', where 'velocity' is";
  for (const int dimension : {2, 3}) {
    for (const bool high : {false, true}) {
      CAPTURE(dimension, high);
      CHECK_THAT(said(pressed(dimension, 1, high, 1e-4)), Contains("0.0003 of a cell " + is_short));
      // On the border, in the mesh.
      for (const double shift : {0.0, 1e-10, -1e-4})
        CHECK_THAT(said(pressed(dimension, 1, high, shift)), !Contains("warning"));
      // Two hundredths of a cell away the border is a border, and the block outside.
      CHECK_THAT(said(pressed(dimension, 1, high, 0.0066)),
                 !Contains(is_short) && Contains("nothing of the interface 'surface' lies in its field"));
    }
    const std::string on_it = pressed(dimension, 1, false, 0);
    CHECK_THAT(said(with(on_it, "to: [1.3,", "to: [0.5,")), Contains(in_part));
    CHECK_THAT(said(with(on_it, "to: [1.3,", "to: [" + std::string("0.66666666666666663,"))),
               !Contains(in_part));
    CHECK_THAT(said(with(on_it, "on: [x_max,", "on: [x_max, y_min,")), Contains(conditioned));
  }
}
