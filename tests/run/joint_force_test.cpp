// SPDX-License-Identifier: BSD-3-Clause
// What joints exert on bodies, against closed forms, balances and what flows exert.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scene_run.hpp"

using namespace seam_cli_test;
using Catch::Matchers::Contains;

namespace {

/// A bar of mass 2 that a joint holds at (0.2, 0), 0.3 beside its middle.
std::string bar(const std::string& joint, const std::string& time) {
  return R"yaml(
title: A bar on a joint
dimension: 2
plugins: [solid]
meshes: {bar: {grid: {from: [0, -0.1], to: [1, 0.1], cells: [2, 1]}}}
fields: {bar: {type: rigid_body, mesh: bar, density: 10, body_force: [0, -9.81]}}
constraints: [{type: joint, body: bar, at: [0.2, 0], )yaml" +
         joint + "}]\ntime: {" + time + R"yaml(}
solver: {newton: {tolerance: 1e-12}}
output:
  fields: false
  probes:
    f: {field: bar, quantity: joint_force}
    m: {field: bar, quantity: joint_moment}
    a: {field: bar, quantity: rotation}
    w: {field: bar, quantity: spin}
)yaml";
}

/// Largest difference of series from what it should be at each time.
template <class Expected>
double largest_error(const Run& run, const std::vector<std::string>& names, const Expected& expected) {
  std::vector<std::vector<double>> series;
  for (const std::string& name : names) series.push_back(run.series(name));
  const std::vector<double> time = run.series("time");
  double error = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const auto values = expected(time[k], k);
    for (std::size_t i = 0; i < names.size(); ++i)
      error = std::max(error, std::abs(series[i][k] - values[i]));
  }
  return error;
}

using Vector = std::array<double, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector sum(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

Vector scaled(double factor, const Vector& a) { return {factor * a[0], factor * a[1], factor * a[2]}; }

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Rodrigues' formula.
Vector turned(const Vector& a, const Vector& axis, double angle) {
  return sum(sum(scaled(std::cos(angle), a), scaled(std::sin(angle), cross(axis, a))),
             scaled((1 - std::cos(angle)) * dot(axis, a), axis));
}

}  // namespace

TEST_CASE("what is welded is held against its weight, from the start, in steps and at rest") {
  for (const std::string time : {"static: true, end: 1", "theta: 0.5, end: 0.3, step: {initial: 0.1}",
                                 "scheme: bdf2, end: 0.3, step: {initial: 0.1}"}) {
    const Run run(bar("kind: weld", time), "--quiet");
    CAPTURE(time, run.done.output);
    REQUIRE(run.done.code == 0);
    CHECK(largest_error(run, {"f.x", "f.y", "m"}, [](double, std::size_t) {
            return std::array{0.0, 2 * 9.81, 0.3 * 2 * 9.81};
          }) < 1e-12);
  }
}

TEST_CASE("a hinge pulls a pendulum by its weight and the rate that it swings with, to second order") {
  // Along the bar m g cos + m c w^2.
  const std::string scheme = GENERATE("theta: 0.5", "scheme: bdf2");
  const auto error = [&](const std::string& step) {
    const Run run(bar("kind: hinge", scheme + ", end: 1, step: {initial: " + step + "}"), "--quiet");
    CAPTURE(run.done.output);
    REQUIRE(run.done.code == 0);
    for (const double moment : run.series("m")) CHECK(std::abs(moment) < 1e-13);
    const std::vector<double> x = run.series("f.x"), y = run.series("f.y"), a = run.series("a"),
                              w = run.series("w");
    double largest = 0;
    // The two-step scheme has no accelerations at the start itself.
    for (std::size_t k = scheme == "theta: 0.5" ? 0 : 1; k < a.size(); ++k) {
      const double along = -x[k] * std::cos(a[k]) - y[k] * std::sin(a[k]),
                   across = -x[k] * std::sin(a[k]) + y[k] * std::cos(a[k]);
      const double about_hinge = 2 * 1.04 / 12 + 2 * 0.09;
      largest = std::max(largest, std::abs(along - (-2 * 9.81 * std::sin(a[k]) + 2 * 0.3 * w[k] * w[k])));
      largest =
          std::max(largest, std::abs(across - 2 * 9.81 * std::cos(a[k]) * (1 - 2 * 0.09 / about_hinge)));
    }
    return largest;
  };
  const double coarse = error("0.02"), fine = error("0.01");
  CAPTURE(scheme, coarse, fine);
  CHECK(coarse < 0.3);
  CHECK(coarse / fine == Approx(4).epsilon(0.1));
}

TEST_CASE("what a given motion takes is recorded as force and moment, exactly, by every scheme") {
  const auto scheme = GENERATE("theta: 0.5", "theta: 0.7", "theta: 1", "scheme: bdf2");
  const std::string time = fmt::format("{}, end: 10, step: {{initial: 0.05}}", scheme);
  const Run slide(bar("kind: slide, axis: [1, 0], motion: 0.3*sin(2*t)", time), "--quiet"),
      hinge(bar("kind: hinge, motion: 0.7 + 0.3*sin(2*t)", time), "--quiet");
  CAPTURE(time, slide.done.output, hinge.done.output);
  REQUIRE(slide.done.code == 0);
  REQUIRE(hinge.done.code == 0);
  CHECK(largest_error(slide, {"f.x", "f.y", "m"}, [](double t, std::size_t) {
          return std::array{-2 * 1.2 * std::sin(2 * t), 2 * 9.81, 0.6 * 9.81};
        }) < 1e-12);
  CHECK(largest_error(hinge, {"f.x", "f.y", "m"}, [](double t, std::size_t) {
          const double a = 0.7 + 0.3 * std::sin(2 * t), w = 0.6 * std::cos(2 * t),
                       second = -1.2 * std::sin(2 * t);
          return std::array{-0.6 * (second * std::sin(a) + w * w * std::cos(a)),
                            0.6 * (second * std::cos(a) - w * w * std::sin(a)) + 2 * 9.81,
                            (2 * 1.04 / 12 + 2 * 0.09) * second + 0.6 * 9.81 * std::cos(a)};
        }) < 1e-12);
}

TEST_CASE("nothing rings behind a kink of a motion that is given all along") {
  const auto scheme = GENERATE("theta: 0.5", "theta: 1", "scheme: bdf2");
  const Run run(bar("kind: slide, axis: [1, 0], motion: \"max(0, t - 1)\"",
                    fmt::format("{}, end: 2, step: {{initial: 0.1}}", scheme)),
                "--quiet");
  CAPTURE(scheme, run.done.output);
  REQUIRE(run.done.code == 0);
  CHECK(largest_error(run, {"f.x", "f.y", "m"}, [](double, std::size_t) {
          return std::array{0.0, 2 * 9.81, 0.6 * 9.81};
        }) < 1e-12);
}

TEST_CASE("the joint of a body that carries others holds these, too") {
  // A bar on a hinge, one on a hinge of it, on which a bead slides with a plate that is welded to it.
  const auto errors = [](const std::string& step, const std::string& end, const std::string& before) {
    Run run(R"yaml(
title: A bead on two bars
dimension: 2
plugins: [solid]
meshes:
  one: {grid: {from: [0, -0.1], to: [1, 0.1], cells: [2, 1]}}
  two: {grid: {from: [1, -0.1], to: [2, 0.1], cells: [2, 1]}}
  bead: {grid: {from: [1.2, -0.1], to: [1.4, 0.1], cells: [1, 1]}}
  plate: {grid: {from: [1.25, 0.1], to: [1.45, 0.5], cells: [1, 2]}}
fields:
  one: {type: rigid_body, mesh: one, density: 10, body_force: [0, -9.81]}
  two: {type: rigid_body, mesh: two, density: 10, body_force: [0, -9.81]}
  bead: {type: rigid_body, mesh: bead, density: 10, body_force: [0, -9.81]}
  plate: {type: rigid_body, mesh: plate, density: 10, body_force: [0, -9.81]}
constraints:
  - {type: joint, kind: weld, body: plate, to: bead, at: [1.35, 0.1]}
  - {type: joint, kind: hinge, body: one, at: [0, 0]}
  - {type: joint, kind: slide, body: bead, to: two, at: [1.3, 0], axis: [1, 0]}
  - {type: joint, kind: hinge, body: two, to: one, at: [1, 0]}
time: {theta: 0.5, end: )yaml" +
                end + ", step: {initial: " + step + R"yaml(}}
solver: {newton: {tolerance: 1e-12}}
output:
  fields: false
  probes:
    f1: {field: one, quantity: joint_force}
    m1: {field: one, quantity: joint_moment}
    f2: {field: two, quantity: joint_force}
    m2: {field: two, quantity: joint_moment}
    f3: {field: bead, quantity: joint_force}
    m3: {field: bead, quantity: joint_moment}
    v1: {field: one, quantity: velocity}
    v2: {field: two, quantity: velocity}
    v3: {field: bead, quantity: velocity}
    v4: {field: plate, quantity: velocity}
    w3: {field: bead, quantity: spin}
    x3: {field: bead, quantity: translation}
    x4: {field: plate, quantity: translation}
    turn: {field: two, quantity: rotation}
)yaml",
            "--quiet", before);
    CAPTURE(run.done.output);
    REQUIRE(run.done.code == 0);
    const double dt = std::stod(step);
    const auto rate = [&](const std::string& name) {
      std::vector<double> of = run.series(name), result(of.size(), 0.0);
      for (std::size_t k = 1; k + 1 < of.size(); ++k) result[k] = (of[k + 1] - of[k - 1]) / (2 * dt);
      return result;
    };
    const std::array<double, 4> mass{2, 2, 0.4, 0.8};
    std::array<std::vector<double>, 4> x, y;
    for (int b = 0; b < 4; ++b) {
      x[b] = rate("v" + std::to_string(b + 1) + ".x");
      y[b] = rate("v" + std::to_string(b + 1) + ".y");
    }
    double force = 0, moment = 0;
    for (int joint = 0; joint < 3; ++joint) {
      const auto fx = run.series("f" + std::to_string(joint + 1) + ".x"),
                 fy = run.series("f" + std::to_string(joint + 1) + ".y");
      for (std::size_t k = 1; k + 1 < fx.size(); ++k) {
        double mx = 0, my = 0;
        for (int b = joint; b < 4; ++b) {
          mx += mass[b] * x[b][k];
          my += mass[b] * (y[b][k] + 9.81);
        }
        force = std::max({force, std::abs(fx[k] - mx), std::abs(fy[k] - my)});
      }
    }
    // What slides is not held along its way, and neither hinge holds a turn.
    const auto turn = run.series("turn"), fx = run.series("f3.x"), fy = run.series("f3.y");
    for (std::size_t k = 0; k < turn.size(); ++k)
      CHECK(std::abs(fx[k] * std::cos(turn[k]) + fy[k] * std::sin(turn[k])) < 1e-9);
    for (const char* name : {"m1", "m2"})
      for (const double m : run.series(name)) CHECK(std::abs(m) < 1e-9);
    // About the middle of the bead, of bead and plate.
    const auto m3 = run.series("m3"), spin = rate("w3"), x3 = run.series("x3.x"), y3 = run.series("x3.y"),
               x4 = run.series("x4.x"), y4 = run.series("x4.y");
    const double inertia = 0.4 * (0.04 + 0.04) / 12 + 0.8 * (0.04 + 0.16) / 12;
    for (std::size_t k = 1; k + 1 < m3.size(); ++k) {
      const double arm = 0.05 + x4[k] - x3[k], up = 0.3 + y4[k] - y3[k];
      moment = std::max(
          moment, std::abs(m3[k] - inertia * spin[k] - arm * 0.8 * (y[3][k] + 9.81) + up * 0.8 * x[3][k]));
    }
    return std::pair(std::array{force, moment}, run.folder.read("out/series.csv"));
  };
  const auto coarse = errors("0.01", "0.4", ""), fine = errors("0.005", "0.4", "");
  CAPTURE(coarse.first, fine.first);
  for (int k = 0; k < 2; ++k) {
    CHECK(coarse.first[k] < 0.2);
    CHECK(coarse.first[k] / fine.first[k] > 3.2);
  }
  const std::string one = errors("0.01", "0.05", "").second;
  for (const std::string ranks : {"2", "3"})  // moments that are none are rounding
    CHECK(difference(one, errors("0.01", "0.05", "mpirun --oversubscribe -np " + ranks).second, 1e-3) < 1e-9);
}

TEST_CASE("what turns about an axis that is none of its own tears at its hinge, in space") {
  // A force m w x (w x r), and a moment w x (I w) about the hinge, with it.
  const Vector axis{0.6, 0, 0.8}, arm{0.3, 0, 0};
  const auto error = [&](const std::string& step) {
    const Run run(R"yaml(
title: A bar that is turned about an oblique axis
dimension: 3
plugins: [solid]
meshes: {bar: {grid: {from: [0, -0.1, -0.15], to: [1, 0.1, 0.15], cells: [2, 1, 1]}}}
fields: {bar: {type: rigid_body, mesh: bar, density: 10}}
constraints: [{type: joint, kind: hinge, body: bar, at: [0.2, 0, 0], axis: [0.6, 0, 0.8], motion: 2*t}]
time: {theta: 0.5, end: 1, step: {initial: )yaml" +
                      step + R"yaml(}}
solver: {newton: {tolerance: 1e-12}}
output:
  fields: false
  probes:
    f: {field: bar, quantity: joint_force}
    m: {field: bar, quantity: joint_moment}
)yaml",
                  "--quiet");
    CAPTURE(run.done.output);
    REQUIRE(run.done.code == 0);
    const double mass = 0.6;
    const Vector w = scaled(2, axis);
    // About the hinge, in axes of the bar.
    const Vector inertia{mass * (0.04 + 0.09) / 12, mass * (1 + 0.09) / 12 + mass * 0.09,
                         mass * (1 + 0.04) / 12 + mass * 0.09};
    const Vector momentum{inertia[0] * w[0], inertia[1] * w[1], inertia[2] * w[2]};
    return largest_error(run, {"f.x", "f.y", "f.z", "m.x", "m.y", "m.z"}, [&](double t, std::size_t) {
      const Vector force = scaled(mass, cross(w, cross(w, turned(arm, axis, 2 * t)))),
                   moment = cross(w, turned(momentum, axis, 2 * t));
      return std::array{force[0], force[1], force[2], moment[0], moment[1], moment[2]};
    });
  };
  const double coarse = error("0.02"), fine = error("0.01");
  CAPTURE(coarse, fine);
  CHECK(coarse < 1e-2);
  CHECK(coarse / fine > 3.5);
}

TEST_CASE("the force of a joint has a unit, and needs a joint") {
  const Folder folder;
  const auto output = [&](const std::string& text) {
    return seam("check " + folder.file("scene.yaml", text)).output;
  };
  const std::string text = bar("kind: weld", "static: true, end: 1");
  CHECK_THAT(output(text), Contains("f.x [N]") && Contains("m [N m]"));
  std::string free = text;
  free.replace(free.find("constraints:"), free.find("time:") - free.find("constraints:"), "");
  CHECK_THAT(output(free), Contains("no quantity 'joint_force'"));
}
