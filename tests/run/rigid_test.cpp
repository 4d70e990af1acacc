// SPDX-License-Identifier: BSD-3-Clause
// Rigid bodies whose surface is cut out of a fluid, free to move and turn.
#include <algorithm>
#include <array>
#include <cmath>

#include "scene_run.hpp"

using namespace seam_cli_test;
using Catch::Matchers::Contains;

namespace {

const std::string unchecked = "--set 'checks=[]' --set 'output.statistics={}' ";

}  // namespace

TEST_CASE("a free disc in a shear flow turns with half its rate") { ShippedRun("fsi/turning_disc"); }

TEST_CASE("the points of a body that moves at the start have its velocity from then on") {
  const Run run(R"yaml(
title: A block that flies and turns
dimension: 2
plugins: [solid]
meshes: {block: {grid: {from: [0, 0], to: [2, 1], cells: [2, 2]}}}
fields:
  block: {type: rigid_body, mesh: block, density: 1, initial: {velocity: [0.3, 0], rotation_rate: [0.2]}}
  skin: {type: rigid_surface, mesh: block}
constraints: [{type: rigid, field: skin, body: block}]
time: {theta: 0.5, end: 1, step: {initial: 0.05}}
output:
  fields: false
  probes: {corner: {field: skin, at: [2, 1], quantity: velocity}}
)yaml",
                "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  // v + omega x arm, the arm of (1, 1/2) turned by 0.2 t.
  const std::vector<double> x = run.series("corner.x"), y = run.series("corner.y");
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double angle = 0.2 * 0.05 * static_cast<double>(k), c = std::cos(angle), s = std::sin(angle);
    CHECK(x[k] == Approx(0.3 - 0.2 * (s + 0.5 * c)).margin(1e-5));
    CHECK(y[k] == Approx(0.2 * (c - 0.5 * s)).margin(1e-5));
  }
}

TEST_CASE("so does a ball", "[study]") { ShippedRun("fsi/turning_ball", "--set parameters.n=6"); }

TEST_CASE("a disc between walls takes Faxen's force", "[study]") {
  const ShippedRun shipped("fsi/towed_disc");
  // At order 1 the error falls with the cells.
  const auto speed = [](const std::string& options) {
    return ShippedRun("fsi/towed_disc", unchecked + "--set parameters.order=1 " + options)("speed");
  };
  const double coarse = std::abs(speed("--set parameters.n=20") - 1),
               fine = std::abs(speed("--set parameters.n=40") - 1);
  CAPTURE(coarse, fine);
  CHECK(fine < 0.01);
  CHECK(fine < 0.6 * coarse);
}

TEST_CASE("a disc that settles does so alike on all numbers of ranks") {
  const ShippedRun shipped("fsi/settling_disc");
  const std::string two_steps = unchecked + "--set time.end=0.06 ";
  const ShippedRun one("fsi/settling_disc", two_steps);
  CHECK(std::abs(one("angle")) > 1e-6);
  for (const char* ranks : {"2", "3"}) {
    const ShippedRun several("fsi/settling_disc", two_steps,
                             std::string("mpirun --oversubscribe -np ") + ranks);
    CHECK(difference(one.csv, several.csv, 1e-6) < 1e-8);
  }
}

TEST_CASE("a disc touches a slope alike on all numbers of ranks, and after a restart") {
  const std::string short_fall = unchecked + "--set parameters.gap=0.002 ";
  const ShippedRun one("fsi/slope_disc", short_fall + "--set time.end=0.12");
  CHECK(one("angle") < -1e-3);
  CHECK(one("disc.contact_area") > 0.01);
  for (const char* ranks : {"2", "3"}) {
    const ShippedRun several("fsi/slope_disc", short_fall + "--set time.end=0.12",
                             std::string("mpirun --oversubscribe -np ") + ranks);
    CHECK(difference(one.csv, several.csv, 1e-6) < 1e-8);
  }
  // Stopped just before it touches, and resumed on two ranks.
  const Folder folder;
  const std::string run = "run " SEAM_SOURCE_DIR
                          "/configs/fsi/slope_disc.yaml --no-picture --quiet --folder " +
                          (folder.path / "out").string() + " --set output.fields=false " + short_fall;
  REQUIRE(seam(run + "--set time.end=0.04").code == 0);
  REQUIRE(seam(run + "--set time.end=0.12 --resume --changed", "mpirun --oversubscribe -np 2").code == 0);
  CHECK(difference(one.csv, folder.read("out/series.csv"), 1e-6) < 1e-8);
}

TEST_CASE("a chain lands on a slope alike on all numbers of ranks") {
  // The block lands flat; the arm behind it comes near the slope, and what is tied to it near other ranks.
  const auto series = [](const std::string& ranks) {
    const Run run(R"yaml(
title: Two blocks on a hinge fall onto a slope
dimension: 2
plugins: [solid, nitsche_fsci]
parameters: {alpha: pi/9, gap: 0.002, c: cos(alpha), s: sin(alpha)}
meshes:
  block: {grid: {from: [0, 0], to: [0.4, 0.2], cells: [4, 2], map: ["c*x + s*(y + gap)", "-s*x + c*(y + gap)"]}}
  arm: {grid: {from: [0.4, 0.1], to: [0.7, 0.2], cells: [4, 2], map: ["c*x + s*(y + gap)", "-s*x + c*(y + gap)"]}}
fields:
  block: {type: rigid_body, mesh: block, density: 100, body_force: [0, -9.81]}
  skin: {type: rigid_surface, mesh: block}
  arm: {type: rigid_body, mesh: arm, density: 100, body_force: [0, -9.81]}
  arm_skin: {type: rigid_surface, mesh: arm}
constraints:
  - {type: rigid, field: skin, body: block}
  - {type: rigid, field: arm_skin, body: arm}
  - {type: joint, kind: hinge, body: arm, to: block, at: ["c*0.4 + s*(0.15 + gap)", "-s*0.4 + c*(0.15 + gap)"]}
interfaces:
  floor: {type: obstacle, from: skin, body: {type: box, from: [-1, -1], to: [4, 0]}, motion: {rotation: -alpha}, reach: 0.1, depth: 0.05}
  arm_floor: {type: obstacle, from: arm_skin, body: {type: box, from: [-1, -1], to: [4, 0]}, motion: {rotation: -alpha}, reach: 0.1, depth: 0.05}
coupling:
  - {type: contact, on: floor, surface_stiffness: 1e5}
  - {type: contact, on: arm_floor, surface_stiffness: 1e5}
time: {theta: 0.5, end: 0.04, step: {initial: 0.004}}
solver: {newton: {tolerance: 1e-11}}
output:
  fields: false
  probes:
    middle: {field: block, quantity: translation}
    angle: {field: block, quantity: rotation}
    arm_angle: {field: arm, quantity: rotation}
)yaml",
                  "--quiet", ranks);
    CAPTURE(ranks, run.done.output);
    REQUIRE(run.done.code == 0);
    const std::vector<double> area = run.series("floor.area");
    CHECK(*std::ranges::max_element(area) == Approx(0.4));
    CHECK(run.series("arm_floor.gap").front() > 1);
    CHECK(run.series("arm_floor.gap").back() < 0.1);
    return run.folder.read("out/series.csv");
  };
  const std::string one = series("");
  for (const std::string ranks : {"2", "3"})
    CHECK(difference(one, series("mpirun --oversubscribe -np " + ranks)) < 1e-10);
}

TEST_CASE("a ball falls through a fluid onto a wall, which then carries its weight", "[study]") {
  const ShippedRun run("fsi/falling_ball", unchecked +
                                               "--set parameters.n=2 --set parameters.gap=0.01 "
                                               "--set parameters.end=0.4 --set parameters.step=0.1");
  CHECK(run("balance") == Approx(1).epsilon(1e-3));
  CHECK(run("carried") == Approx(1).epsilon(1e-2));
  // Weight, surface stiffness and the volume of the cap behind the wall.
  CHECK(run("ball.gap") == Approx(-std::sqrt(6 * 0.2 / (0.2 * 2e5))).epsilon(0.04));
}

TEST_CASE("what a weight does that settles goes into motion and heat, the more so the finer the cells",
          "[study]") {
  const auto loss = [](const std::string& cells) {
    const ShippedRun run("fsi/settling_disc",
                         "--set 'checks=[]' --set parameters.m=12 --set parameters.n=" + cells);
    const std::vector<double> time = run.series("time"), heating = run.series("water.dissipation");
    double heat = 0;
    for (std::size_t k = 1; k < time.size(); ++k)
      heat += (time[k] - time[k - 1]) * (heating[k - 1] + heating[k]) / 2;
    CHECK(run("work") > 0.005);
    return 1 - (run("motion") + heat) / run("work");
  };
  const double coarse = loss("20"), fine = loss("40");
  CAPTURE(coarse, fine);
  CHECK(std::abs(fine) < 0.04);
  CHECK(std::abs(fine) < 0.5 * std::abs(coarse));
}

TEST_CASE("a disc of a hundredth of the fluid's density rises without instability at any step", "[study]") {
  double last = 0;
  for (const char* step : {"0.03", "0.01", "0.005"}) {
    const ShippedRun run("fsi/settling_disc", unchecked +
                                                  "--set parameters.n=30 --set parameters.ratio=0.01 "
                                                  "--set parameters.end=0.12 --set parameters.step=" +
                                                  step);
    const std::vector<double> height = run.series("centre.y"), time = run.series("time");
    CAPTURE(step, height);
    // It only ever rises, and ever faster while it starts.
    double before = 0;
    for (std::size_t k = 1; k < height.size(); ++k) {
      const double speed = (height[k] - height[k - 1]) / (time[k] - time[k - 1]);
      CHECK(speed > 0.9 * before);
      before = speed;
    }
    if (last > 0) CHECK(height.back() == Approx(last).epsilon(0.06));
    last = height.back();
  }
}

TEST_CASE("a rotation that is given and not 0 at the start turns the body, in space as in the plane") {
  const auto corner = [](const std::string& space, const std::string& rotation, const std::string& time) {
    const bool plane = space == "2";
    const Run run("title: A block that is turned\ndimension: " + space +
                      "\nplugins: [solid]\nmeshes: {block: {grid: " +
                      (plane ? "{from: [0, 0], to: [2, 1], cells: [2, 1]}"
                             : "{from: [0, 0, 0], to: [2, 1, 1], cells: [2, 1, 1]}") +
                      "}}\nfields:\n  block: {type: rigid_body, mesh: block, density: 1, translation: [0, 0" +
                      (plane ? "" : ", 0") + "], rotation: [" + (plane ? "" : "0, 0, ") + rotation +
                      "]}\n  skin: {type: rigid_surface, mesh: block}\n"
                      "constraints: [{type: rigid, field: skin, body: block}]\ntime: " +
                      time + "\noutput: {fields: false, probes: {corner: {field: skin, at: [2, 1" +
                      (plane ? "" : ", 1") + "], quantity: displacement}}}\n",
                  "--quiet");
    CAPTURE(run.done.output);
    REQUIRE(run.done.code == 0);
    return std::pair(run.series("corner.x"), run.series("corner.y"));
  };
  const std::string dynamic = "{theta: 1, end: 1, step: {initial: 0.25}}";
  for (const auto& [rotation, rate] : {std::pair("pi/4", 0.0), std::pair("'pi/4 + t'", 1.0)}) {
    const auto plane = corner("2", rotation, dynamic), space = corner("3", rotation, dynamic);
    REQUIRE(space.first.size() == 5);
    for (std::size_t k = 0; k < 5; ++k) {
      // The arm of the corner is (1, 1/2).
      const double angle = std::acos(-1.0) / 4 + rate * 0.25 * static_cast<double>(k);
      CAPTURE(rotation, k);
      CHECK(space.first[k] == Approx(std::cos(angle) - std::sin(angle) / 2 - 1).epsilon(1e-10));
      CHECK(space.second[k] == Approx(std::sin(angle) + std::cos(angle) / 2 - 0.5).epsilon(1e-10));
      CHECK(plane.first[k] == Approx(space.first[k]).epsilon(1e-10));
      CHECK(plane.second[k] == Approx(space.second[k]).epsilon(1e-10));
    }
  }
  const std::string still = "{static: true, end: 1, step: {initial: 0.5}}";
  CHECK(corner("3", "pi/4", still).second.back() ==
        Approx(corner("2", "pi/4", still).second.back()).epsilon(1e-10));
}

TEST_CASE("a block keeps its energy and momentum over a hundred turns about its middle axis", "[study]") {
  ShippedRun("solid/spinning_block", "--set parameters.turns=100");
}

TEST_CASE("a pendulum's period is right to second order") {
  const auto late = [](const std::string& steps) {
    return std::abs(ShippedRun("solid/pendulum", unchecked + "--set parameters.steps=" + steps)("late"));
  };
  const double coarse = late("100"), fine = late("200");
  CAPTURE(coarse, fine);
  CHECK(coarse < 2e-3);
  CHECK(coarse / fine == Approx(4).epsilon(0.1));
}

TEST_CASE("a rigid body that cannot be is refused, with the key's place") {
  const auto refused = [](const std::string& space, const std::string& keys) {
    const Run run("title: A block\ndimension: " + space + "\nplugins: [solid]\nmeshes: {block: {grid: " +
                      (space == "2" ? "{from: [0, 0], to: [1, 1], cells: [1, 1]}"
                                    : "{from: [0, 0, 0], to: [1, 1, 1], cells: [1, 1, 1]}") +
                      "}}\nfields:\n  block:\n    type: rigid_body\n    mesh: block\n    density: 1\n    " +
                      keys + "\ntime: {theta: 1, end: 1, step: {initial: 0.5}}\noutput: {fields: false}\n",
                  "--quiet");
    CHECK(run.done.code == 2);
    return run.done.output;
  };
  CHECK_THAT(refused("3", "initial: {rotation_rate: [1]}"),
             Contains("scene.yaml:10:30: error: `rotation_rate` needs 3 entries, found 1"));
  CHECK_THAT(refused("3", "initial: {rotation_rate: [1, 0, 0, 0]}"), Contains("needs 3 entries, found 4"));
  CHECK_THAT(refused("2", "initial: {rotation_rate: [1, 0, 0]}"), Contains("needs 1 entries, found 3"));
  CHECK_THAT(refused("3", "initial: {velocity: [1, 0]}"),
             Contains("scene.yaml:10") && Contains("velocity: ") && Contains("a list of 3 numbers"));
  CHECK_THAT(refused("3", "moment: [1]"), Contains("`moment` needs 3 entries, found 1"));
  for (const std::string force : {"[0, x^2]", "[(x - 0.5)*(y - 0.5), -9.81]", "[0, sqrt(y - 0.5)]"})
    CHECK_THAT(
        refused("2", "body_force: " + force),
        Contains("scene.yaml:10:17: error: the `body_force` of a rigid body is one force per mass for all of "
                 "it") &&
            Contains("` varies in space; give what it adds up to over the body, as `force` and `moment`"));
  for (const std::string key : {"stiffness", "damping"})
    CHECK_THAT(refused("2", key + ": [-1, 0]"),
               Contains("scene.yaml:10") && Contains(key + "[0]: -1 is out of range, expected at least 0"));
}

TEST_CASE("what springs couple swings right to second order") {
  const auto off = [](const std::string& steps) {
    const ShippedRun run("solid/coupled_blocks", unchecked + "--set parameters.steps=" + steps);
    const std::vector<double> length = run.series("length"), swing = run.series("swing");
    return std::array{*std::ranges::max_element(length), *std::ranges::max_element(swing)};
  };
  const auto coarse = off("100"), fine = off("200");
  for (int k = 0; k < 2; ++k) {
    CAPTURE(coarse[k], fine[k]);
    CHECK(coarse[k] < 1e-2);
    CHECK(coarse[k] / fine[k] == Approx(4).epsilon(0.1));
  }
}

TEST_CASE("springs that cannot be are refused, with their places") {
  const auto refused = [](const std::string& link, const std::string& coupling) {
    const Run run(R"yaml(
title: Two bars
dimension: 2
plugins: [solid]
meshes:
  one: {grid: {from: [0, 0], to: [1, 0.2], cells: [1, 1]}}
  two: {grid: {from: [1, 0], to: [2, 0.2], cells: [1, 1]}}
fields:
  one: {type: rigid_body, mesh: one, density: 1, body_force: [0, -1]}
  two: {type: rigid_body, mesh: two, density: 1}
  soft: {type: solid, mesh: two, material: {type: neo_hookean, young: 50, poisson: 0.3}, boundary: [{on: x_min, displacement: [0, 0]}]}
interfaces: {link: {type: link, fields: )yaml" +
                      link + "}}\ncoupling:\n  - {on: link, " + coupling +
                      "}\ntime: {theta: 1, end: 1, step: {initial: 0.5}}\noutput: {fields: false}\n",
                  "--quiet");
    CHECK(run.done.code == 2);
    return run.done.output;
  };
  const std::string turn = "type: torsional_spring, stiffness: 1", line = "type: spring, stiffness: 1";
  CHECK_THAT(refused("[one, soft]", turn), Contains("'soft' is none") && Contains("scene.yaml:12"));
  CHECK_THAT(refused("[one, one]", turn), Contains("with itself"));
  CHECK_THAT(refused("[one, two, soft]", turn), Contains("found 3"));
  CHECK_THAT(refused("[one, two]", turn + ", axis: [1, 0]"), Contains("scene.yaml:14") && Contains("`axis`"));
  CHECK_THAT(refused("[one, two]", line + ", at: [0, 0], to_at: [0, 0], rest_length: 1"),
             Contains("points that coincide"));
  CHECK_THAT(refused("[one, two]", line + ", at: [0, 0, 0], to_at: [0, 0]"), Contains("a list of 2 numbers"));
  CHECK_THAT(refused("[one, two]", line + ", at: [0, 0], to_at: [0, 0], damping: -1"), Contains("damping"));
}

TEST_CASE("a bar that hangs at a boundary of a deformable body balances on it") {
  const Run run(R"yaml(
title: A bar below a block that is held on the left
dimension: 2
plugins: [solid]
meshes:
  block: {grid: {from: [0, 0], to: [1, 0.4], cells: [4, 3]}}
  bar: {grid: {from: [0.95, -0.7], to: [1.25, -0.1], cells: [1, 2]}}
fields:
  block: {type: solid, mesh: block, material: {type: neo_hookean, young: 50, poisson: 0.3}, boundary: [{on: x_min, displacement: [0, 0]}]}
  bar: {type: rigid_body, mesh: bar, force: [0, -2*t]}
constraints: [{type: joint, kind: hinge, body: bar, to: block, on: x_max}]
time: {end: 1, step: {initial: 0.25}}
solver: {newton: {tolerance: 1e-12}}
output:
  fields: false
  probes:
    held: {field: block, on: x_min, quantity: reaction}
    end: {field: block, on: x_max, quantity: displacement}
    bar: {field: bar, quantity: translation}
    angle: {field: bar, quantity: rotation}
)yaml",
                "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  const auto last = [&](const std::string& name) { return run.series(name).back(); };
  // All of the weight goes through the hinge into the wall, and nothing else does.
  CHECK(std::abs(last("held.y")) == Approx(2).epsilon(1e-10));
  CHECK(std::abs(last("held.x")) < 1e-10);
  // The middle of the bar is below the hinge, the middle of the boundary: 0.1 beside and 0.6 below it at
  // first.
  const double x = last("end.x") / 0.4, y = last("end.y") / 0.4;
  CHECK(std::abs(y) > 0.05);
  CHECK(std::abs(1.1 + last("bar.x") - (1 + x)) < 1e-10);
  CHECK(-0.4 + last("bar.y") == Approx(0.2 + y - std::hypot(0.1, 0.6)).epsilon(1e-10));
  CHECK(last("angle") == Approx(-std::atan2(0.1, 0.6)).epsilon(1e-9));
}

TEST_CASE("a bar that nothing but rounding keeps from turning is refused, and one that hangs is not") {
  const auto bar = [](const std::string& grid, const std::string& time) {
    return Run("title: A bar on a hinge\ndimension: 2\nplugins: [solid]\nmeshes: {bar: {grid: {" + grid +
                   R"yaml(, cells: [10, 1]}}}
fields:
  bar: {type: rigid_body, mesh: bar, force: [0, -9.81]}
constraints: [{type: joint, kind: hinge, body: bar, at: [0, 0]}]
output: {fields: false, probes: {angle: {field: bar, quantity: rotation}}}
time: )yaml" + time,
               "--quiet");
  };
  for (const std::string time : {"{static: true, end: 1}", "{end: 1, step: {initial: 0.5}}"}) {
    const Run balanced = bar("from: [0, -0.05], to: [1, 0.05]", time);
    CHECK(balanced.done.code == 1);
    CHECK_THAT(balanced.done.output,
               Contains("scene.yaml:6:8: error: the matrix is singular but for rounding: in iteration 1 the "
                        "rotation of field 'bar' at (0.5, ") &&
                   Contains(") would change by -1.8e+16 rad, and more than 1e+06 rad is no solution"));
    if (time.find("static") == std::string::npos) continue;
    const Result checked = seam("check " + (balanced.folder.path / "scene.yaml").string());
    CHECK(checked.code == 2);
    CHECK_THAT(checked.output, Contains("scene.yaml:6:8: error: the matrix is singular but for rounding"));
  }
  const Run hangs = bar("from: [0, -1], to: [0.02, -0.05]", "{static: true, end: 1}");
  CAPTURE(hangs.done.output);
  REQUIRE(hangs.done.code == 0);
  CHECK(hangs.series("angle").back() == Approx(std::atan2(-0.01, 0.525)).epsilon(1e-9));
}

TEST_CASE("joints and ties of points that cannot be are refused, with their places") {
  const auto refused = [](const std::string& constraints, const std::string& keys = "") {
    const Run run(R"yaml(
title: Two bars
dimension: 2
plugins: [solid]
meshes:
  one: {grid: {from: [0, 0], to: [1, 0.2], cells: [1, 1]}}
  two: {grid: {from: [1, 0], to: [2, 0.2], cells: [1, 1]}}
fields:
  one: {type: rigid_body, mesh: one, density: 1, body_force: [0, -1]}
  two: {type: rigid_body, mesh: two, density: 1)yaml" +
                      keys + R"yaml(}
  soft: {type: solid, mesh: one, material: {type: neo_hookean, young: 50, poisson: 0.3}, boundary: [{on: x_min, displacement: [0, 0]}]}
constraints:
)yaml" + constraints + "\ntime: {theta: 1, end: 1, step: {initial: 0.5}}\noutput: {fields: false}\n",
                  "--quiet");
    CHECK(run.done.code != 0);
    return run.done.output;
  };
  const std::string first = "  - {type: joint, kind: hinge, body: two, at: [2, 0]}\n";
  const std::string twice =
      refused(first + "  - {type: joint, kind: hinge, body: two, to: one, at: [1, 0]}\n");
  CHECK_THAT(twice, Contains("scene.yaml:14:5: error: 'two' is held by a second joint; the first one ") &&
                        Contains("scene.yaml:13. A body has one joint; hold the others to it"));
  CHECK_THAT(refused("  - {type: joint, kind: hinge, body: two, to: one, at: [1, 0]}\n"
                     "  - {type: joint, kind: hinge, body: one, to: two, at: [0, 0]}\n"),
             Contains("scene.yaml:14:5: error: 'one' is held to 'two', which is held to 'one': joints cannot "
                      "form a loop; close it by a `spring` on a `link`"));
  CHECK_THAT(refused("  - {type: joint, kind: hinge, body: one, to: one, at: [1, 0]}\n"),
             Contains("'one' is held to 'one': joints cannot form a loop"));
  CHECK_THAT(refused(first, ", translation: [0, 0], rotation: [0]"),
             Contains("this joint cannot hold 'two'") && Contains("scene.yaml:13"));
  CHECK_THAT(refused("  - {type: joint, kind: slide, body: two, at: [2, 0]}\n"),
             Contains("needs the direction `axis`"));
  CHECK_THAT(refused("  - {type: joint, kind: hinge, body: two}\n"), Contains("needs the point `at`"));
  CHECK_THAT(refused("  - {type: joint, kind: slide, body: two, at: [2, 0], axis: [0, 0]}\n"),
             Contains("has no direction"));
  CHECK_THAT(refused("  - {type: joint, kind: hinge, body: two, at: [2, 0], axis: [0, 1]}\n"),
             Contains("in the plane a hinge has no `axis`"));
  CHECK_THAT(refused("  - {type: joint, kind: weld, body: two, at: [2, 0], motion: t}\n"),
             Contains("a weld has neither"));
  CHECK_THAT(refused("  - {type: joint, kind: hinge, body: two, to: one, on: x_max, at: [1, 0]}\n"),
             Contains("displacement") || Contains("middle"));
  CHECK_THAT(
      refused("  - {type: rigid, field: soft, on: x_min, body: two}\n"),
      Contains("scene.yaml:13:36: error: all of the displacement on boundary 'x_min' of field 'soft' is "
               "given, so that nothing there can follow 'two'"));
  CHECK_THAT(refused("  - {type: joint, kind: hinge, body: two, to: soft, at: [1, 0]}\n"),
             Contains("scene.yaml:13:47: error: 'soft' is no `rigid_body`: a joint to a body that deforms "
                      "needs `on`, the boundary of it that is to hold 'two'"));
}

TEST_CASE("a surface that follows no body is found before the first step, in a flow and without") {
  const auto refused = [](const std::string& fluid, const std::string& coupling) {
    const Folder folder;
    const Result done = seam("check " + folder.file("scene.yaml", R"yaml(
title: A disc whose constraint was forgotten
dimension: 2
plugins: [cutfem_fluid, solid, nitsche_fsci]
meshes:
  box: {grid: {from: [0, 0], to: [1, 1], cells: [6, 6]}}
  block: {grid: {from: [0.3, 0.3], to: [0.7, 0.7], cells: [3, 3]}}
fields:
  block: {type: rigid_body, mesh: block, density: 2}
  skin: {type: rigid_surface, mesh: block}
)yaml" + fluid + coupling + R"yaml(
time: {theta: 1, end: 1, step: {initial: 0.5}}
output: {fields: false}
)yaml"));
    CHECK(done.code == 2);
    return done.output;
  };
  CHECK_THAT(refused("", ""), Contains("field 'skin' is not held") &&
                                  Contains("tie it to one (`constraints`, as {type: rigid} ties a"));
  CHECK_THAT(
      refused("  water: {type: cutfem_fluid, mesh: box, density: 1, viscosity: 1, boundary: [{on: [x_min, "
              "x_max, y_min, y_max], velocity: [0, 0]}]}\n",
              "interfaces: {gamma: {type: embedded, field: water, body: skin}}\n"
              "coupling: [{type: fsi, on: gamma}]\n"),
      Contains(
          "field 'skin': nothing resists at 4 of its nodes if its displacement changes there, as at (") &&
          Contains("tie it there (`constraints`, as {type: rigid} ties a"));
}

TEST_CASE("a motion at the start that a joint does not let go is refused") {
  const auto run = [](const std::string& initial, const std::string& motion) {
    return Run(R"yaml(
title: A bar on a hinge
dimension: 2
plugins: [solid]
meshes: {bar: {grid: {from: [0, 0], to: [1, 0.2], cells: [1, 1]}}}
fields:
  bar: {type: rigid_body, mesh: bar, density: 1, initial: )yaml" +
                   initial + "}\nconstraints: [{type: joint, kind: hinge, body: bar, at: [0, 0]" + motion +
                   "}]\ntime: {theta: 1, end: 0.1, step: {initial: 0.1}}\noutput: {fields: false}\n",
               "--quiet");
  };
  const std::string refused = run("{velocity: [0, 5]}", "").done.output;
  CHECK_THAT(refused, Contains("scene.yaml:7:8: error: field 'bar' is to start with 5 as a rate of its "
                               "'translation' (`initial`), and the constraint that ties it leaves 0"));
  CHECK_THAT(run("{velocity: [1, 5], rotation_rate: [10]}", "").done.output,
             Contains("with 1 as a rate") && Contains("leaves -1;"));
  // The hinge is 0.5 beside and 0.1 below the centre.
  for (const std::string goes : {"{velocity: [-1, 5], rotation_rate: [10]}", "{rotation_rate: [10]}"}) {
    const Run free = run(goes, "");
    CAPTURE(goes, free.done.output);
    REQUIRE(free.done.code == 0);
    CHECK(free.series("bar.kinetic_energy").front() == Approx(0.1 * 1.04 / 3 * 100).epsilon(1e-10));
  }
  CHECK(run("{velocity: [-0.1, 0.5], rotation_rate: [1]}", ", motion: t").done.code == 0);
}

TEST_CASE("a joint holds a body of any size") {
  const auto turned = [](const std::string& size) {
    const Run run("title: A crank\ndimension: 2\nplugins: [solid]\nparameters: {s: " + size + R"yaml(}
meshes: {crank: {grid: {from: [0, 0], to: [2*s, s], cells: [2, 1]}}}
fields: {crank: {type: rigid_body, mesh: crank, density: 1, translation: [0.03*s*t, null]}}
constraints: [{type: joint, kind: hinge, body: crank, at: [0.3*s, 0.2*s]}]
time: {theta: 1, end: 1, step: {initial: 0.1}}
output: {fields: false, probes: {angle: {field: crank, quantity: rotation}}}
)yaml",
                  "--quiet");
    CAPTURE(run.done.output);
    REQUIRE(run.done.code == 0);
    return run.series("angle").back();
  };
  // The hinge is 0.7 beside and 0.3 below the centre, which goes by 0.03.
  const double arm = std::hypot(0.7, 0.3), angle = std::acos(0.73 / arm) - std::acos(0.7 / arm);
  for (const char* size : {"1", "1e-8", "1e8"}) {
    CAPTURE(size);
    CHECK(turned(size) == Approx(angle).epsilon(1e-8));
  }
  // Drawn on, out of the hinge's reach.
  const Run run(R"yaml(
title: A crank
dimension: 2
plugins: [solid]
meshes: {crank: {grid: {from: [0, 0], to: [2, 1], cells: [2, 1]}}}
fields: {crank: {type: rigid_body, mesh: crank, density: 1, translation: [0.1*t, null]}}
constraints: [{type: joint, kind: hinge, body: crank, at: [0.3, 0.2]}]
time: {theta: 1, end: 1, step: {initial: 0.1, minimum: 0.01}}
output: {fields: false}
)yaml",
                "--quiet");
  CAPTURE(run.done.output);
  CHECK(run.done.code == 1);
  CHECK_THAT(run.done.output,
             Contains("forces are in balance, but '") && Contains(" of field 'crank' at (1, 0.5) is ") &&
                 Contains(" from where it is tied to; what it is tied to may be out of its reach"));
}

TEST_CASE("a given motion that is no number ends the run, and names what gives it") {
  const auto ended = [](const std::string& body, const std::string& joint) {
    const Run run(R"yaml(
title: A bar that is moved
dimension: 2
plugins: [solid]
meshes: {bar: {grid: {from: [0, 0], to: [1, 0.2], cells: [1, 1]}}}
fields:
  bar: {type: rigid_body, mesh: bar, density: 1)yaml" +
                      body + "}\n" + joint +
                      "\ntime: {theta: 1, end: 1, step: {initial: 0.5}}\noutput: {fields: false}\n",
                  "--quiet");
    CHECK((run.done.code == 1 || run.done.code == 2));
    return run.done.output;
  };
  const auto joint = [](const std::string& motion) {
    return "constraints:\n  - {type: joint, kind: hinge, body: bar, at: [0, 0.1], motion: " + motion + "}";
  };
  const std::string holds = "the `motion` of the joint that holds 'bar' is ";
  CHECK_THAT(ended("", joint("sqrt(0.7 - t)")), Contains("scene.yaml:9:65: error: " + holds) &&
                                                    Contains("nan at (0, 0.1), t = 1: `sqrt(0.7 - t)`"));
  CHECK_THAT(ended("", joint("\"t < 0.6 ? 0.1*t : 1/0\"")), Contains(holds + "inf at (0, 0.1), t = 0.6"));
  CHECK_THAT(ended("", joint("log(t)")), Contains(holds + "-inf at (0, 0.1), t = 0"));
  CHECK_THAT(ended(", translation: [1/(1 - t), 0]", ""),
             Contains("the value given for 'translation' of field 'bar' is inf at (0.5, 0.1), t = 1: ") &&
                 !Contains("boundary"));
}

TEST_CASE("what presses on rigid bodies must have a stiffness, and only one") {
  const auto contact = [](const std::string& stiffness) {
    return Run(R"yaml(
title: A block on the ground
dimension: 2
plugins: [solid, nitsche_fsci]
meshes: {block: {grid: {from: [0, 0], to: [1, 0.5], cells: [2, 1]}}}
fields:
  block: {type: rigid_body, mesh: block, density: 1, body_force: [0, -1]}
  skin: {type: rigid_surface, mesh: block}
  soft: {type: solid, mesh: block, material: {type: neo_hookean, young: 50, poisson: 0.3}}
constraints: [{type: rigid, field: skin, body: block}]
interfaces:
  floor: {type: obstacle, from: skin, body: {type: box, from: [-1, -1], to: [2, 0.01]}}
  also: {type: obstacle, from: soft, body: {type: box, from: [-1, -1], to: [2, 0.01]}}
coupling:
  - {type: contact, on: )yaml" +
                   stiffness +
                   "}\ntime: {theta: 1, end: 0.1, step: {initial: 0.1}}\noutput: {fields: false}\n",
               "--quiet")
        .done.output;
  };
  CHECK_THAT(contact("floor"), Contains("give a `surface_stiffness`"));
  CHECK_THAT(contact("also, surface_stiffness: 5"), Contains("is for two rigid bodies"));
  CHECK_THAT(contact("floor, surface_stiffness: 5, adjoint: symmetric"), Contains("no adjoint term"));
}

TEST_CASE("the moment of a contact is what it turns a body with, where that is now") {
  const Run run(R"yaml(
title: A bar on a hinge, a spring and a stop
dimension: 2
plugins: [solid, nitsche_fsci]
meshes: {bar: {grid: {from: [0, 0], to: [1, 0.2], cells: [10, 2]}}}
fields:
  bar: {type: rigid_body, mesh: bar, density: 1, body_force: [0, -t], rotational_stiffness: 0.3}
  skin: {type: rigid_surface, mesh: bar}
constraints:
  - {type: rigid, field: skin, body: bar}
  - {type: joint, kind: hinge, body: bar, at: [0, 0.1]}
interfaces: {stop: {type: obstacle, from: skin, body: {type: box, from: [0.83, -1], to: [1.5, 0.02]}}}
coupling: [{type: contact, on: stop, surface_stiffness: 10}]
time: {static: true, end: 1, step: {initial: 0.1}}
solver: {newton: {tolerance: 1e-12}}
output:
  fields: false
  probes:
    moment: {interface: stop, quantity: moment, about: [0, 0.1]}
    angle: {field: bar, quantity: rotation}
)yaml",
                "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  // About the hinge, of what the bar exerts: its weight's moment less that of its spring.
  const double angle = run.series("angle").back();
  CHECK(angle < -0.03);
  CHECK(-run.series("moment").back() == Approx(0.2 * 0.5 * std::cos(angle) + 0.3 * angle).epsilon(1e-9));
}

TEST_CASE("a rigid block slides on a slope as bodies fall") { ShippedRun("contact/sliding_block"); }

TEST_CASE("the surface of a body in space turns with it, by any angle") {
  const Run run(R"yaml(
title: A cube spins about an axis across its own
dimension: 3
plugins: [solid]
meshes: {cube: {grid: {from: [-0.5, -0.5, -0.5], to: [0.5, 0.5, 0.5], cells: [1, 1, 1]}}}
fields:
  cube: {type: rigid_body, mesh: cube, density: 1, initial: {rotation_rate: [0.4, 0.5, 0.8]}}
  skin: {type: rigid_surface, mesh: cube}
constraints: [{type: rigid, field: skin, body: cube}]
time: {theta: 0.5, end: 8, step: {initial: 0.1}}
solver: {newton: {tolerance: 1e-12}}
output:
  fields: false
  probes: {corner: {field: skin, at: [0.5, 0.5, 0.5], quantity: displacement}}
)yaml",
                "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  // A cube turns about any axis as about its own ones: Rodrigues' formula.
  const double rate[] = {0.4, 0.5, 0.8}, speed = std::hypot(rate[0], rate[1], rate[2]);
  const char* names[] = {"corner.x", "corner.y", "corner.z"};
  const std::vector<double> time = run.series("time");
  for (std::size_t step = 0; step < time.size(); ++step)
    for (int i = 0; i < 3; ++i) {
      const double c = std::cos(speed * time[step]), s = std::sin(speed * time[step]);
      const double along = 0.5 * (rate[0] + rate[1] + rate[2]) / speed;
      const double across = 0.5 * (rate[(i + 1) % 3] - rate[(i + 2) % 3]) / speed;
      const double expected = 0.5 * c + s * across + (1 - c) * along * rate[i] / speed;
      CHECK(0.5 + run.series(names[i])[step] == Approx(expected).epsilon(0).margin(1e-13));
    }
}

TEST_CASE("a body that turns in a closed box is no source of fluid, by a quarter of a radian a step") {
  const Run run(R"yaml(
title: A bar turns in a closed box
dimension: 2
plugins: [solid, cutfem_fluid, nitsche_fsci]
meshes:
  box: {grid: {from: [-1, -1], to: [1, 1], cells: [20, 20]}}
  bar: {grid: {from: [-0.6, -0.13], to: [0.6, 0.13], cells: [12, 3]}}
fields:
  water: {type: cutfem_fluid, mesh: box, density: 1, viscosity: 0.1, boundary: [{on: [x_min, x_max, y_min, y_max], velocity: [0, 0]}]}
  bar: {type: rigid_body, mesh: bar, translation: [0, 0], rotation: [t]}
  skin: {type: rigid_surface, mesh: bar}
constraints: [{type: rigid, field: skin, body: bar}]
interfaces: {wet: {type: embedded, field: water, body: skin}}
coupling: [{type: fsi, on: wet}]
time: {theta: 1, end: 1, step: {initial: 0.25}}
output: {fields: false}
)yaml",
                "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  REQUIRE(run.series("time").size() == 5);
  for (const double volume : run.series("water.volume"))
    CHECK(volume == Approx(4 - 1.2 * 0.26).epsilon(1e-12));
  // A surface whose velocity points outward by half the angle of a step would let in 0.08 m^2/s.
  for (const double let_in : run.series("water.divergence")) CHECK(std::abs(let_in) < 0.01);
}

TEST_CASE("the force on a body is what the fluid's equations leave") {
  const Run run(R"yaml(
title: A disc on springs in a flow
dimension: 2
plugins: [cutfem_fluid, solid, nitsche_fsci]
meshes:
  box: {grid: {from: [0, 0], to: [2, 1], cells: [20, 10]}}
  disc: {grid: {from: [-1, -1], to: [1, 1], cells: [4, 4], map: ["0.7 + 0.15*x*sqrt(1 - y^2/2)", "0.55 + 0.15*y*sqrt(1 - x^2/2)"]}}
fields:
  water: {type: cutfem_fluid, mesh: box, density: 1, viscosity: 0.1, boundary: [{on: x_min, velocity: ["4*y*(1 - y)", 0]}, {on: [y_min, y_max], velocity: [0, 0]}, {on: x_max, outflow: do_nothing}]}
  disc: {type: rigid_body, mesh: disc, stiffness: [20, 30], rotational_stiffness: 2}
  skin: {type: rigid_surface, mesh: disc}
constraints: [{type: rigid, field: skin, body: disc}]
interfaces: {gamma: {type: embedded, field: water, body: skin}}
coupling: [{type: fsi, on: gamma}]
time: {static: true, end: 1}
solver: {newton: {tolerance: 1e-13}}
output:
  fields: false
  probes:
    force: {interface: gamma, quantity: force}
    moment: {interface: gamma, quantity: moment, about: [0.7, 0.55]}
    moved: {field: disc, quantity: translation}
    angle: {field: disc, quantity: rotation}
)yaml",
                "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  const double x = run.series("moved.x").back(), y = run.series("moved.y").back();
  CHECK(x > 0.01);
  CHECK(std::abs(run.series("angle").back()) > 1e-4);
  CHECK(std::abs(run.series("force.x").back()) == Approx(20 * x).epsilon(1e-11));
  CHECK(std::abs(run.series("force.y").back()) == Approx(30 * std::abs(y)).epsilon(0).margin(1e-13 * 20 * x));
  // The moment about the disc's centre, where it is now, of what presses on it.
  const double about_centre =
      run.series("moment").back() - x * run.series("force.y").back() + y * run.series("force.x").back();
  CHECK(about_centre == Approx(2 * run.series("angle").back()).epsilon(1e-11));
}

TEST_CASE("what a flow exerts on a disc is what its joint holds against") {
  const auto held = [](const std::string& kind, const std::string& before) {
    const Run run(R"yaml(
title: A disc that is held in a flow
dimension: 2
plugins: [cutfem_fluid, solid, nitsche_fsci]
meshes:
  box: {grid: {from: [0, 0], to: [2, 1], cells: [12, 6]}}
  disc: {grid: {from: [-1, -1], to: [1, 1], cells: [4, 4], map: ["0.7 + 0.15*x*sqrt(1 - y^2/2)", "0.55 + 0.15*y*sqrt(1 - x^2/2)"]}}
fields:
  water: {type: cutfem_fluid, mesh: box, density: 1, viscosity: 0.1, boundary: [{on: x_min, velocity: ["4*y*(1 - y)", 0]}, {on: [y_min, y_max], velocity: [0, 0]}, {on: x_max, outflow: do_nothing}]}
  disc: {type: rigid_body, mesh: disc, rotational_stiffness: 2}
  skin: {type: rigid_surface, mesh: disc}
constraints:
  - {type: rigid, field: skin, body: disc}
  - {type: joint, body: disc, at: [0.75, 0.5], )yaml" +
                      kind + R"yaml(}
interfaces: {gamma: {type: embedded, field: water, body: skin}}
coupling: [{type: fsi, on: gamma}]
time: {static: true, end: 1}
solver: {newton: {tolerance: 1e-13}}
output:
  fields: false
  probes:
    force: {interface: gamma, quantity: force}
    moment: {interface: gamma, quantity: moment, about: [0.75, 0.5]}
    joint_force: {field: disc, quantity: joint_force}
    joint_moment: {field: disc, quantity: joint_moment}
    angle: {field: disc, quantity: rotation}
)yaml",
                  "--quiet", before);
    CAPTURE(kind, run.done.output);
    REQUIRE(run.done.code == 0);
    const auto last = [&](const std::string& name) { return run.series(name).back(); };
    CHECK(std::abs(last("joint_force.x")) > 0.1);
    CHECK(last("joint_force.x") == Approx(-last("force.x")).epsilon(1e-10));
    CHECK(last("joint_force.y") == Approx(-last("force.y")).epsilon(1e-10));
    if (kind == "kind: weld")
      CHECK(last("joint_moment") == Approx(-last("moment")).epsilon(1e-10));
    else
      CHECK(std::abs(last("joint_moment")) < 1e-10);
    return last("joint_force.x");
  };
  const double one = held("kind: weld", "");
  for (const std::string ranks : {"2", "3"})
    CHECK(held("kind: weld", "mpirun --oversubscribe -np " + ranks) == Approx(one).epsilon(1e-9));
  held("kind: hinge", "");
}
