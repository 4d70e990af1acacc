// SPDX-License-Identifier: BSD-3-Clause
// What is given over time moves as its expression says, by every time scheme: values, rates and second rates.
#include <algorithm>
#include <array>
#include <cmath>

#include "scene_run.hpp"

using namespace seam_cli_test;

namespace {

const std::string schemes[] = {"theta: 0.5", "theta: 0.7", "theta: 1", "scheme: bdf2"};

/// Largest deviation from a function of time.
template <class F>
double off(const Run& run, const std::string& name, const F& expected) {
  const std::vector<double> time = run.series("time"), found = run.series(name);
  double largest = 0;
  for (std::size_t k = 0; k < time.size(); ++k)
    largest = std::max(largest, std::abs(found[k] - expected(time[k])));
  return largest;
}

std::string steps(const std::string& scheme, double end, double step) {
  return "time: {" + scheme + ", end: " + std::to_string(end) + ", step: {initial: " + std::to_string(step) +
         "}}\n";
}

}  // namespace

TEST_CASE("a towed body has the velocity and spin of what is given, at the start and for ever") {
  for (const std::string& scheme : schemes)
    for (const double end : {10.0, 100.0}) {
      const Run run(R"yaml(
title: A body that is towed and turned
dimension: 2
plugins: [solid]
meshes: {box: {grid: {from: [0, 0], to: [2, 1], cells: [2, 1]}}}
fields: {b: {type: rigid_body, mesh: box, density: 1, translation: ["0.3*sin(t)", "exp(-t)"], rotation: ["t + 100*t^2"]}}
output:
  fields: false
  probes: {d: {field: b, quantity: translation}, v: {field: b, quantity: velocity}, a: {field: b, quantity: rotation}, w: {field: b, quantity: spin}}
)yaml" + steps(scheme, end, end / 200),
                    "--quiet");
      CAPTURE(scheme, end, run.done.output);
      REQUIRE(run.done.code == 0);
      CHECK(off(run, "d.x", [](double t) { return 0.3 * std::sin(t); }) < 1e-12);
      CHECK(off(run, "d.y", [](double t) { return std::exp(-t); }) < 1e-12);
      CHECK(off(run, "v.x", [](double t) { return 0.3 * std::cos(t); }) < 1e-12);
      CHECK(off(run, "v.y", [](double t) { return -std::exp(-t); }) < 1e-12);
      CHECK(off(run, "a", [](double t) { return t + 100 * t * t; }) < 1e-12 * 100 * end * end);
      CHECK(off(run, "w", [](double t) { return 1 + 200 * t; }) < 1e-12 * 200 * end);
      // 2 kg, and 2 (4 + 1)/12 kg m^2
      CHECK(off(run, "b.kinetic_energy", [](double t) {
              const double x = 0.3 * std::cos(t), y = std::exp(-t), w = 1 + 200 * t;
              return x * x + y * y + 5.0 / 12 * w * w;
            }) < 1e-11 * std::pow(200 * end, 2));
    }
}

TEST_CASE("a body in space that is turned has the spin of what is given, and its momentum") {
  // The second and third motion begin with an angle, and go by 10 rad a step.
  struct Motion {
    std::string text;
    double (*angle)(double);
    double (*rate)(double);
  };
  const Motion motions[] = {
      {"3*sin(t)", [](double t) { return 3 * std::sin(t); }, [](double t) { return 3 * std::cos(t); }},
      {"1 + 100*t", [](double t) { return 1 + 100 * t; }, [](double) { return 100.0; }},
      {"2 - 5*t^2", [](double t) { return 2 - 5 * t * t; }, [](double t) { return -10 * t; }}};
  for (const std::string& scheme : schemes)
    for (const Motion& motion : motions) {
      const Run run(R"yaml(
title: A body that is turned about its third axis
dimension: 3
plugins: [solid]
meshes: {box: {grid: {from: [0, 0, 0], to: [2, 1, 1], cells: [2, 1, 1]}}}
fields: {b: {type: rigid_body, mesh: box, density: 1, translation: ["2*t", 0, 0], rotation: [0, 0, ")yaml" +
                        motion.text + R"yaml("]}}
output:
  fields: false
  probes: {v: {field: b, quantity: velocity}, a: {field: b, quantity: rotation}, w: {field: b, quantity: spin}, l: {field: b, quantity: angular_momentum}}
)yaml" + steps(scheme, 10, 0.1),
                    "--quiet");
      CAPTURE(scheme, motion.text, run.done.output);
      REQUIRE(run.done.code == 0);
      CHECK(off(run, "v.x", [](double) { return 2; }) < 1e-12);
      CHECK(off(run, "a.z", motion.angle) < 1e-12 * 500);
      CHECK(off(run, "w.z", motion.rate) < 1e-12 * 100);
      CHECK(off(run, "l.z", [&](double t) { return 10.0 / 12 * motion.rate(t); }) < 1e-12 * 100);
      CHECK(off(run, "w.x", [](double) { return 0; }) < 1e-12 * 100);
    }
}

TEST_CASE(
    "the angular momentum at the start is that of the points' velocities, where the body is turned to") {
  const auto start = [](const std::string& rotation, const std::string& rate) {
    const Run run(R"yaml(
title: A body that turns
dimension: 3
plugins: [solid]
meshes: {box: {grid: {from: [0, 0, 0], to: [2, 1, 1], cells: [2, 1, 1]}}}
fields: {b: {type: rigid_body, mesh: box, density: 1, rotation: )yaml" +
                      rotation + ", initial: {rotation_rate: " + rate + R"yaml(}}}
output: {fields: false, probes: {l: {field: b, quantity: angular_momentum}}}
)yaml" + steps("theta: 0.5", 0.1, 0.1),
                  "--quiet");
    CAPTURE(rotation, run.done.output);
    REQUIRE(run.done.code == 0);
    return std::array{run.series("l.x").front(), run.series("l.y").front(), run.series("l.z").front()};
  };
  // 2 (1 + 1)/12, 2 (4 + 1)/12, 2 (4 + 1)/12 kg m^2 about the body's axes.
  const std::array free = start("[null, null, null]", "[0.8, -0.3, 1.1]");
  CHECK(free[0] == Approx(0.8 / 3).epsilon(1e-12));
  CHECK(free[1] == Approx(-0.3 * 5 / 6).epsilon(1e-12));
  CHECK(free[2] == Approx(1.1 * 5 / 6).epsilon(1e-12));
  const std::array turned = start("[null, 1.2, null]", "[0.8, 0, 1.1]");
  const double c = std::cos(1.2), s = std::sin(1.2);
  CHECK(turned[0] == Approx(c * 0.8 / 3 + s * 1.1 * 5 / 6).epsilon(1e-12));
  CHECK(turned[1] == Approx(0).margin(1e-14));
  CHECK(turned[2] == Approx(-s * 0.8 / 3 + c * 1.1 * 5 / 6).epsilon(1e-12));
}

TEST_CASE("a body that a joint drives has the rate of the motion, and what follows from it") {
  for (const std::string& scheme : schemes)
    for (const std::string kind : {"hinge, at: [0, 0]", "slide, at: [0, 0], axis: [0.6, 0.8]"}) {
      const Run run(R"yaml(
title: A body that a joint drives
dimension: 2
plugins: [solid]
meshes: {box: {grid: {from: [0, -0.5], to: [2, 0.5], cells: [2, 1]}}}
fields: {b: {type: rigid_body, mesh: box, density: 1}}
constraints: [{type: joint, body: b, motion: "1.3 + 2*t + 0.3*sin(t)", kind: )yaml" +
                        kind + R"yaml(}]
output:
  fields: false
  probes: {d: {field: b, quantity: translation}, a: {field: b, quantity: rotation}, v: {field: b, quantity: velocity}, w: {field: b, quantity: spin}}
)yaml" + steps(scheme, 100, 1),
                    "--quiet");
      CAPTURE(scheme, kind, run.done.output);
      REQUIRE(run.done.code == 0);
      const bool turns = kind[0] == 'h';
      const auto way = [](double t) { return 1.3 + 2 * t + 0.3 * std::sin(t); };
      const auto rate = [](double t) { return 2 + 0.3 * std::cos(t); };
      CHECK(off(run, "a", [&](double t) { return turns ? way(t) : 0; }) < 2e-12);
      CHECK(off(run, "d.x", [&](double t) { return turns ? std::cos(way(t)) - 1 : 0.6 * way(t); }) < 2e-12);
      CHECK(off(run, "d.y", [&](double t) { return turns ? std::sin(way(t)) : 0.8 * way(t); }) < 2e-12);
      CHECK(off(run, "w", [&](double t) { return turns ? rate(t) : 0; }) < 1e-12);
      CHECK(off(run, "v.x", [&](double t) { return rate(t) * (turns ? -std::sin(way(t)) : 0.6); }) < 2e-12);
      CHECK(off(run, "v.y", [&](double t) { return rate(t) * (turns ? std::cos(way(t)) : 0.8); }) < 2e-12);
    }
}

TEST_CASE("a body without mass has a velocity and a spin where it is given or driven, and else none") {
  const auto run = [](const std::string& dimension, const std::string& box, const std::string& body,
                      const std::string& joint) {
    return Run("title: A body without mass\ndimension: " + dimension +
                   "\nplugins: [solid]\nmeshes: {box: {grid: " + box +
                   "}}\nfields: {b: {type: rigid_body, mesh: box" + body + "}}\n" + joint +
                   "output:\n  fields: false\n  probes: {v: {field: b, quantity: velocity}, w: {field: b, "
                   "quantity: spin}}\n" +
                   steps("theta: 0.5", 2, 0.2),
               "--quiet");
  };
  const std::string plane = "{from: [0, -0.5], to: [2, 0.5], cells: [2, 1]}",
                    space = "{from: [0, -0.5, -0.5], to: [2, 0.5, 0.5], cells: [2, 1, 1]}",
                    hinge = "constraints: [{type: joint, kind: hinge, body: b, motion: 1 + t^2, at: ";
  const Run given = run("2", plane, ", translation: [\"sin(t)\", 0], rotation: [t^2]", "");
  CAPTURE(given.done.output);
  REQUIRE(given.done.code == 0);
  CHECK(off(given, "v.x", [](double t) { return std::cos(t); }) < 1e-12);
  CHECK(off(given, "w", [](double t) { return 2 * t; }) < 1e-12);
  const auto check_driven = [](const Run& driven, const std::string& spin) {
    CAPTURE(driven.done.output);
    REQUIRE(driven.done.code == 0);
    CHECK(off(driven, "v.x", [](double t) { return -2 * t * std::sin(1 + t * t); }) < 1e-11);
    CHECK(off(driven, "v.y", [](double t) { return 2 * t * std::cos(1 + t * t); }) < 1e-11);
    CHECK(off(driven, spin, [](double t) { return 2 * t; }) < 1e-11);
  };
  check_driven(run("2", plane, "", hinge + "[0, 0]}]\n"), "w");
  check_driven(run("3", space, "", hinge + "[0, 0, 0], axis: [0, 0, 1]}]\n"), "w.z");
  const Run held = run("2", plane, ", stiffness: [1, 1], rotation: [0]", "");
  CHECK(held.done.code == 2);
  CHECK_THAT(held.done.output, Catch::Matchers::Contains("field 'b' has no quantity 'velocity'"));
}

TEST_CASE("a joint whose motion sets off with an acceleration brings it at once") {
  const Run run(R"yaml(
title: A body that a slide drives
dimension: 2
plugins: [solid]
meshes: {box: {grid: {from: [0, 0], to: [2, 1], cells: [2, 1]}}}
fields: {b: {type: rigid_body, mesh: box, density: 1}}
constraints: [{type: joint, kind: slide, body: b, at: [0, 0], axis: [1, 0], motion: "3*t + 2*t^2"}]
output: {fields: false, probes: {f: {field: b, quantity: joint_force}}}
)yaml" + steps("theta: 0.5", 10, 0.1),
                "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  CHECK(off(run, "f.x", [](double) { return 2 * 4; }) < 1e-9);  // 2 kg by 4 m/s^2, from the first row on
}

TEST_CASE("boundaries of a solid move as given, and bring its mass to their acceleration") {
  // Both ends, so all of it: 2 kg.
  for (const std::string& scheme : schemes)
    for (const double end : {10.0, 100.0}) {
      const Run run(R"yaml(
title: A block that is shaken
dimension: 2
plugins: [solid]
meshes: {box: {grid: {from: [0, 0], to: [2, 1], cells: [1, 1]}}}
fields:
  b:
    type: solid
    mesh: box
    material: {type: neo_hookean, young: 100, poisson: 0.3}
    density: 1
    boundary: [{on: [x_min, x_max], displacement: ["0.3*sin(t)", "0.1*t^2"]}]
output:
  fields: false
  probes:
    v: {field: b, at: [2, 1], quantity: velocity}
    left: {field: b, on: x_min, quantity: reaction}
    right: {field: b, on: x_max, quantity: reaction}
  formulas: {x: left_x + right_x, y: left_y + right_y}
)yaml" + steps(scheme, end, end / 200),
                    "--quiet");
      CAPTURE(scheme, end, run.done.output);
      REQUIRE(run.done.code == 0);
      CHECK(off(run, "v.x", [](double t) { return 0.3 * std::cos(t); }) < 1e-12);
      CHECK(off(run, "v.y", [](double t) { return 0.2 * t; }) < 1e-12 * end);
      // What is recorded of the start are no forces.
      const std::vector<double> time = run.series("time"), x = run.series("x"), y = run.series("y");
      for (std::size_t k = 1; k < time.size(); ++k) {
        CHECK(x[k] == Approx(-0.6 * std::sin(time[k])).epsilon(0).margin(1e-11 * end * end));
        CHECK(y[k] == Approx(0.4).epsilon(1e-11 * end * end));
      }
    }
}

TEST_CASE("given motions are the same on all numbers of ranks, and resumed") {
  const std::string scene = R"yaml(
title: Bodies that are moved
dimension: 2
plugins: [solid]
meshes:
  one: {grid: {from: [0, 0], to: [2, 1], cells: [2, 1]}}
  two: {grid: {from: [2, 0], to: [3, 0.5], cells: [2, 1]}}
fields:
  one: {type: rigid_body, mesh: one, density: 1, translation: ["0.3*sin(t)", null], rotation: ["1 + t^2"]}
  two: {type: rigid_body, mesh: two, density: 1}
constraints: [{type: joint, kind: hinge, body: two, to: one, at: [2, 0.25], motion: "exp(-t)"}]
time: {theta: 0.5, end: 1, step: {initial: 0.1}}
output:
  fields: false
  restart: {every: 1}
  probes: {v: {field: two, quantity: velocity}, w: {field: two, quantity: spin}, f: {field: two, quantity: joint_force}}
)yaml";
  const Folder folder;
  const std::string file = folder.file("scene.yaml", scene);
  const auto run = [&](const std::string& where, const std::string& options, const std::string& before = "") {
    const Result done = seam(
        "run " + file + " --quiet --no-picture --folder " + (folder.path / where).string() + " " + options,
        before);
    CAPTURE(where, done.output);
    REQUIRE(done.code == 0);
    return folder.read(where + "/series.csv");
  };
  const std::string whole = run("whole", "");
  static_cast<void>(run("parts", "--stop-after 4"));
  CHECK(run("parts", "--resume") == whole);
  CHECK(difference(run("ranks", "", "mpirun --oversubscribe -np 2 "), whole) < 1e-11);
}

TEST_CASE("a node beside a given one swings as its balance says, to second order") {
  // One element, its left end moved by c t^2: w'' + w_0^2 (w - c t^2) = -c of its right end, as its mass is
  // 1/6 [2 1; 1 2] and its stiffness 100; so w = c t^2 - 3 c/w_0^2 (1 - cos(w_0 t)).
  const auto errors = [](const std::string& scheme, double step) {
    const Run run(R"yaml(
title: A bar with one free node
dimension: 2
plugins: [solid]
parameters: {c: 1e-6}
meshes: {bar: {grid: {from: [0, 0], to: [1, 1], cells: [1, 1]}}}
fields:
  b:
    type: solid
    mesh: bar
    material: {type: neo_hookean, young: 100, poisson: 0}
    density: 1
    boundary: [{on: x_min, displacement: ["c*t^2", 0]}, {on: [y_min, y_max], displacement: [null, 0]}]
solver: {newton: {tolerance: 1e-10}}
output: {fields: false, probes: {d: {field: b, at: [1, 0.5], quantity: displacement}, v: {field: b, at: [1, 0.5], quantity: velocity}}}
)yaml" + steps(scheme, 1, step),
                  "--quiet");
    CAPTURE(scheme, step, run.done.output);
    REQUIRE(run.done.code == 0);
    const double c = 1e-6, w = std::sqrt(300.0);
    return std::pair(
        off(run, "d.x", [&](double t) { return c * t * t - c / 100 * (1 - std::cos(w * t)); }) / c,
        off(run, "v.x", [&](double t) { return 2 * c * t - c / 100 * w * std::sin(w * t); }) / c);
  };
  for (const std::string scheme : {"theta: 0.5", "scheme: bdf2"}) {
    const auto coarse = errors(scheme, 0.01), fine = errors(scheme, 0.005);
    CAPTURE(scheme, coarse.first, coarse.second, fine.first, fine.second);
    CHECK(fine.first < 3e-3);
    CHECK(coarse.first / fine.first == Approx(4).margin(0.8));
    CHECK(coarse.second / fine.second == Approx(4).margin(0.8));
  }
}

TEST_CASE("a velocity at the start that is not that of the given motion is refused") {
  const auto started = [](const std::string& velocity) {
    return Run(R"yaml(
title: A body that is towed
dimension: 2
plugins: [solid]
meshes: {box: {grid: {from: [0, 0], to: [2, 1], cells: [2, 1]}}}
fields:
  b: {type: rigid_body, mesh: box, density: 1, translation: ["0.3*sin(t)", null], initial: {velocity: )yaml" +
                   velocity + "}}\noutput: {fields: false}\n" + steps("theta: 0.5", 1, 0.5),
               "--quiet");
  };
  CHECK(started("[0.3, 7]").done.code == 0);
  const Run wrong = started("[3, 7]");
  INFO(wrong.done.output);
  CHECK(wrong.done.code == 2);
  CHECK_THAT(wrong.done.output,
             Catch::Matchers::Contains("to start with 3 as a rate of its 'translation' (`initial`), and the "
                                       "motion given for it sets off with 0.3; leave the initial one out"));
}

TEST_CASE("where a formula has no rate the time scheme says it") {
  const Run run(R"yaml(
title: A body that sets off as no body can
dimension: 2
plugins: [solid]
meshes: {box: {grid: {from: [0, 0], to: [2, 1], cells: [2, 1]}}}
fields: {b: {type: rigid_body, mesh: box, density: 1, translation: ["sqrt(t)", 0], rotation: [0]}}
output: {fields: false, probes: {v: {field: b, quantity: velocity}}}
)yaml" + steps("theta: 0.5", 1, 0.1),
                "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  CHECK(run.series("v.x").front() == 0);
  CHECK(run.series("v.x").back() == Approx(0.5));
}
