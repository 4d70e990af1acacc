// SPDX-License-Identifier: BSD-3-Clause
// Scenes that say what cannot be, or what is hardly meant, and probes that depend on no number of a cell.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "scene_run.hpp"

using namespace seam_cli_test;

namespace {

/// Two blocks pressed onto each other.
std::string pressed(const std::string& down, const std::string& up) {
  return fmt::format(R"yaml(
title: Two blocks
dimension: 2
plugins: [solid, nitsche_fsci]
meshes:
  lower: {{grid: {{from: [0, 0], to: [1, 0.5], cells: [5, 3]}}}}
  upper: {{grid: {{from: [0, 0.5], to: [1, 1], cells: [8, 4]}}}}
fields:
  lower:
    type: solid
    mesh: lower
    material: {{type: neo_hookean, young: 100, poisson: 0.3}}
    boundary: [{{on: y_min, displacement: [null, 0]}}, {{on: [x_min, x_max], displacement: [0, null]}}]
  upper:
    type: solid
    mesh: upper
    material: {{type: neo_hookean, young: 30, poisson: 0.2}}
    boundary: [{{on: y_max, displacement: [null, "-0.1*t"]}}, {{on: [x_min, x_max], displacement: [0, null]}}]
interfaces:
  down: {{type: contact, from: upper, to: lower, boundaries: [y_min], opposite: [y_max]}}
  up: {{type: contact, from: lower, to: upper, boundaries: [y_max], opposite: [y_min]}}
coupling: [{{type: contact, on: down, stress: {}}}, {{type: contact, on: up, stress: {}}}]
output:
  fields: false
  probes:
    top: {{field: upper, on: y_max, quantity: reaction}}
    bottom: {{field: lower, on: y_min, quantity: reaction}}
time: {{static: true, end: 1, step: {{initial: 0.5}}}}
)yaml",
                     down, up);
}

/// Two rigid blocks, one of which falls on the other. @param low more of the lower one
std::string falling(const std::string& low, const std::string& looks) {
  return R"yaml(
title: Two rigid blocks
dimension: 2
plugins: [solid, nitsche_fsci]
meshes:
  lower: {grid: {from: [0, 0], to: [1, 0.5], cells: [2, 1]}}
  upper: {grid: {from: [0.2, 0.51], to: [0.8, 1], cells: [2, 1]}}
fields:
  low: {type: rigid_body, mesh: lower, density: 1, )yaml" +
         low + R"yaml(}
  high: {type: rigid_body, mesh: upper, density: 1, body_force: [0, -1]}
  low_skin: {type: rigid_surface, mesh: lower}
  high_skin: {type: rigid_surface, mesh: upper}
constraints: [{type: rigid, field: low_skin, body: low}, {type: rigid, field: high_skin, body: high}]
interfaces:
  down: {type: contact, from: high_skin, to: low_skin}
  up: {type: contact, from: low_skin, to: high_skin}
coupling: [)yaml" +
         looks + R"yaml(]
time: {end: 0.1, step: {initial: 0.1}}
)yaml";
}

std::string cavity(const std::string& boundary) {
  return R"yaml(
title: A box of fluid
dimension: 2
plugins: [cutfem_fluid]
meshes: {box: {grid: {from: [0, 0], to: [1, 1], cells: [6, 6]}}}
fields:
  water:
    type: cutfem_fluid
    mesh: box
    density: 1
    viscosity: 1
    boundary:
)yaml" + boundary +
         R"yaml(
time: {static: true, end: 1, step: {initial: 0.5}}
output: {fields: false, probes: {spin: {field: water, at: [0.5, 0.5], quantity: vorticity}}}
)yaml";
}

/// A free body that spins about an axis near its middle one.
std::string spinning(double shift) {
  return fmt::format(R"yaml(
title: A rigid block that spins
dimension: 3
plugins: [solid]
meshes:
  block: {{grid: {{from: [{0}-0.5, {0}-1, {0}-1.5], to: [{0}+0.5, {0}+1, {0}+1.5], cells: [2, 4, 6]}}}}
fields:
  block:
    type: rigid_body
    mesh: block
    density: 1
    initial: {{rotation_rate: [0.01, 1, 0.01]}}
time: {{theta: 0.5, end: 0.05, step: {{initial: 0.005}}}}
solver: {{newton: {{tolerance: 1e-11, increment_tolerance: 1e-9}}}}
output: {{fields: false, probes: {{turned: {{field: block, quantity: rotation}}}}}}
)yaml",
                     shift);
}

}  // namespace

TEST_CASE("of a pair of surfaces that look at each other one stress counts, not each its own",
          "[sanitized]") {
  for (const std::string same : {"own", "other"}) {
    const Run run(pressed(same, same));
    CHECK(run.done.code == 2);
    CHECK_THAT(run.done.output, Catch::Contains("forces do not balance") && Catch::Contains("scene.yaml:2"));
  }
  for (const auto& [down, up] : {std::pair{"own", "other"}, {"other", "own"}, {"both", "both"}}) {
    const Run run(pressed(down, up));
    CAPTURE(run.done.output);
    CHECK(run.done.code == 0);
    CHECK(run.series("top.y").back() == Approx(-run.series("bottom.y").back()).epsilon(1e-9));
  }
}

TEST_CASE("rigid bodies that look at each other push each other alike", "[sanitized]") {
  const std::string down = "{type: contact, on: down, surface_stiffness: 100",
                    up = ", {type: contact, on: up, surface_stiffness: ",
                    held = "translation: [0, 0], rotation: [0]", free = "stiffness: [1, 1]";
  const auto check = [](const std::string& low, const std::string& looks) {
    const Folder folder;
    return seam("check " + folder.file("scene.yaml", falling(low, looks)));
  };
  const Result differ = check(free, down + "}" + up + "1000}");
  CHECK(differ.code == 2);
  CHECK_THAT(differ.output, Catch::Contains("scene.yaml:17:57") &&
                                Catch::Contains("a `surface_stiffness` of 100 Pa/m where") &&
                                Catch::Contains("of 1000 Pa/m where that looks back") &&
                                Catch::Contains("forces do not balance") &&
                                Catch::Contains("expected the same in both"));
  const auto is_silent = [&](const std::string& low, const std::string& looks) {
    const Result result = check(low, looks);
    CAPTURE(low, looks, result.output);
    CHECK(result.code == 0);
    CHECK_THAT(result.output, !Catch::Contains("nothing pushes"));
  };
  is_silent(free, down + "}" + up + "50 + 50}");
  is_silent(free, down + ", acts_on: both}" + up + "1000, acts_on: both}");  // then forces balance

  const Result lost = check(free, down + "}");
  CHECK(lost.code == 0);
  CHECK_THAT(lost.output, Catch::Contains("warning: 'high_skin' is pushed by contact with 'low_skin'") &&
                              Catch::Contains("nothing pushes 'low_skin' back, which is free to move") &&
                              Catch::Contains("add an interface on which 'low_skin' looks at 'high_skin'"));
  // What is held, or moves as given, needs no push.
  is_silent(held, down + "}");
  is_silent("translation: [t, 0], rotation: [t]", down + "}");
  is_silent(free, down + ", acts_on: both, share: 1}");
}

TEST_CASE("boundaries that meet with different values: the last one counts, and the run says so") {
  const std::string lid = "      - {on: y_max, velocity: [\"t\", 0]}\n",
                    walls = "      - {on: [x_min, x_max, y_min], velocity: [0, 0]}\n";
  const Run tight(cavity(lid + walls)), leaky(cavity(walls + lid)),
      still(cavity("      - {on: [x_min, x_max, y_min, y_max], velocity: [0, 0]}\n"));
  CHECK(tight.done.code == 0);
  CHECK_THAT(tight.done.output, Catch::Contains("prescribe different values") && Catch::Contains("1 and 0") &&
                                    Catch::Contains("'y_max'"));
  CHECK_THAT(leaky.done.output, Catch::Contains("0 and 1"));
  CHECK(tight.series("spin").back() != Approx(leaky.series("spin").back()).epsilon(1e-3));
  CHECK(still.done.code == 0);
  CHECK_THAT(still.done.output, !Catch::Contains("different values"));
  CHECK(nlohmann::json::parse(tight.folder.read("out/summary.json"))["warnings"].size() == 2);
}

TEST_CASE("fluid that cannot get out of a closed box is refused") {
  const Run closed(
      cavity("      - {on: x_min, velocity: [\"t*y*(1 - y)\", 0]}\n      - {on: [x_max, y_min, y_max], "
             "velocity: [0, 0]}\n"));
  CAPTURE(closed.done.output);
  CHECK(closed.done.code != 0);
  CHECK_THAT(closed.done.output, Catch::Contains("water") && Catch::Contains("pressure"));
  const Run through(
      cavity("      - {on: [x_min, x_max], velocity: [\"t*y*(1 - y)\", 0]}\n      - {on: [y_min, y_max], "
             "velocity: [0, 0]}\n"));
  CAPTURE(through.done.output);
  CHECK(through.done.code == 0);
}

TEST_CASE("a probe where cells meet is the mean of what they have there") {
  // The lid drives a flow that is symmetric about x = 1/2, and so is its vorticity: that of one of the four
  // cells around the middle is not.
  const std::string lid =
      "      - {on: y_max, velocity: [\"t\", 0]}\n      - {on: [x_min, x_max, y_min], velocity: [0, 0]}\n";
  const std::string back =
      "      - {on: y_max, velocity: [\"-t\", 0]}\n      - {on: [x_min, x_max, y_min], velocity: [0, 0]}\n";
  const Run there(cavity(lid)), mirrored(cavity(back));
  CHECK(there.series("spin").back() == Approx(-mirrored.series("spin").back()).epsilon(1e-9));
}

TEST_CASE("a rigid body turns the same far from the origin") {
  const Run near(spinning(0)), far(spinning(1e6));
  REQUIRE(near.done.code == 0);
  REQUIRE(far.done.code == 0);
  for (const std::string name : {"turned.x", "turned.y", "turned.z"})
    CHECK(far.series(name).back() == Approx(near.series(name).back()).epsilon(1e-7));
}

TEST_CASE("a mesh that falls apart is named where its parts are not held") {
  const Folder folder;
  // Two squares without a common node.
  const std::string mesh = folder.file("two.msh", R"msh($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 "left"
2 2 "all"
$EndPhysicalNames
$Nodes
8
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 3 0 0
6 4 0 0
7 4 1 0
8 3 1 0
$EndNodes
$Elements
3
1 1 2 1 1 4 1
2 3 2 2 1 1 2 3 4
3 3 2 2 1 5 6 7 8
$EndElements
)msh");
  const auto done = seam("run " + folder.file("scene.yaml", R"yaml(
title: Two squares
dimension: 2
plugins: [solid]
meshes: {squares: {file: two.msh}}
fields:
  squares:
    type: solid
    mesh: squares
    material: {type: neo_hookean, young: 100, poisson: 0.3}
    density: 1
    boundary: [{on: left, displacement: [0, 0]}]
    body_force: [0, -1]
time: {static: true, end: 1}
output: {fields: false}
)yaml") + " --no-picture --folder " +
                         (folder.path / "out").string());
  CAPTURE(done.output);
  CHECK(done.code != 0);
  CHECK_THAT(done.output, Catch::Contains("2 parts that share no node"));
}

TEST_CASE("an iterative solver that stops short is not taken for a pressure that nothing holds") {
  const Folder folder;
  const auto short_of =
      seam("run " SEAM_SOURCE_DIR "/configs/fluid/cfd1.yaml --no-picture --quiet --folder " +
           (folder.path / "out").string() +
           " --set output.fields=false --set "
           "'solver.linear={type: krylov, tolerance: 1e-12, maximum_iterations: 3}'");
  CAPTURE(short_of.output);
  CHECK(short_of.code == 1);
  // The outflow holds the pressure: by the rows of the velocity.
  CHECK_THAT(short_of.output, Catch::Contains("after 3 iterations") && !Catch::Contains("is not held"));
}

TEST_CASE("an outline that crosses itself is refused") {
  const auto around = [](const std::string& corners) {
    return R"yaml(
title: A body
dimension: 2
plugins: [cutfem_fluid]
meshes: {box: {grid: {from: [0, 0], to: [1, 1], cells: [6, 6]}}}
fields: {water: {type: cutfem_fluid, mesh: box, density: 1, viscosity: 1}}
interfaces: {body: {type: cut, field: water, body: {type: outline, corners: [)yaml" +
           corners + R"yaml(]}}}
coupling: [{type: fluid_wall, on: body, velocity: [0, 0]}]
output: {fields: false}
)yaml";
  };
  // The area that the first encloses twice counts twice: it is positive.
  for (const std::string corners :
       {"{at: [0.3, 0.3]}, {at: [0.6, 0.3]}, {at: [0.6, 0.6]}, {at: [0.5, 0.2]}",
        "{at: [0.3, 0.3]}, {at: [0.6, 0.6]}, {at: [0.6, 0.3]}, {at: [0.3, 0.6000001]}"}) {
    const Run run(around(corners));
    CAPTURE(run.done.output);
    CHECK(run.done.code == 2);
    CHECK_THAT(run.done.output, Catch::Contains("the outline crosses itself"));
  }
  CHECK(Run(around("{at: [0.3, 0.3]}, {at: [0.6, 0.3]}, {at: [0.6, 0.6]}, {at: [0.5, 0.4]}")).done.code == 0);
}

TEST_CASE("what acts on mass is warned of where there is none") {
  const Folder folder;
  const auto output = [&](const std::string& more) {
    return seam("check " +
                folder.file(
                    "s.yaml",
                    "title: a body\ndimension: 2\nplugins: [solid]\nmeshes: {one: {grid: {from: [0, 0], to: "
                    "[1, 1], "
                    "cells: [1, 1]}}}\nfields:\n  one: {type: rigid_body, mesh: one, stiffness: [1, 1], "
                    "rotational_stiffness: 1" +
                        more + "}\ntime: {end: 1, step: {initial: 0.5}}\n"))
        .output;
  };
  CHECK_THAT(output(", body_force: [0, -1]"),
             Catch::Contains("s.yaml:6:94: warning: field 'one' has no `density`, so that its `body_force`"));
  CHECK_THAT(
      output(", initial: {velocity: [1, 0]}"),
      Catch::Contains("s.yaml:6:102: warning: field 'one' has no `density`, so that it does not go on with "
                      "the `velocity`"));
  CHECK_THAT(output(", density: 1, body_force: [0, -1], initial: {velocity: [1, 0]}"),
             !Catch::Contains("warning"));
  CHECK_THAT(output(", body_force: [0, 0]"), !Catch::Contains("warning"));
}

TEST_CASE("what is hardly meant of rigid bodies and of what is tied is warned of") {
  const auto warning = [](const std::string& change) {
    const Result done = seam("check " SEAM_SOURCE_DIR "/tests/mistakes/bodies.yaml" +
                             (change.empty() ? "" : " --set '" + change + "'"));
    CAPTURE(change, done.output);
    CHECK(done.code == 0);
    const auto from = done.output.find("warning: ");
    return from == std::string::npos ? "" : done.output.substr(from, done.output.find('\n', from) - from);
  };
  CHECK(warning("").empty());
  CHECK_THAT(
      warning("constraints.2={type: rigid, field: strut, body: lid}"),
      Catch::StartsWith("warning: all of field 'strut' is to follow 'lid', but for what is given on boundary "
                        "'x_min' (") &&
          Catch::EndsWith(
              "bodies.yaml:22:42): that stays, and the cells between are torn; leave what gives it "
              "out, or say `on`, the boundary that is to follow"));
  CHECK(warning("fields.skin.mesh=cart") ==
        "warning: the points of 'skin' are those of mesh 'cart', and 'arm', which they follow, has the shape "
        "of mesh "
        "'arm', which lies elsewhere or is of another size: what acts on the points acts on a body with "
        "another mass "
        "and centre; take one mesh for both");
  CHECK(warning("fields.skin.order=2") ==
        "warning: field 'skin' is of order 2 on a mesh of order 1, with straight edges: a rigid motion of "
        "these needs "
        "no more than order 1; for a surface that is curved give the mesh `order: 2`, too, else leave this "
        "out");
  CHECK(warning("constraints.0.motion=45 + 0.5*t") ==
        "warning: the `motion` of the hinge of 'arm' is 45 rad at the start, more than a whole turn, by `45 "
        "+ 0.5*t`: "
        "angles are in radians; where degrees are meant, multiply them by pi/180");
  CHECK(warning("constraints.0.motion=720*t") ==
        "warning: the `motion` of the hinge of 'arm' changes by 7.2 rad in the first step, of 0.01 s, more "
        "than half "
        "a turn, by `720*t`: angles are in radians; where degrees are meant, multiply them by pi/180, else "
        "take "
        "shorter steps");
  CHECK_THAT(
      warning("fields.cart.rotation=[30 + 0.1*t]"),
      Catch::StartsWith("warning: the `rotation` of 'cart' is 30 rad at the start, more than a whole turn"));
  CHECK(warning("constraints.0.motion=6 + 0.5*t").empty());
  CHECK(warning("constraints.3={type: tied, fields: [lower, upper], boundaries: [y_max, y_min]}") ==
        "warning: the coarser side is tied: nodes on 'y_max' of field 'lower' are 0.25 m apart, those on "
        "'y_min' of "
        "field 'upper', which they keep to, 0.125 m: what lies between the tied nodes follows nothing, and "
        "the fields "
        "part there; exchange the two, in `boundaries` as well");
  CHECK(warning("fields.lower.order=2").empty());
}
