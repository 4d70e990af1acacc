// SPDX-License-Identifier: BSD-3-Clause
// What joints do to energy, momentum and angles, over many turns: against closed forms and other
// integrations.
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "scene_run.hpp"

using namespace seam_cli_test;
using std::numbers::pi;

namespace {

const std::string unchecked = "--set 'checks=[]' --set 'output.statistics={}' ";

/// Largest deviation from the first entry.
double drift(const std::vector<double>& series) {
  double largest = 0;
  for (const double value : series) largest = std::max(largest, std::abs(value - series.front()));
  return largest;
}

std::string number(double value) { return std::to_string(value); }

/// Times of steps that differ by up to half of their length, as `replay` takes them.
std::string jittered(double end, double step) {
  std::mt19937 generator(43);
  std::uniform_real_distribution<double> part(0.5, 1.5);
  std::string text = "time\n";
  for (double t = part(generator) * step; t < end; t += part(generator) * step) text += number(t) + "\n";
  return text + number(end) + "\n";
}

/// A bar that spins about a hinge off its middle, once a second.
std::string spinning(double end, double step) {
  return R"yaml(
title: A bar that spins about a hinge
dimension: 2
plugins: [solid]
parameters: {angle: 0.3, c: cos(angle), s: sin(angle)}
meshes: {bar: {grid: {from: [0, -0.1], to: [1, 0.1], cells: [5, 1], rotate: {angle: "angle*180/pi", about: [0.2, 0]}}}}
fields:
  bar: {type: rigid_body, mesh: bar, density: 1, initial: {rotation_rate: [2*pi], velocity: ["-2*pi*0.3*s", "2*pi*0.3*c"]}}
constraints: [{type: joint, kind: hinge, body: bar, at: [0.2, 0]}]
solver: {newton: {tolerance: 1e-12}}
output:
  fields: false
  probes: {angle: {field: bar, quantity: rotation}}
time: {theta: 0.5, end: )yaml" +
         number(end) + ", step: {initial: " + number(step);
}

}  // namespace

TEST_CASE("a bar that spins about a hinge keeps its energy over fifty turns, whatever the steps") {
  for (const double steps : {50.0, 100.0, 200.0}) {
    const Run run(spinning(50, 1 / steps) + "}}\n", "--quiet");
    CAPTURE(steps, run.done.output);
    REQUIRE(run.done.code == 0);
    const std::vector<double> energy = run.series("bar.kinetic_energy");
    CHECK(drift(energy) < 1e-8 * energy.front());
    CHECK(run.series("angle").back() == Approx(100 * pi).epsilon(1e-8));
    // The way that the bar's middle has still to go is no rate of it.
    const auto summary = nlohmann::json::parse(run.folder.read("out/summary.json"));
    for (const nlohmann::json& step : summary.at("newton")) CHECK(step["iterations"].size() <= 3);
  }
}

TEST_CASE("so it does with steps that differ") {
  Folder folder;
  const std::string times = folder.file("times.csv", jittered(50, 0.01));
  const Run run(spinning(50, 0.01) + ", replay: " + times + "}}\n", "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  const std::vector<double> energy = run.series("bar.kinetic_energy");
  CHECK(drift(energy) < 1e-8 * energy.front());
}

namespace {

/// Two bars, the second one hinged to the first one's end.
std::string two_bars(const std::string& one, const std::string& two, const std::string& joints,
                     const std::string& time) {
  return R"yaml(
title: Two bars
dimension: 2
plugins: [solid]
meshes:
  one: {grid: {from: [0, -0.05], to: [1, 0.05], cells: [10, 1]}}
  two: {grid: {from: [1, -0.05], to: [1.8, 0.05], cells: [8, 1]}}
fields:
  one: {type: rigid_body, mesh: one, density: 10, )yaml" +
         one + "}\n  two: {type: rigid_body, mesh: two, density: 20, " + two + "}\nconstraints:\n" + joints +
         "  - {type: joint, kind: hinge, body: two, to: one, at: [1, 0]}\ntime: {" + time + R"yaml(}
output:
  fields: false
  probes:
    a: {field: one, quantity: rotation}
    b: {field: two, quantity: rotation}
    one: {field: one, quantity: translation}
    two: {field: two, quantity: translation}
    vone: {field: one, quantity: velocity}
    vtwo: {field: two, quantity: velocity}
    wone: {field: one, quantity: spin}
    wtwo: {field: two, quantity: spin}
  formulas:
    mx: vone_x + 1.6*vtwo_x
    my: vone_y + 1.6*vtwo_y
    turning: (1.01*wone + 1.6*0.65*wtwo)/12 + (0.5 + one_x)*vone_y - one_y*vone_x + 1.6*((1.4 + two_x)*vtwo_y - two_y*vtwo_x)
solver: {newton: {tolerance: 1e-12}}
)yaml";
}

/// Angles at t = 2 less those of the equations of motion in minimal coordinates, by a Runge-Kutta method.
std::array<double, 2> double_pendulum(bool moves, const std::string& scheme, double step) {
  const std::string fall = "body_force: [0, \"-9.81\"]";
  const Run run(two_bars(fall + (moves ? ", initial: {rotation_rate: [3], velocity: [0, 1.5]}" : ""),
                         fall + (moves ? ", initial: {rotation_rate: [-2], velocity: [0, 2.2]}" : ""),
                         "  - {type: joint, kind: hinge, body: one, at: [0, 0]}\n",
                         scheme + ", end: 2, step: {initial: " + number(step) + "}"),
                "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  return {run.series("a").back() - (moves ? -2.9680758957 : -1.6096495021),
          run.series("b").back() - (moves ? -1.8265973724 : -0.9321939959)};
}

}  // namespace

TEST_CASE("a double pendulum swings right to second order") {
  for (const bool moves : {false, true})
    for (const std::string scheme : {"theta: 0.5", "scheme: bdf2"}) {
      const auto coarse = double_pendulum(moves, scheme, 0.01), fine = double_pendulum(moves, scheme, 0.005);
      CAPTURE(moves, scheme, coarse[0], coarse[1], fine[0], fine[1]);
      for (int k = 0; k < 2 && scheme == "theta: 0.5"; ++k) {
        CHECK(std::abs(coarse[k]) < (moves ? 1e-2 : 1e-3));
        CHECK(std::abs(fine[k]) < std::abs(coarse[k]) / 3);
      }
      // Of one angle alone the error of bdf2 is small by chance.
      CHECK(std::hypot(fine[0], fine[1]) < std::hypot(coarse[0], coarse[1]) / 3);
    }
}

TEST_CASE("two free bars on a hinge keep momentum and energy") {
  // Joined, one's middle at (0.5, 0), two's at (1.4, 0); masses 1 and 1.6.
  const auto kept = [](const std::string& steps) {
    const Run run(two_bars("initial: {rotation_rate: [3], velocity: [0, 0]}",
                           "initial: {rotation_rate: [-2], velocity: [0, 0.7]}", "",
                           "theta: 0.5, end: 20, step: {" + steps + "}"),
                  "--quiet");
    CAPTURE(run.done.output);
    REQUIRE(run.done.code == 0);
    std::vector<double> energy = run.series("one.kinetic_energy");
    const std::vector<double> second = run.series("two.kinetic_energy");
    for (std::size_t k = 0; k < energy.size(); ++k) energy[k] += second[k];
    CHECK(drift(run.series("mx")) < 1e-9);
    CHECK(drift(run.series("my")) < 1e-9);
    CHECK(drift(run.series("turning")) < 1e-9);
    CHECK(drift(energy) < 5e-4 * energy.front());
    // Without growth: in each fifth of the time it is off by as much as in the first.
    std::vector<double> off(5, 0.0);
    const std::vector<double> time = run.series("time");
    for (std::size_t k = 0; k < time.size(); ++k) {
      double& part = off[std::min<std::size_t>(4, static_cast<std::size_t>(time[k] / 4))];
      part = std::max(part, std::abs(energy[k] - energy.front()));
    }
    CAPTURE(off[0], off[4]);
    CHECK(off[4] < 1.1 * off[0]);
  };
  kept("initial: 0.01");
  Folder folder;
  kept("initial: 0.01, replay: " + folder.file("times.csv", jittered(20, 0.01)));
}

TEST_CASE("a hinge in space lets a body of any size swing") {
  // Lengths by a factor, times by its root: the same angles.
  const auto angle = [](const std::string& scheme, const std::string& size) {
    const Run run(R"yaml(
title: A block on a hinge about an oblique axis
dimension: 3
plugins: [solid]
parameters: {L: 1}
meshes: {block: {grid: {from: ["-1.7*L", "-0.4*L", "1.7*L"], to: ["-1.3*L", "0.38*L", "2.2*L"], cells: [1, 1, 1]}}}
fields: {block: {type: rigid_body, mesh: block, density: 1000, body_force: [1, 0, -9.81]}}
constraints: [{type: joint, kind: hinge, body: block, at: ["-0.95*L", "1.77*L", "-1.9*L"], axis: [-0.49, -0.6, -0.08]}]
solver: {newton: {tolerance: 1e-12}}
time: {)yaml" + scheme +
                      R"yaml(, end: "0.3*sqrt(L)", step: {initial: "0.02*sqrt(L)"}}
output: {fields: false, probes: {r: {field: block, quantity: rotation}}}
)yaml",
                  "--quiet --set parameters.L=" + size);
    CAPTURE(scheme, size, run.done.output);
    REQUIRE(run.done.code == 0);
    return run.series("r.x").back();
  };
  for (const std::string scheme : {"theta: 0.5", "theta: 1", "scheme: bdf2"}) {
    const double expected = angle(scheme, "1");
    CHECK(std::abs(expected) > 0.01);
    for (const std::string size : {"1e-3", "1e-5", "1e4"})
      CHECK(angle(scheme, size) == Approx(expected).epsilon(1e-8));
  }
}

TEST_CASE("a body that slides on one that is driven by quarters of a turn stays where it can be") {
  // It sets off at rest along the slide: r = r_0 cosh(angle), whatever unknown says where it is. Steps as
  // long as these are off by a factor, and not by 1e100.
  for (const auto& [turns, angle] : {std::pair("pi/2", pi / 2), std::pair("3*pi/2", 3 * pi / 2)}) {
    const Run run(R"yaml(
title: A body that slides on one that is turned
dimension: 2
plugins: [solid]
parameters: {turn: 1}
meshes:
  a: {grid: {from: [0, 0], to: [1, 1], cells: [1, 1]}}
  c: {grid: {from: [2, 0], to: [3, 0.5], cells: [1, 1]}}
fields:
  a: {type: rigid_body, mesh: a, density: 1}
  c: {type: rigid_body, mesh: c, density: 1}
constraints:
  - {type: joint, kind: hinge, body: a, at: [0, 0], motion: "turn*t/0.1"}
  - {type: joint, kind: slide, body: c, to: a, at: [2, 0], axis: [1, 0]}
time: {theta: 0.5, end: 0.1, step: {initial: 0.1}}
output: {fields: false, probes: {v: {field: c, quantity: velocity}, d: {field: c, quantity: translation}}}
)yaml",
                  "--quiet --set 'parameters.turn=" + std::string(turns) + "'");
    CAPTURE(turns, run.done.output);
    REQUIRE(run.done.code == 0);
    CHECK(run.series("time").size() > 2);  // it has been halved
    const double way = std::hypot(run.series("d.x").back() + 2.5, run.series("d.y").back() + 0.25);
    const double farthest = 4 * 2.5 * std::cosh(angle);
    CHECK(way < farthest);
    CHECK(std::hypot(run.series("v.x").back(), run.series("v.y").back()) < 2 * farthest * angle / 0.1);
  }
}

TEST_CASE(
    "bodies on joints that nothing drives never gain energy, however long and whatever the scheme damps") {
  // Inertia that is handed on as the rate of momentum would: within 60 s by a factor of 1e8 with theta 1.
  for (const std::string scheme : {"theta: 1", "theta: 0.7", "scheme: bdf2"}) {
    const Run run(two_bars("initial: {rotation_rate: [1], velocity: [0, 0.5]}",
                           "initial: {rotation_rate: [-2], velocity: [0, 0.2]}",
                           "  - {type: joint, kind: hinge, body: one, at: [0, 0]}\n",
                           scheme + ", end: 60, step: {initial: 0.02}"),
                  "--quiet");
    CAPTURE(scheme, run.done.output);
    REQUIRE(run.done.code == 0);
    const std::vector<double> one = run.series("one.kinetic_energy"), two = run.series("two.kinetic_energy");
    double most = 0;
    for (std::size_t k = 1; k < one.size(); ++k) most = std::max(most, one[k] + two[k]);
    CHECK(most < (one[0] + two[0]) * (1 + 1e-3));
    CHECK(one.back() + two.back() < one[0] + two[0]);
  }
}

TEST_CASE("a bead slides on a rod that is turned, as from the start, right to second order") {
  // r = r_0 cosh t: at rest along the rod, and going round with it. What it follows in goes from y to x and
  // back.
  const auto off = [](const std::string& scheme, const std::string& motion, double step) {
    const Run run(R"yaml(
title: A bead on a rod that turns
dimension: 2
plugins: [solid]
meshes:
  rod: {grid: {from: [0, -0.05], to: [1, 0.05], cells: [10, 1]}}
  bead: {grid: {from: [0.3, -0.05], to: [0.4, 0.05], cells: [1, 1]}}
fields:
  rod: {type: rigid_body, mesh: rod, density: 100}
  bead: {type: rigid_body, mesh: bead, density: 100}
constraints:
  - {type: joint, kind: hinge, body: rod, at: [0, 0], motion: )yaml" +
                      motion + R"yaml(}
  - {type: joint, kind: slide, body: bead, to: rod, at: [0.35, 0], axis: [1, 0]}
time: {)yaml" + scheme +
                      ", end: 2, step: {initial: " + number(step) + R"yaml(}}
output:
  fields: false
  probes: {d: {field: bead, quantity: translation}, v: {field: bead, quantity: velocity}, w: {field: bead, quantity: spin}}
)yaml",
                  "--quiet");
    CAPTURE(run.done.output);
    REQUIRE(run.done.code == 0);
    CHECK(run.series("v.y").front() == Approx(0.35));
    CHECK(run.series("w").back() == Approx(1));
    return std::hypot(run.series("d.x").back() + 0.35, run.series("d.y").back()) / (0.35 * std::cosh(2)) - 1;
  };
  for (const std::string scheme : {"scheme: bdf2", "theta: 0.5"}) {
    const double coarse = off(scheme, "t", 0.02), fine = off(scheme, "t", 0.01),
                 finest = off(scheme, "t", 0.005);
    CAPTURE(scheme, coarse, fine, finest);
    CHECK(std::abs(coarse) < 1e-3);
    CHECK(coarse / fine == Approx(4).margin(0.5));
    CHECK(fine / finest == Approx(4).margin(0.5));
  }
}

TEST_CASE("a hinge in space turns as far as it is driven in a step, to its place and with its rate") {
  const double fast = GENERATE(1.0, 25.0);  // up to 14.75 rad a step
  const Run run(R"yaml(
title: A bar that a hinge drives about an oblique axis
dimension: 3
plugins: [solid]
parameters: {fast: 1}
meshes: {bar: {grid: {from: [0, -0.05, -0.05], to: [1, 0.05, 0.05], cells: [10, 1, 1], rotate: {angle: -45, axis: [0, 0, 1]}}}}
fields: {bar: {type: rigid_body, mesh: bar, density: 100}}
constraints: [{type: joint, kind: hinge, body: bar, at: [0, 0, 0], axis: [1, 1, 0], motion: fast*(2*t + t^2)}]
time: {theta: 0.5, end: 2, step: {initial: 0.1}}
output:
  fields: false
  probes:
    {c: {field: bar, quantity: translation}, v: {field: bar, quantity: velocity}, w: {field: bar, quantity: spin},
     r: {field: bar, quantity: rotation}}
)yaml",
                "--quiet --set parameters.fast=" + number(fast));
  CAPTURE(fast, run.done.output);
  REQUIRE(run.done.code == 0);
  const std::vector<double> time = run.series("time");
  for (std::size_t k = 0; k < time.size(); ++k) {
    const double t = time[k], angle = fast * (2 * t + t * t), rate = fast * (2 + 2 * t), h = std::sqrt(0.5);
    CAPTURE(t);
    // Turned about (1, 1, 0) from (1, -1, 0): towards (0, 0, -1).
    CHECK(run.series("c.z")[k] == Approx(-0.5 * std::sin(angle)).epsilon(0).margin(1e-12 * fast));
    CHECK(run.series("c.x")[k] == Approx(0.5 * h * (std::cos(angle) - 1)).epsilon(0).margin(1e-12 * fast));
    CHECK(run.series("v.z")[k] == Approx(-0.5 * rate * std::cos(angle)).epsilon(0).margin(1e-12 * fast));
    CHECK(run.series("w.x")[k] == Approx(h * rate).epsilon(0).margin(1e-12 * fast));
    CHECK(run.series("w.y")[k] == Approx(h * rate).epsilon(0).margin(1e-12 * fast));
    CHECK(run.series("r.x")[k] == Approx(h * angle).epsilon(0).margin(1e-12 * fast));
  }
}

TEST_CASE("a hinge in space that sets off all at once counts its turns") {
  const Run run(R"yaml(
title: A block that stands, and is then turned by 10 rad a step
dimension: 3
plugins: [solid]
meshes: {block: {grid: {from: [0.3, 0, 0], to: [2.3, 1, 1], cells: [2, 1, 1]}}}
fields: {block: {type: rigid_body, mesh: block, density: 1}}
constraints:
  - {type: joint, kind: hinge, body: block, at: [0.4, 0.5, 0.5], axis: [0, 0, 1], motion: "t < 0.55 ? 0 : 100*(t - 0.5)"}
time: {theta: 1, end: 0.8, step: {initial: 0.1}}
output:
  fields: false
  probes: {r: {field: block, quantity: rotation}, c: {field: block, quantity: translation}}
)yaml",
                "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  const std::vector<double> time = run.series("time");
  for (std::size_t k = 0; k < time.size(); ++k) {
    const double angle = time[k] < 0.55 ? 0 : 100 * (time[k] - 0.5);
    CAPTURE(time[k]);
    CHECK(run.series("r.z")[k] == Approx(angle).epsilon(0).margin(1e-12));
    CHECK(run.series("c.x")[k] == Approx(0.9 * (std::cos(angle) - 1)).epsilon(0).margin(1e-12));
  }
}

TEST_CASE("bodies on joints start where given motions say") {
  // An arm along x is turned to an angle that no iteration by straight lines would find, and carries a second
  // one that is turned on.
  const auto arms = [](const std::string& head, const std::string& rest) {
    return head + R"yaml(
plugins: [solid]
meshes:
  first: {grid: {from: [0, -0.1)yaml" +
           rest;
  };
  const auto check = [](const Run& run) {
    CAPTURE(run.done.output);
    REQUIRE(run.done.code == 0);
    const std::vector<double> time = run.series("time");
    for (std::size_t k = 0; k < time.size(); ++k) {
      const double a = 3 + time[k], b = a - 2.5;
      CAPTURE(time[k]);
      CHECK(run.series("c.x")[k] == Approx(std::cos(a) + 0.5 * std::cos(b) - 1.5).epsilon(0).margin(1e-13));
      CHECK(run.series("c.y")[k] == Approx(std::sin(a) + 0.5 * std::sin(b)).epsilon(0).margin(1e-13));
      CHECK(run.series("tip.x")[k] == Approx(std::cos(a) + std::cos(b) - 2).epsilon(0).margin(1e-13));
      CHECK(run.series("v.y")[k] == Approx(std::cos(a) + 0.5 * std::cos(b)).epsilon(0).margin(1e-13));
    }
  };
  const std::string times = "time: {theta: 0.5, end: 1, step: {initial: 0.25}}\noutput:\n  fields: false\n";
  const std::string probes =
      "  probes: {c: {field: second, quantity: translation}, v: {field: second, quantity: velocity}, ";
  check(Run(arms("title: Two arms in the plane\ndimension: 2",
                 R"yaml(], to: [1, 0.1], cells: [2, 1]}}
  second: {grid: {from: [1, -0.1], to: [2, 0.1], cells: [2, 1]}}
fields:
  first: {type: rigid_body, mesh: first, density: 1}
  second: {type: rigid_body, mesh: second, density: 1}
  skin: {type: rigid_surface, mesh: second}
constraints:
  - {type: joint, kind: hinge, body: first, at: [0, 0], motion: 3 + t}
  - {type: joint, kind: hinge, body: second, to: first, at: [1, 0], motion: "-2.5"}
  - {type: rigid, field: skin, body: second}
)yaml" + times + probes +
                     "tip: {field: skin, at: [2, 0], quantity: displacement}}\n"),
            "--quiet"));
  check(Run(arms("title: Two arms in space\ndimension: 3",
                 R"yaml(, -0.1], to: [1, 0.1, 0.1], cells: [2, 1, 1]}}
  second: {grid: {from: [1, -0.1, -0.1], to: [2, 0.1, 0.1], cells: [2, 1, 2]}}
fields:
  first: {type: rigid_body, mesh: first, density: 1}
  second: {type: rigid_body, mesh: second, density: 1}
  skin: {type: rigid_surface, mesh: second}
constraints:
  - {type: joint, kind: hinge, body: first, at: [0, 0, 0], axis: [0, 0, 1], motion: 3 + t}
  - {type: joint, kind: hinge, body: second, to: first, at: [1, 0, 0], axis: [0, 0, 1], motion: "-2.5"}
  - {type: rigid, field: skin, body: second}
)yaml" + times + probes +
                     "tip: {field: skin, at: [2, 0, 0], quantity: displacement}}\n"),
            "--quiet"));
}

TEST_CASE("a body that is welded to one that spins starts with the spin, and with the momentum of it") {
  const Run run(R"yaml(
title: Two welded blocks spin freely
dimension: 3
plugins: [solid]
meshes:
  one: {grid: {from: [0, 0, 0], to: [1, 0.3, 0.2], cells: [2, 1, 1]}}
  two: {grid: {from: [1, 0, 0], to: [2, 0.3, 0.2], cells: [2, 1, 1]}}
fields:
  one: {type: rigid_body, mesh: one, density: 100, initial: {rotation_rate: [0.3, 1, 0.5]}}
  two: {type: rigid_body, mesh: two, density: 100}
constraints: [{type: joint, kind: weld, body: two, to: one, at: [1, 0, 0]}]
time: {theta: 0.5, end: 1, step: {initial: 0.02}}
output: {fields: false}
)yaml",
                "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  std::vector<double> energy = run.series("one.kinetic_energy");
  const std::vector<double> other = run.series("two.kinetic_energy");
  for (std::size_t k = 0; k < energy.size(); ++k) energy[k] += other[k];
  CHECK(energy.front() == Approx(4.4121).epsilon(1e-12));
  CHECK(drift(energy) < 1e-4 * energy.front());
}

TEST_CASE("a body that its partner turns far in a step is never held the wrong way round") {
  const Run run(R"yaml(
title: A block on a hinge across the axis about which its frame turns by 3 rad a step
dimension: 3
plugins: [solid]
meshes:
  frame: {grid: {from: [0, 0, 0], to: [1, 0.3, 0.2], cells: [2, 1, 1]}}
  block: {grid: {from: [1, 0, 0], to: [2, 0.3, 0.2], cells: [2, 1, 1]}}
fields:
  frame: {type: rigid_body, mesh: frame, density: 100, rotation: [30*t, 0, 0], translation: [0, 0, 0]}
  block: {type: rigid_body, mesh: block, density: 100}
constraints: [{type: joint, kind: hinge, body: block, to: frame, at: [1.5, 0.15, 0.1], axis: [0, 0, 1]}]
time: {theta: 1, end: 0.2, step: {initial: 0.1}}
output:
  fields: false
  probes: {f: {field: frame, quantity: orientation}, b: {field: block, quantity: orientation}}
)yaml",
                "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  const auto axis = [&](const std::string& of, std::size_t k) {
    const auto q = [&](const std::string& c) { return run.series(of + "." + c)[k]; };
    return std::array{2 * (q("x") * q("z") + q("w") * q("y")), 2 * (q("y") * q("z") - q("w") * q("x")),
                      1 - 2 * (q("x") * q("x") + q("y") * q("y"))};
  };
  for (std::size_t k = 0; k < run.series("time").size(); ++k) {
    const auto frame = axis("f", k), block = axis("b", k);
    CHECK(frame[0] * block[0] + frame[1] * block[1] + frame[2] * block[2] == Approx(1).epsilon(1e-9));
  }
  const std::string summary = run.folder.read("out/summary.json");
  CHECK(summary.find("would hold 'block' the wrong way round: it has turned too far at once") !=
        std::string::npos);
  CHECK(summary.find("'block' would turn by 5.41 rad in a step, at the joint at ") != std::string::npos);
}

TEST_CASE("a pendulum about an oblique axis in space keeps its energy") {
  const Run run(R"yaml(
title: A pendulum about an oblique axis
dimension: 3
plugins: [solid]
meshes: {bar: {grid: {from: [0, -0.05, -0.05], to: [1, 0.05, 0.05], cells: [10, 1, 1], rotate: {angle: -45, axis: [0, 0, 1]}}}}
fields: {bar: {type: rigid_body, mesh: bar, density: 100, body_force: [0, 0, "-9.81"]}}
constraints: [{type: joint, kind: hinge, body: bar, at: [0, 0, 0], axis: [1, 1, 0]}]
time: {theta: 0.5, end: 10, step: {initial: 0.01}}
output:
  fields: false
  probes: {c: {field: bar, quantity: translation}}
  formulas: {energy: bar_kinetic_energy + 9.81*c_z}
)yaml",
                "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  CHECK(drift(run.series("energy")) < 2e-4 * 0.5 * 9.81);
}

TEST_CASE("a heavy top precesses steadily, right to second order") {
  const auto late = [](const std::string& time, const std::string& step) {
    return std::abs(
        ShippedRun("solid/heavy_top", unchecked + time + "--set parameters.step=" + step)("late"));
  };
  for (const std::string time : {"", "--set 'time={scheme: bdf2, end: 2, step: {initial: \"${step}\"}}' "}) {
    const double coarse = late(time, "0.004"), fine = late(time, "0.002");
    CAPTURE(time, coarse, fine);
    CHECK(coarse < (time.empty() ? 3e-3 : 1.3e-2));
    CHECK(coarse / fine > 3.2);
  }
}

TEST_CASE("a bar that swings and spins on a ball joint goes round as its equations say, to second order") {
  // Euler's equations about the joint, in axes of the bar: I w' = I w x w + m h e_x x R^T g, q' = q (0, w)/2,
  // I = m ((0.2^2 + 0.3^2)/12, (1 + 0.3^2)/12 + h^2, (1 + 0.2^2)/12 + h^2), m = 0.6, h = 0.5, from w = (6, 1,
  // 2) and q = 1, by DOP853 of scipy at 1e-13 and by its Radau at 1e-10, whose difference is below 1e-9.
  // Where the middle is at t = 2, 4, 6, 8: 5.3 times round the vertical, 7.7 turns about the bar.
  const std::array<std::array<double, 3>, 4> middle{{{-0.2027450217, 0.4552474659, -0.0405487480},
                                                     {-0.3239739778, -0.3665433587, -0.1033771150},
                                                     {0.4454693425, -0.1343911485, -0.1830193545},
                                                     {-0.0707243995, 0.4116259056, -0.2748857456}}},
      spin{{{-4.1794708033, 4.9061801713, 1.5005648720},
            {-2.3704607910, -6.5423150571, 0.7654501501},
            {6.9393852503, 1.3469468829, -0.1024347669},
            {-4.8604703632, 5.9267649552, -1.3607639302}}};
  const auto errors = [&](double step) {
    const Run run(R"yaml(
title: A bar that swings and spins on a ball joint
dimension: 3
plugins: [solid]
meshes: {bar: {grid: {from: [0, -0.1, -0.15], to: [1, 0.1, 0.15], cells: [2, 1, 1]}}}
fields:
  bar: {type: rigid_body, mesh: bar, density: 10, body_force: [0, 0, -9.81], initial: {velocity: [0, 1, -0.5], rotation_rate: [6, 1, 2]}}
constraints: [{type: joint, kind: hinge, body: bar, at: [0, 0, 0]}]
solver: {newton: {tolerance: 1e-12}}
output:
  fields: false
  probes:
    m: {field: bar, quantity: translation}
    v: {field: bar, quantity: velocity}
    w: {field: bar, quantity: spin}
    l: {field: bar, quantity: angular_momentum}
  formulas: {energy: bar_kinetic_energy + 0.6*9.81*m_z, vertical: "l_z + 0.6*((0.5 + m_x)*v_y - m_y*v_x)"}
time: {theta: 0.5, end: 8, step: {initial: )yaml" +
                      number(step) + "}}\n",
                  "--quiet");
    CAPTURE(step, run.done.output);
    REQUIRE(run.done.code == 0);
    // Kept by the scheme itself.
    const std::vector<double> vertical = run.series("vertical");
    CHECK(vertical.front() == Approx(0.6 * (1.04 / 12 + 0.25) * 2).epsilon(1e-12));
    CHECK(drift(vertical) < 1e-9);
    double place = 0, turn = 0;
    for (std::size_t k = 0; k < middle.size(); ++k) {
      const auto row = static_cast<std::size_t>(std::lround(2 * static_cast<double>(k + 1) / step));
      REQUIRE(run.series("time").at(row) == Approx(2 * static_cast<double>(k + 1)));
      for (int i = 0; i < 3; ++i) {
        const std::string of = std::string(".") + "xyz"[i];
        place = std::max(place, std::abs((i == 0 ? 0.5 : 0) + run.series("m" + of)[row] - middle[k][i]));
        turn = std::max(turn, std::abs(run.series("w" + of)[row] - spin[k][i]));
      }
    }
    return std::array{drift(run.series("energy")), place, turn};
  };
  const auto coarse = errors(0.02), fine = errors(0.01);
  CAPTURE(coarse, fine);
  CHECK(fine[0] < 1.5e-3);  // of 2.8 J that come and go
  CHECK(fine[1] < 1e-2);
  CHECK(fine[2] < 0.2);
  for (int k = 0; k < 3; ++k) CHECK(coarse[k] / fine[k] == Approx(4).epsilon(0).margin(0.3));
}

TEST_CASE("a top is the same on all numbers of ranks, and resumed") {
  const std::string quick = unchecked + "--set parameters.step=0.004 --set parameters.end=0.2 ";
  const ShippedRun one("solid/heavy_top", quick);
  CHECK(std::abs(one("spin.x")) > 10);
  // By 0.4 rad a step: the tangent knows how rates of what is tied change.
  const auto summary = nlohmann::json::parse(one.summary());
  for (const nlohmann::json& step : summary.at("newton")) CHECK(step["iterations"].size() <= 3);
  for (const char* ranks : {"2", "3"})
    CHECK(difference(
              one.csv,
              ShippedRun("solid/heavy_top", quick, std::string("mpirun --oversubscribe -np ") + ranks).csv,
              1e-6) < 1e-9);
  const Folder folder;
  const std::string run = "run " SEAM_SOURCE_DIR
                          "/configs/solid/heavy_top.yaml --no-picture --quiet --folder " +
                          (folder.path / "out").string() + " --set output.fields=false " + quick;
  REQUIRE(seam(run + "--stop-after 20").code == 0);
  REQUIRE(seam(run + "--resume").code == 0);
  CHECK(difference(one.csv, folder.read("out/series.csv")) == 0);
}

namespace {

/// A chain of bars along x on hinges, which falls from rest.
std::string chain(const std::string& density_of_first, double step, const std::string& more = "") {
  return R"yaml(
title: A chain of bars on hinges
dimension: 2
plugins: [solid]
meshes:
  m0: {grid: {from: [0, -0.1], to: [1, 0.1], cells: [2, 1]}}
  m1: {grid: {from: [1, -0.1], to: [2, 0.1], cells: [2, 1]}}
  m2: {grid: {from: [2, -0.1], to: [3, 0.1], cells: [2, 1]}}
fields:
  b0: {type: rigid_body, mesh: m0, density: )yaml" +
         density_of_first + R"yaml(, body_force: [0, -9.81]}
  b1: {type: rigid_body, mesh: m1, density: 1, body_force: [0, -9.81]}
  b2: {type: rigid_body, mesh: m2, density: 1, body_force: [0, -9.81]}
constraints:
  - {type: joint, kind: hinge, body: b0, at: [0, 0]}
  - {type: joint, kind: hinge, body: b1, to: b0, at: [1, 0]}
  - {type: joint, kind: hinge, body: b2, to: b1, at: [2, 0]}
time: {theta: 0.5, end: 0.1, step: {initial: )yaml" +
         number(step) + "}}\n" + more + R"yaml(
output:
  fields: false
  probes: {a0: {field: b0, quantity: rotation}, a1: {field: b1, quantity: rotation}, a2: {field: b2, quantity: rotation}}
)yaml";
}

}  // namespace

TEST_CASE("a chain of bodies falls from rest, however short the steps") {
  std::vector<double> last;
  for (const double step : {0.01, 0.001}) {
    const Run run(chain("1", step, "solver: {newton: {tolerance: 1e-12}}"), "--quiet");
    CAPTURE(step, run.done.output);
    REQUIRE(run.done.code == 0);
    CHECK_THAT(run.folder.read("out/summary.json"), Catch::Matchers::Contains("\"rejected_steps\": 0"));
    std::vector<double> ends;
    for (const char* angle : {"a0", "a1", "a2"}) ends.push_back(run.series(angle).back());
    for (std::size_t k = 0; k < last.size(); ++k) CHECK(ends[k] == Approx(last[k]).epsilon(1e-2));
    last = ends;
  }
}

TEST_CASE("a body without mass that carries others starts as one of hardly any does") {
  const auto ends = [](const std::string& density) {
    const Run run(chain(density, 0.01), "--quiet");
    CAPTURE(run.done.output);
    REQUIRE(run.done.code == 0);
    CHECK(run.series("a0").front() == 0);
    CHECK(std::abs(run.series("a0")[1]) < 1e-2);
    return std::array{run.series("a0").back(), run.series("a1").back(), run.series("a2").back()};
  };
  const auto none = ends("0"), little = ends("1e-7");
  for (int k = 0; k < 3; ++k) CHECK(none[k] == Approx(little[k]).epsilon(1e-4));
}

TEST_CASE("a spring against turns in space is that in the plane up to a turn, and refused beyond") {
  const auto spinning = [](const std::string& dimension, const std::string& rate,
                           const std::string& torsional) {
    const bool plane = dimension == "2";
    const std::string stiffness = torsional.empty() ? ", rotational_stiffness: 0.2" : "";
    return Run("title: A block on a spring\ndimension: " + dimension +
                   "\nplugins: [solid]\nmeshes: {b: {grid: " +
                   (plane ? "{from: [0, 0], to: [1, 1], cells: [1, 1]}"
                          : "{from: [0, 0, 0], to: [1, 1, 1], cells: [1, 1, 1]}") +
                   "}}\nfields:\n  b: {type: rigid_body, mesh: b, density: 1" + stiffness +
                   ", initial: {rotation_rate: [" + (plane ? "" : "0, 0, ") + rate + "]}}\n" + torsional +
                   "time: {theta: 0.5, end: 3, step: {initial: 0.01}}\n"
                   "output: {fields: false, probes: {turn: {field: b, quantity: rotation}}}\n",
               "--quiet");
  };
  const std::string coupling =
      "interfaces: {l: {type: link, fields: [b]}}\n"
      "coupling: [{type: torsional_spring, on: l, stiffness: 0.2, damping: 0";
  for (const std::string torsional : {"", "}]\n", ", axis: [0, 0, 1]}]\n"}) {
    const std::string spring = torsional.empty() ? "" : coupling + torsional;
    const Run plane = spinning("2", "5", torsional.empty() ? "" : coupling + "}]\n"),
              space = spinning("3", "5", spring);
    CAPTURE(torsional, plane.done.output, space.done.output);
    REQUIRE(plane.done.code == 0);
    REQUIRE(space.done.code == 0);
    const std::vector<double> in_plane = plane.series("turn"), in_space = space.series("turn.z");
    REQUIRE(*std::ranges::max_element(in_plane) > 4.5);
    REQUIRE(in_space.size() == in_plane.size());
    for (std::size_t k = 0; k < in_plane.size(); ++k) CHECK(in_space[k] == Approx(in_plane[k]).margin(2e-3));
    const Run beyond = spinning("3", "8", spring);
    CHECK(beyond.done.code == 1);
    CHECK_THAT(
        beyond.done.output,
        Catch::Contains(torsional.empty() ? "the spring of `rotational_stiffness` at "
                                          : "the `torsional_spring` at ") &&
            Catch::Contains(torsional.empty() ? "scene.yaml:6:68 would be" : "scene.yaml:8:12 would be") &&
            Catch::Contains(" would be turned by more than a whole turn, beyond which in space its moment "
                            "has no direction: let it be stiffer, or damp what turns"));
  }
}

TEST_CASE("a body about whose middle a hinge lets it spin, and one without mass at a beam's end") {
  const Run wheel(R"yaml(
title: A hinge at the middle
dimension: 2
plugins: [solid]
meshes: {box: {grid: {from: [0, 0], to: [2, 1], cells: [2, 1]}}}
fields: {b: {type: rigid_body, mesh: box, density: 1, initial: {rotation_rate: [1]}}}
constraints: [{type: joint, kind: hinge, body: b, at: [1, 0.5]}]
time: {theta: 0.5, end: 7, step: {initial: 0.1}}
output: {fields: false, probes: {a: {field: b, quantity: rotation}, m: {field: b, quantity: translation}}}
)yaml",
                  "--quiet");
  CAPTURE(wheel.done.output);
  REQUIRE(wheel.done.code == 0);
  CHECK(wheel.series("a").back() == Approx(7).epsilon(1e-11));
  for (const double x : wheel.series("m.x")) CHECK(x == Approx(0).margin(1e-12));
  const auto tipped = [](const std::string& density) {
    const Run run(R"yaml(
title: A beam with a rigid tip
dimension: 2
plugins: [solid]
meshes:
  beam: {grid: {from: [0, 0], to: [1, 0.1], cells: [10, 2]}}
  tip: {grid: {from: [1, -0.1], to: [1.05, 0.2], cells: [1, 3]}}
fields:
  beam: {type: solid, mesh: beam, density: 1, body_force: [0, -1], material: {type: neo_hookean, young: 1000, poisson: 0.3}, boundary: [{on: x_min, displacement: [0, 0]}]}
  tip: {type: rigid_body, mesh: tip, density: )yaml" +
                      density + R"yaml(}
constraints: [{type: rigid, field: beam, on: x_max, body: tip}]
time: {theta: 0.5, end: 0.5, step: {initial: 0.02}}
output: {fields: false, probes: {m: {field: tip, quantity: translation}}}
)yaml",
                  "--quiet");
    CAPTURE(density, run.done.output);
    REQUIRE(run.done.code == 0);
    return run.series("m.y");
  };
  const std::vector<double> none = tipped("0"), hardly_any = tipped("1e-9");
  CHECK(none.front() == 0);
  CHECK(none.back() < -0.1);
  REQUIRE(none.size() == hardly_any.size());
  for (std::size_t k = 0; k < none.size(); ++k)
    CHECK(none[k] == Approx(hardly_any[k]).epsilon(0).margin(1e-6));
}
