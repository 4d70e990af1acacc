// SPDX-License-Identifier: BSD-3-Clause
// Springs and dashpots between rigid bodies: forces against energies, balances, and what rigid motions leave.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "spring_kernels.hpp"

using namespace seam;
using namespace seam::solid;

namespace {

using Axis = seam::Vec<3, double>;

/// The motion of a body in space. Its rotation is counted from somewhere.
struct Motion {
  Axis translation, velocity, spin;
  Axis rotation, old_rotation;
  Quaternion<double> old_orientation;

  [[nodiscard]] Quaternion<double> orientation() const {
    return turned(old_orientation, rotation - old_rotation);
  }
  [[nodiscard]] Mat<3, 3, double> turn() const { return rotation_tensor(orientation()); }
  /// The same, as the state at the start of a step.
  [[nodiscard]] Motion settled() const {
    Motion m = *this;
    m.old_orientation = orientation();
    m.old_rotation = rotation;
    return m;
  }
};

const Axis centres[2] = {{{0.3, -0.2, 0.5}}, {{1.4, 0.9, -0.6}}};

std::array<Motion, 2> two_bodies() {
  const Motion first{{{0.1, 0.2, -0.1}}, {{0.7, -0.4, 0.2}},  {{0.5, 1.1, -0.3}},
                     {{0.6, 0.1, 0.9}},  {{0.4, -0.3, 0.95}}, turned(no_rotation, Axis{{0.3, -0.8, 0.4}})};
  const Motion second{{{-0.3, 0.1, 0.2}}, {{-0.2, 0.5, 0.9}}, {{-0.7, 0.2, 0.6}},
                      {{2.0, 1.0, 0.1}},  {{1.8, 1.3, 0.2}},  turned(no_rotation, Axis{{-0.2, 0.5, 0.9}})};
  return {first, second};
}

/// Force and, about its own axes, moment on each of the bodies: what the equations have, with the other sign.
struct Forces {
  std::array<Axis, 2> force, moment;
};

/// What the slots of both bodies read, one after the other.
std::vector<double> inputs(const std::array<Motion, 2>& bodies) {
  std::vector<double> all;
  for (const Motion& m : bodies) {
    for (const Axis& v : {m.translation, m.rotation, m.velocity, m.spin, m.old_rotation})
      all.insert(all.end(), v.c.begin(), v.c.end());
    all.insert(all.end(), m.old_orientation.c.begin(), m.old_orientation.c.end());
  }
  return all;
}

template <class Kernel>
Forces forces(const Kernel& kernel, const std::array<Motion, 2>& bodies) {
  const std::vector<double> in = inputs(bodies);
  std::array<double, 12> out{};
  seam::Test<3, double, typename Kernel::Tests> test{out.data()};
  kernel.template operator()<3, double>(seam::Point<3>{}, Trial<3, double, typename Kernel::Reads>{in.data()},
                                        test);
  Forces r;
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < 3; ++i) {
      r.force[k][i] = -out[6 * k + i];
      r.moment[k][i] = -out[6 * k + 3 + i];
    }
  return r;
}

template <class Spring>
double number(const Spring& spring, double Spring::template State<double>::*which,
              const std::array<Motion, 2>& bodies) {
  const std::vector<double> in = inputs(bodies);
  double value = 0;
  const SpringNumber<Spring, true, true, 2> quantity{spring, which};
  quantity.template operator()<3>(seam::Point<3>{},
                                  Trial<3, double, typename decltype(quantity)::Reads>{in.data()}, &value);
  return value;
}

/// Power of the forces in the bodies' motion, W.
double power(const Forces& f, const std::array<Motion, 2>& bodies) {
  double sum = 0;
  for (int k = 0; k < 2; ++k) sum += dot(f.force[k], bodies[k].velocity) + dot(f.moment[k], bodies[k].spin);
  return sum;
}

void check_balance(const Forces& f, const std::array<Motion, 2>& bodies) {
  Axis force, moment;
  for (int k = 0; k < 2; ++k) {
    force += f.force[k];
    moment += cross(centres[k] + bodies[k].translation, f.force[k]) + bodies[k].turn() * f.moment[k];
  }
  CHECK(std::sqrt(dot(force, force)) < 1e-13);
  CHECK(std::sqrt(dot(moment, moment)) < 1e-13);
}

/// Bodies a time later, moving on as they do.
std::array<Motion, 2> later(const std::array<Motion, 2>& bodies, double time) {
  std::array<Motion, 2> r;
  for (int k = 0; k < 2; ++k) {
    r[k] = bodies[k].settled();
    r[k].translation += time * bodies[k].velocity;
    r[k].rotation += time * bodies[k].spin;
  }
  return r;
}

/// Rate of a number of an undamped spring as the bodies move.
template <class Spring>
double rate(Spring spring, double Spring::template State<double>::*which,
            const std::array<Motion, 2>& bodies) {
  spring.damping = 0;
  const double step = 1e-5;
  return (number(spring, which, later(bodies, step)) - number(spring, which, later(bodies, -step))) /
         (2 * step);
}

/// Both bodies move as parts of one.
std::array<Motion, 2> as_one(std::array<Motion, 2> bodies) {
  const Axis velocity{{0.3, -0.2, 0.4}}, spin{{0.9, -0.5, 0.7}};
  for (int k = 0; k < 2; ++k) {
    bodies[k].velocity = velocity + cross(spin, centres[k] + bodies[k].translation);
    bodies[k].spin = transpose(bodies[k].turn()) * spin;
  }
  return bodies;
}

template <class Kernel, class Spring>
void check_physics(const Spring& spring) {
  const std::array<Motion, 2> bodies = two_bodies();
  using State = typename Spring::template State<double>;
  Spring elastic = spring, damper = spring;
  elastic.damping = damper.stiffness = 0;

  // What an elastic spring does in any motion its energy loses.
  const Forces held = forces(Kernel{elastic}, bodies);
  check_balance(held, bodies);
  CHECK(power(held, bodies) == Approx(-rate(elastic, &State::energy, bodies)).epsilon(1e-8));
  CHECK(std::abs(rate(elastic, &State::energy, bodies)) > 0.1);

  const Forces slowed = forces(Kernel{damper}, bodies);
  check_balance(slowed, bodies);
  CHECK(power(slowed, bodies) < -0.01);
  CHECK(number(damper, &State::energy, bodies) == 0);
  const Forces none = forces(Kernel{damper}, as_one(bodies));
  for (int k = 0; k < 2; ++k)
    CHECK(dot(none.force[k], none.force[k]) + dot(none.moment[k], none.moment[k]) < 1e-26);

  // How a rotation has been counted does not matter.
  const Forces all = forces(Kernel{spring}, bodies);
  const Forces again = forces(Kernel{spring}, {bodies[0].settled(), bodies[1].settled()});
  for (int k = 0; k < 2; ++k) {
    CHECK(std::sqrt(dot(all.force[k] - again.force[k], all.force[k] - again.force[k])) < 1e-13);
    CHECK(std::sqrt(dot(all.moment[k] - again.moment[k], all.moment[k] - again.moment[k])) < 1e-13);
  }
}

LineSpring line(double stiffness, double damping, double rest_length) {
  return {
      stiffness, damping, rest_length, {centres[0], centres[1]}, {{{{0.2, 0.4, -0.3}}, {{-0.5, 0.1, 0.3}}}}};
}

}  // namespace

TEST_CASE("a spring between points of two bodies has an energy, balances and leaves rigid motions alone") {
  check_physics<SpringForce<true, true, 2>>(line(3, 0.7, 0.8));
}

TEST_CASE("a dashpot resists the rate of the length between its ends") {
  const std::array<Motion, 2> bodies = two_bodies();
  const LineSpring damper = line(0, 0.7, 0.8);
  const double faster = rate(damper, &LineSpring::State<double>::length, bodies);
  CHECK(number(damper, &LineSpring::State<double>::tension, bodies) == Approx(0.7 * faster).epsilon(1e-8));
  CHECK(power(forces(SpringForce<true, true, 2>{damper}, bodies), bodies) ==
        Approx(-0.7 * faster * faster).epsilon(1e-8));
}

TEST_CASE("a spring of no length acts in all directions, and so does its dashpot") {
  const LineSpring spring = line(3, 0.7, 0);
  check_physics<SpringForce<true, true, 2>>(spring);
  const std::array<Motion, 2> bodies = two_bodies();
  using State = LineSpring::State<double>;
  const double length = number(spring, &State::length, bodies);
  CHECK(number(spring, &State::energy, bodies) == Approx(1.5 * length * length));
  // More than along the line alone.
  const double along = rate(spring, &State::length, bodies);
  CHECK(power(forces(SpringForce<true, true, 2>{line(0, 0.7, 0)}, bodies), bodies) <
        -0.7 * along * along - 0.1);
}

TEST_CASE("a spring with a length refuses a step that brings its ends together") {
  LineSpring spring = line(3, 0, 0.8);
  std::array<Motion, 2> bodies = two_bodies();
  for (Motion& m : bodies) m = {{}, {}, {}, {}, {}, no_rotation};
  bodies[0].translation = centres[1] + spring.arm[1] - centres[0] - spring.arm[0];
  CHECK_THROWS_AS(forces(SpringForce<true, true, 2>{spring}, bodies), StepRefused);
}

TEST_CASE("a torsional spring about an axis has an energy, balances and leaves rigid motions alone") {
  check_physics<SpringMoment<true, true, 2>>(TurnSpring{3, 0.7, 0.4, Axis{{0.36, 0.48, 0.8}}});
}

TEST_CASE("a torsional spring against all turns does so") {
  check_physics<SpringMoment<true, true, 2>>(TurnSpring{3, 0.7, 0, {}});
}

TEST_CASE("a torsional spring counts the angle of the first body from the second one's") {
  const Axis axis{{0.36, 0.48, 0.8}};
  const TurnSpring spring{3, 0.7, 0.4, axis};
  using State = TurnSpring::State<double>;
  for (const double angle : {-6.0, -3.0, -1.2, 0.5, 3.0, 6.2}) {
    std::array<Motion, 2> bodies = two_bodies();
    bodies[1] = bodies[1].settled();
    bodies[0].old_orientation = turned(bodies[1].old_orientation, angle * axis);
    bodies[0].old_rotation = bodies[0].rotation;
    CHECK(number(spring, &State::angle, bodies) == Approx(angle).epsilon(1e-12));
    bodies[0].spin = transpose(bodies[0].turn()) * (bodies[1].turn() * (bodies[1].spin + 2.0 * axis));
    CHECK(number(spring, &State::total, bodies) == Approx(3 * (angle - 0.4) + 0.7 * 2));
    // The axis is the same in both bodies, and so are the moments.
    const Forces f = forces(SpringMoment<true, true, 2>{spring}, bodies);
    const double moment = 3 * (angle - 0.4) + 0.7 * 2;
    for (int i = 0; i < 3; ++i) {
      CHECK(f.moment[0][i] == Approx(-moment * axis[i]));
      CHECK(f.moment[1][i] == Approx(moment * axis[i]));
    }
    check_balance(f, bodies);
  }
}

TEST_CASE("in the plane a torsional spring counts whole turns") {
  const SpringMoment<false, true, 2> kernel{TurnSpring{3, 0.7, 0.4, {}}};
  // Per body: translation, rotation, their rates.
  const std::array<double, 12> in{1, 2, 9.5, 0, 0, 1.5, -1, 0, -2, 0, 0, 0.25};
  std::array<double, 6> out{};
  seam::Test<2, double, SpringMoment<false, true, 2>::Tests> test{out.data()};
  kernel.operator()<2, double>(seam::Point<2>{},
                               Trial<2, double, SpringMoment<false, true, 2>::Reads>{in.data()}, test);
  const double moment = 3 * (9.5 + 2 - 0.4) + 0.7 * (1.5 - 0.25);
  CHECK(out[2] == Approx(moment));
  CHECK(out[5] == Approx(-moment));
  for (const int k : {0, 1, 3, 4}) CHECK(out[k] == 0);
}
