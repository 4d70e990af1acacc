// SPDX-License-Identifier: BSD-3-Clause
// Bodies on joints: that they move the same wherever they are turned, on any number of ranks and resumed, and
// at which order in the step.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "scene_run.hpp"

using namespace seam_cli_test;
using std::numbers::pi;

namespace {

const std::string unchecked = "--set 'checks=[]' --set 'output.statistics={}' ";
const std::string ranks = "mpirun --oversubscribe -np ";

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.17g", value);
  return text.data();
}

/// All of a scene, turned by an angle about the origin, in space about (1, 2, 2)/3.
class Turn {
 public:
  Turn(int dimension, double angle) : dimension_(dimension), angle_(angle) {
    const std::array<double, 3> n =
        dimension == 2 ? std::array{0.0, 0.0, 1.0} : std::array{1 / 3.0, 2 / 3.0, 2 / 3.0};
    const double c = std::cos(angle), s = std::sin(angle);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) turn_[i][j] = (1 - c) * n[i] * n[j] + (i == j ? c : 0);
    for (int i = 0; i < 3; ++i) {
      turn_[i][(i + 1) % 3] -= s * n[(i + 2) % 3];
      turn_[(i + 1) % 3][i] += s * n[(i + 2) % 3];
    }
  }
  /// "[x, y]" or "[x, y, z]"
  [[nodiscard]] std::string operator()(double x, double y, double z = 0) const {
    std::string text = "[";
    for (int i = 0; i < dimension_; ++i)
      text += (i == 0 ? "" : ", ") + number(turn_[i][0] * x + turn_[i][1] * y + turn_[i][2] * z);
    return text + "]";
  }
  /// A bar of 1 by 0.2 (by 0.3), from its lower left end.
  [[nodiscard]] std::string bar(double x, double y) const {
    const std::string from = number(x) + ", " + number(y - 0.1), to = number(x + 1) + ", " + number(y + 0.1);
    return "{grid: {" +
           (dimension_ == 2 ? "from: [" + from + "], to: [" + to + "], cells: [2, 1]"
                            : "from: [" + from + ", -0.15], to: [" + to + ", 0.15], cells: [2, 1, 1]") +
           ", " + rotated() + "}}";
  }
  /// As a grid says it.
  [[nodiscard]] std::string rotated() const {
    return "rotate: {angle: " + number(angle_ * 180 / pi) +
           (dimension_ == 2 ? ", about: [0, 0]}" : ", about: [0, 0, 0], axis: [1, 2, 2]}");
  }
  /// What a run has of a vector, turned back, [step][component].
  [[nodiscard]] std::vector<std::array<double, 3>> back(const Run& run, const std::string& name) const {
    std::vector<std::array<double, 3>> all(run.series(name + ".x").size());
    for (int d = 0; d < dimension_; ++d) {
      const std::vector<double> component = run.series(name + "." + "xyz"[d]);
      for (std::size_t k = 0; k < all.size(); ++k)
        for (int i = 0; i < 3; ++i) all[k][i] += turn_[d][i] * component[k];
    }
    return all;
  }

 private:
  int dimension_;
  double angle_;
  std::array<std::array<double, 3>, 3> turn_{};
};

/// Bars that fall: one on a hinge, a second one on a hinge of the first one, one that is driven about its end
/// and one that is welded to that one.
std::string falling(int dimension, const Turn& turn, const std::string& time) {
  const bool plane = dimension == 2;
  const std::string body =
      "{type: rigid_body, density: 10, body_force: " + (plane ? turn(0, -9.81) : turn(2, -9.81, 3)) +
      ", mesh: ";
  // What turns about another axis of a body than its own ones.
  const std::string oblique = plane ? "" : ", axis: " + turn(0.6, 0, 0.8);
  std::string text = "title: Bars that fall\ndimension: " + std::to_string(dimension) +
                     "\nplugins: [solid]\nmeshes:\n  one: " + turn.bar(0, 0) + "\n  two: " + turn.bar(1, 0) +
                     "\n  three: " + turn.bar(2, 0) + "\n  four: " + turn.bar(3, 0.1) + "\nfields:\n";
  for (const std::string name : {"one", "two", "three", "four"})
    text += "  " + name + ": " + body + name + "}\n";
  text += "constraints:\n  - {type: joint, kind: hinge, body: one, at: " + turn(0, 0) + oblique +
          "}\n  - {type: joint, kind: hinge, body: two, to: one, at: " + turn(1, 0) +
          "}\n  - {type: joint, kind: hinge, body: three, to: two, at: " + turn(2, 0) +
          (plane ? "" : ", axis: " + turn(0, 0.6, 0.8)) + ", motion: 0.4*t^2}" +
          "\n  - {type: joint, kind: weld, body: four, to: three, at: " + turn(3, 0) + "}\n" + "time: {" +
          time + "}\nsolver: {newton: {tolerance: 1e-12}}\noutput:\n  fields: false\n  probes:\n";
  for (const std::string name : {"one", "two", "three", "four"})
    for (const std::string quantity : {"translation", "velocity", "spin"})
      text += "    " + name + "_" + quantity + ": {field: " + name + ", quantity: " + quantity + "}\n";
  return text;
}

/// A bead that slides along a bar which falls about a hinge.
std::string sliding(const Turn& turn, double step) {
  const std::string body = "{type: rigid_body, density: 10, body_force: " + turn(2, -9.81) + ", mesh: ";
  return "title: A bead on a bar\ndimension: 2\nplugins: [solid]\nmeshes:\n  bar: " + turn.bar(0, 0) +
         "\n  bead: " + turn.bar(0.2, 0) + "\nfields:\n  bar: " + body + "bar}\n  bead: " + body +
         "bead}\nconstraints:\n  - {type: joint, kind: hinge, body: bar, at: " + turn(0, 0) +
         "}\n  - {type: joint, kind: slide, body: bead, to: bar, at: " + turn(0.7, 0) +
         ", axis: " + turn(1, 0) + "}\ntime: {theta: 0.5, end: 1, step: {initial: " + number(step) +
         "}}\nsolver: {newton: {tolerance: 1e-12}}\noutput: {fields: false, probes: {bead: {field: bead, "
         "quantity: translation}}}\n";
}

double largest(const std::vector<std::array<double, 3>>& vectors) {
  double size = 0;
  for (const auto& vector : vectors)
    for (const double entry : vector) size = std::max(size, std::abs(entry));
  return size;
}

double largest_difference(std::vector<std::array<double, 3>> one,
                          const std::vector<std::array<double, 3>>& other) {
  REQUIRE(one.size() == other.size());
  for (std::size_t k = 0; k < one.size(); ++k)
    for (int i = 0; i < 3; ++i) one[k][i] -= other[k][i];
  return largest(one);
}

/// Compares what falls with the same, turned by 0.3 rad.
void require_same_when_turned(int dimension, const std::string& time) {
  const Turn as_is(dimension, 0), turned(dimension, 0.3);
  const Run one(falling(dimension, as_is, time), "--quiet"),
      other(falling(dimension, turned, time), "--quiet");
  CAPTURE(dimension, time, one.done.output, other.done.output);
  REQUIRE(one.done.code == 0);
  REQUIRE(other.done.code == 0);
  for (const std::string name : {"one_translation", "two_velocity", "four_translation", "four_velocity"}) {
    CAPTURE(name);
    const auto there = as_is.back(one, name);
    CHECK(largest(there) > 0.1);
    CHECK(largest_difference(there, turned.back(other, name)) < 1e-9);
  }
}

/// Compares a run with that on two and three ranks, and with one that stops after some steps and goes on.
void require_same_on_ranks_and_resumed(const std::string& scene, int stop_after) {
  const Run one(scene, "--quiet");
  CAPTURE(one.done.output);
  REQUIRE(one.done.code == 0);
  const std::string csv = one.folder.read("out/series.csv");
  for (const char* number_of : {"2", "3"}) {
    const Run several(scene, "--quiet", ranks + number_of);
    CAPTURE(number_of, several.done.output);
    REQUIRE(several.done.code == 0);
    CHECK(difference(csv, several.folder.read("out/series.csv"), 1e-6) < 1e-9);
  }
  Folder folder;
  const std::string run = "run " + folder.file("scene.yaml", scene) + " --no-picture --quiet --folder " +
                          (folder.path / "out").string();
  REQUIRE(seam(run + " --stop-after " + std::to_string(stop_after)).code == 0);
  REQUIRE(seam(run + " --resume").code == 0);
  CHECK(difference(csv, folder.read("out/series.csv")) == 0);
}

/// Two bars, the second one hinged to the first one's end, and this one to the ground or not at all.
std::string two_bars(const Turn& turn, bool on_ground, bool moves, const std::string& time) {
  const std::string rotated = turn.rotated();
  const auto body = [&](const std::string& density, const std::string& rate, const std::string& velocity) {
    return "density: " + density + (on_ground ? ", body_force: " + turn(0, -9.81) : "") +
           (moves ? ", initial: {rotation_rate: [" + rate + "], velocity: " + velocity + "}" : "") + "}\n";
  };
  return "title: Two bars\ndimension: 2\nplugins: [solid]\nmeshes:\n"
         "  one: {grid: {from: [0, -0.05], to: [1, 0.05], cells: [10, 1], " +
         rotated + "}}\n  two: {grid: {from: [1, -0.05], to: [1.8, 0.05], cells: [8, 1], " + rotated +
         "}}\nfields:\n  one: {type: rigid_body, mesh: one, " +
         body("10", "3", on_ground ? turn(0, 1.5) : turn(0, 0)) + "  two: {type: rigid_body, mesh: two, " +
         body("20", "-2", on_ground ? turn(0, 2.2) : turn(0, 0.7)) + "constraints:\n" +
         (on_ground ? "  - {type: joint, kind: hinge, body: one, at: [0, 0]}\n" : "") +
         "  - {type: joint, kind: hinge, body: two, to: one, at: " + turn(1, 0) + "}\ntime: {" + time +
         R"yaml(}
solver: {newton: {tolerance: 1e-12}}
output:
  fields: false
  probes:
    a: {field: one, quantity: rotation}
    b: {field: two, quantity: rotation}
    vone: {field: one, quantity: velocity}
    vtwo: {field: two, quantity: velocity}
  formulas: {mx: vone_x + 1.6*vtwo_x, my: vone_y + 1.6*vtwo_y}
)yaml";
}

/// Angles of a double pendulum at t = 2 less those of the equations of motion in minimal coordinates, by a
/// Runge-Kutta method.
std::array<double, 2> double_pendulum(bool moves, const std::string& scheme, double step, double turned = 0) {
  const Run run(
      two_bars(Turn(2, turned), true, moves, scheme + ", end: 2, step: {initial: " + number(step) + "}"),
      "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  return {run.series("a").back() - (moves ? -2.9680758957 : -1.6096495021),
          run.series("b").back() - (moves ? -1.8265973724 : -0.9321939959)};
}

/// Largest size of an energy over a period.
double over_period(const std::vector<double>& energy, std::size_t steps, std::size_t period) {
  double size = 0;
  for (std::size_t k = (period - 1) * steps; k <= period * steps; ++k)
    size = std::max(size, std::abs(energy[k]));
  return size;
}

}  // namespace

TEST_CASE("bodies on joints move the same when all of a scene is turned") {
  for (const std::string scheme : {"theta: 0.5", "theta: 1", "scheme: bdf2"})
    require_same_when_turned(2, scheme + ", end: 0.3, step: {initial: 0.01}");
  require_same_when_turned(3, "theta: 0.5, end: 0.2, step: {initial: 0.02}");
}

TEST_CASE("so they do in space with every scheme", "[study]") {
  for (const std::string scheme : {"theta: 0.5", "theta: 1", "scheme: bdf2"})
    require_same_when_turned(3, scheme + ", end: 0.5, step: {initial: 0.01}");
}

TEST_CASE("bodies on joints that are turned are the same on all numbers of ranks, and resumed") {
  require_same_on_ranks_and_resumed(falling(2, Turn(2, 0.3), "theta: 0.5, end: 0.06, step: {initial: 0.01}"),
                                    3);
}

TEST_CASE("so they are in space, and free bars", "[study]") {
  require_same_on_ranks_and_resumed(falling(3, Turn(3, 0.3), "theta: 0.5, end: 0.2, step: {initial: 0.01}"),
                                    10);
  require_same_on_ranks_and_resumed(
      two_bars(Turn(2, 0.3), false, true, "theta: 0.5, end: 0.5, step: {initial: 0.01}"), 25);
}

TEST_CASE("what slides on a body that turns does so alike in all directions, to second order") {
  // Which of its unknowns follows from the others changes at other angles.
  const auto apart = [](double step) {
    const Turn as_is(2, 0), turned(2, 0.3);
    const Run one(sliding(as_is, step), "--quiet"), other(sliding(turned, step), "--quiet");
    CAPTURE(one.done.output, other.done.output);
    REQUIRE(one.done.code == 0);
    REQUIRE(other.done.code == 0);
    return largest_difference(as_is.back(one, "bead"), turned.back(other, "bead"));
  };
  const double coarse = apart(0.02), fine = apart(0.01);
  CAPTURE(coarse, fine);
  CHECK(coarse < 1e-2);
  CHECK(fine < 0.3 * coarse);
}

TEST_CASE("a double pendulum swings at the order of its scheme, down to short steps", "[study]") {
  for (const bool moves : {false, true}) {
    for (const std::string scheme : {"theta: 0.5", "scheme: bdf2"}) {
      // Turned, too: it is the same.
      const auto coarse = double_pendulum(moves, scheme, 0.005),
                 fine = double_pendulum(moves, scheme, 0.0025),
                 finest = double_pendulum(moves, scheme, 0.001, 0.3);
      CAPTURE(moves, scheme, coarse, fine, finest);
      for (int k = 0; k < 2 && scheme == "theta: 0.5"; ++k) {
        CHECK(std::abs(coarse[k] / fine[k]) > 3.5);
        CHECK(std::abs(fine[k] / finest[k]) > 5.5);
      }
      // Of one angle alone the error of bdf2 passes through 0 at longer steps.
      const auto size = [](const auto& error) { return std::hypot(error[0], error[1]); };
      CHECK(size(coarse) / size(fine) > 3.5);
      CHECK(size(fine) / size(finest) > 5.5);
    }
    const auto coarse = double_pendulum(moves, "theta: 1", 0.001),
               fine = double_pendulum(moves, "theta: 1", 0.0005, 0.3);
    CAPTURE(moves, coarse, fine);
    for (int k = 0; k < 2; ++k) CHECK(std::abs(coarse[k] / fine[k]) > 1.7);
  }
}

TEST_CASE("two free bars on a hinge that are turned keep momentum and energy for long", "[study]") {
  const Run run(two_bars(Turn(2, 0.3), false, true, "theta: 0.5, end: 20, step: {initial: 0.01}"), "--quiet");
  CAPTURE(run.done.output);
  REQUIRE(run.done.code == 0);
  std::vector<double> energy = run.series("one.kinetic_energy");
  const std::vector<double> second = run.series("two.kinetic_energy");
  double off = 0;
  for (std::size_t k = 0; k < energy.size(); ++k)
    off = std::max(off, std::abs(energy[k] + second[k] - energy[0] - second[0]));
  CHECK(off < 5e-4 * (energy[0] + second[0]));
  for (const char* name : {"mx", "my"}) {
    const std::vector<double> momentum = run.series(name);
    for (const double now : momentum) CHECK(std::abs(now - momentum.front()) < 1e-9);
  }
}

TEST_CASE("a bar that spins about a hinge keeps its energy with steps that differ, short and long ones",
          "[study]") {
  for (const double steps : {50.0, 200.0}) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> part(0.5, 1.5);
    std::string times = "time\n";
    for (double t = part(generator) / steps; t < 50; t += part(generator) / steps) times += number(t) + "\n";
    Folder folder;
    const Turn turn(2, 0.3);
    const Run run(
        "title: A bar that spins\ndimension: 2\nplugins: [solid]\nmeshes:\n  bar: " + turn.bar(-0.2, 0) +
            "\nfields:\n  bar: {type: rigid_body, mesh: bar, density: 1, initial: {rotation_rate: "
            "[2*pi], velocity: " +
            turn(0, 2 * pi * 0.3) +
            "}}\nconstraints: [{type: joint, kind: hinge, body: bar, at: [0, 0]}]\ntime: {theta: 0.5, "
            "end: 50, step: {initial: " +
            number(1 / steps) + ", replay: " + folder.file("times.csv", times + "50\n") +
            "}}\nsolver: {newton: {tolerance: 1e-12}}\noutput: {fields: false}\n",
        "--quiet");
    CAPTURE(steps, run.done.output);
    REQUIRE(run.done.code == 0);
    const std::vector<double> energy = run.series("bar.kinetic_energy");
    CHECK(energy.size() > 40 * steps);
    for (const double now : energy) CHECK(std::abs(now - energy.front()) < 1e-8 * energy.front());
  }
}

TEST_CASE("a pendulum's energy is off by no more in the last of twenty periods than in the second",
          "[study]") {
  std::array<double, 2> late{}, off{};
  for (int k = 0; k < 2; ++k) {
    const std::size_t steps = k == 0 ? 400 : 800;
    const ShippedRun run("solid/pendulum", unchecked + "--set parameters.steps=" + std::to_string(steps));
    const std::vector<double> energy = run.series("energy");
    const double second = over_period(energy, steps, 2), last = over_period(energy, steps, 20);
    CAPTURE(steps, second, last);
    CHECK(last <= second);
    late[k] = std::abs(run("late"));
    off[k] = second;
  }
  CAPTURE(late, off);
  CHECK(off[0] < 5e-5);
  CHECK(late[0] < 3e-5);
  CHECK(off[0] / off[1] == Approx(4).epsilon(0.05));
  CHECK(late[0] / late[1] == Approx(4).epsilon(0.05));
}

TEST_CASE("a heavy top precesses right with short steps", "[study]") {
  const auto late = [](const std::string& time, const std::string& step) {
    return std::abs(
        ShippedRun("solid/heavy_top", unchecked + time + "--set parameters.step=" + step)("late"));
  };
  for (const std::string time : {"", "--set 'time={scheme: bdf2, end: 2, step: {initial: \"${step}\"}}' "}) {
    const double coarse = late(time, "0.002"), fine = late(time, "0.001");
    CAPTURE(time, coarse, fine);
    CHECK(fine < (time.empty() ? 5e-4 : 1e-3));
    CHECK(coarse / fine > 3.5);
  }
}
