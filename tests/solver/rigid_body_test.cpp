// SPDX-License-Identifier: BSD-3-Clause
// Equations of a rigid body in space against d'Alembert's principle for the points that it is made of.
#include "rigid_body.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "rotation.hpp"
#include "solver/one_point.hpp"

using namespace seam;

namespace {

using Triple = std::array<double, 3>;
using Axis = seam::Vec<3, double>;

/// Mass points whose centre is the origin, all moments of inertia different.
const std::vector<std::pair<double, Triple>> points{
    {1.0, {1, 0, 0}},   {1.0, {-1, 0, 0}},   {2.0, {0, 1.3, 0.2}},    {2.0, {0, -1.3, -0.2}},
    {0.5, {0, 0, 2.1}}, {0.5, {0, 0, -2.1}}, {0.7, {0.4, 0.5, -0.3}}, {0.7, {-0.4, -0.5, 0.3}}};

/// Keeps the terms of the body; nothing else is asked of it.
class Terms final : public FieldSetup {
 public:
  explicit Terms(int dim = 3) : dim_(dim) {}
  struct Bound {
    std::shared_ptr<const Term> term;
    std::vector<std::string> operands;
  };
  std::vector<Bound> all;
  Bound energy;
  [[nodiscard]] int dimension() const override { return dim_; }
  void add_cell_term(std::shared_ptr<const Term> term, std::vector<std::string> operands) override {
    all.push_back({std::move(term), std::move(operands)});
  }
  [[nodiscard]] Moments moments() const override {
    Moments m;
    for (const auto& [mass, x] : points) {
      m.volume += mass;
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) m.second[i][k] += mass * x[i] * x[k];
    }
    return m;
  }
  void add_boundary_quantity(const std::string&, std::shared_ptr<const Term>,
                             std::vector<std::string>) override {}
  void add_integral(const std::string&, std::shared_ptr<const Term> term,
                    std::vector<std::string> operands) override {
    energy = {std::move(term), std::move(operands)};
  }
  void set_initial(const std::string&, int, Expression) override {}
  void set_initial_rate(const std::string&, int, Expression) override {}

  [[nodiscard]] const std::string& field_name() const override { throw unexpected(); }
  [[nodiscard]] std::vector<std::string> boundaries() const override { throw unexpected(); }
  [[nodiscard]] int boundary_axis(const std::string&) const override { throw unexpected(); }
  void publish(const std::string&, double) override {}
  void publish(const std::string&, std::shared_ptr<const Law>) override { throw unexpected(); }
  void divide(const std::vector<std::pair<std::vector<std::string>, Location>>&) override {
    throw unexpected();
  }
  void within(int, const std::function<void()>&) override { throw unexpected(); }
  void add_uncut_cell_term(std::shared_ptr<const Term>, std::vector<std::string>) override {
    throw unexpected();
  }
  void add_boundary_term(const std::string&, std::shared_ptr<const Term>, std::vector<std::string>) override {
    throw unexpected();
  }
  void add_surface_term(std::shared_ptr<const Term>, std::vector<std::string>, const std::string&) override {
    throw unexpected();
  }
  void add_interior_face_term(std::shared_ptr<const Term>, std::vector<Operand>) override {
    throw unexpected();
  }
  void add_ghost_face_term(GhostFaces, std::shared_ptr<const Term>, std::vector<Operand>) override {
    throw unexpected();
  }
  void fix_level(const std::string&, double, std::vector<std::string>) override { throw unexpected(); }
  void prescribe(const std::string&, const std::string&, int, Expression, const Location&) override {}
  void give(const std::string&, int, Expression) override { throw unexpected(); }
  void add_output(const std::string&, std::shared_ptr<const Term>, std::vector<std::string>) override {}

 private:
  int dim_;
  static std::logic_error unexpected() { return std::logic_error("a rigid body asks for this"); }
};

struct Constants {
  double density = 1, stiffness = 0, damping = 0;  ///< the latter two of the rotation
  Triple moment{};
};

Parameters parameters_of(const Constants& constants, int dim = 3) {
  Parameters p;
  p.set_dimension(dim);
  p.set("density", {constants.density, {}, {}, true});
  p.set("rotational_stiffness", {constants.stiffness, {}, {}, true});
  p.set("rotational_damping", {constants.damping, {}, {}, true});
  std::vector<Expression> moment;
  for (int k = 0; k < (dim == 2 ? 1 : 3); ++k) moment.emplace_back(constants.moment[k]);
  p.set("moment", {moment, std::vector<bool>(moment.size(), true), {}, true});
  return p;
}

solid::RigidBody body_of(const Constants& constants) { return solid::RigidBody(parameters_of(constants)); }

using Quaternion = solid::Quaternion<double>;

/// At one instant: the unknowns, what they were at the start of the step, and their rates.
struct State {
  std::map<std::string, std::vector<double>> value, old, rate, second_rate;
  [[nodiscard]] Axis axes(const std::map<std::string, std::vector<double>>& level) const {
    Axis a;
    std::ranges::copy(level.at("rotation"), a.c.begin());
    return a;
  }
  /// Where the turns of this step have led.
  [[nodiscard]] Quaternion orientation() const {
    Quaternion start;
    std::ranges::copy(old.at("orientation"), start.c.begin());
    return solid::turned(start, axes(value) - axes(old));
  }
  /// Some time later, by what the rates are.
  [[nodiscard]] std::vector<double> at(double t) const {
    std::vector<double> motion(10);
    for (int i = 0; i < 3; ++i)
      motion[i] = value.at("translation")[i] + t * rate.at("translation")[i] +
                  t * t / 2 * second_rate.at("translation")[i];
    const Quaternion q = solid::turned(orientation(), t * axes(rate) + (t * t / 2) * axes(second_rate));
    std::ranges::copy(q.c, motion.begin() + 6);
    return motion;
  }
  /// A little further in the direction of an unknown.
  [[nodiscard]] std::vector<double> changed(int unknown, double h) const {
    std::vector<double> motion = at(0);
    if (unknown < 3) {
      motion[unknown] += h;
    } else {
      Axis turn;
      turn[unknown - 3] = h;
      std::ranges::copy(solid::turned(orientation(), turn).c, motion.begin() + 6);
    }
    return motion;
  }
};

Triple place(const solid::RigidBody& body, const std::vector<double>& motion, const Triple& x) {
  Triple moved;
  body.displace(3, motion.data(), x.data(), moved.data());
  for (int d = 0; d < 3; ++d) moved[d] += x[d];
  return moved;
}

/// What a term reads of a state.
std::vector<double> inputs_of(const Terms::Bound& bound, const State& state) {
  std::vector<double> inputs;
  for (const Slot& slot : bound.term->signature(3).inputs) {
    const auto& level = slot.level == Level::now    ? state.value
                        : slot.level == Level::old  ? state.old
                        : slot.level == Level::rate ? state.rate
                                                    : state.second_rate;
    const std::vector<double>& numbers = level.at(bound.operands.at(slot.operand));
    inputs.insert(inputs.end(), numbers.begin(), numbers.end());
  }
  return inputs;
}

/// The sum of what all terms give in the directions of the unknowns.
std::map<std::string, std::vector<double>> residual(const solid::RigidBody& body, const State& state) {
  Terms setup;
  body.build(setup);
  std::map<std::string, std::vector<double>> sum;
  for (const auto& [name, numbers] : state.value) sum[name].assign(numbers.size(), 0.0);
  for (const Terms::Bound& bound : setup.all) {
    const std::vector<double> r = test::residual(*bound.term, 3, inputs_of(bound, state));
    std::size_t k = 0;
    for (const Slot& slot : bound.term->signature(3).outputs)
      for (double& entry : sum.at(bound.operands.at(slot.operand))) entry += r.at(k++);
  }
  return sum;
}

/// Loads on a body at rest in its reference position, in the directions of its unknowns.
std::vector<double> loads_at_rest(const Parameters& p, int dim) {
  Terms setup(dim);
  solid::RigidBody(p).build(setup);
  std::map<std::string, std::vector<double>> sum{{"translation", std::vector<double>(dim, 0.0)},
                                                 {"rotation", std::vector<double>(dim == 2 ? 1 : 3, 0.0)}};
  for (const Terms::Bound& bound : setup.all) {
    std::vector<double> inputs;
    for (const Slot& slot : bound.term->signature(dim).inputs)
      if (bound.operands.at(slot.operand) == "orientation")
        inputs.insert(inputs.end(), {0, 0, 0, 1});
      else
        inputs.insert(inputs.end(), bound.operands[slot.operand] == "rotation" && dim == 2 ? 1 : dim, 0.0);
    const std::vector<double> r = test::residual(*bound.term, dim, inputs);
    std::size_t k = 0;
    for (const Slot& slot : bound.term->signature(dim).outputs) {
      const auto found = sum.find(bound.operands.at(slot.operand));
      if (found == sum.end()) continue;
      for (double& entry : found->second) entry -= r.at(k++);
    }
  }
  std::vector<double> loads = sum["translation"];
  loads.insert(loads.end(), sum["rotation"].begin(), sum["rotation"].end());
  return loads;
}

/// Derivative at 0 of a function with values in space, of fourth order.
template <class Function>
Triple slope(const Function& f, double h) {
  const Triple a = f(h), b = f(-h), c = f(2 * h), d = f(-2 * h);
  Triple r;
  for (int i = 0; i < 3; ++i) r[i] = (8 * (a[i] - b[i]) - c[i] + d[i]) / (12 * h);
  return r;
}

template <class Function>
Triple curvature(const Function& f, double h) {
  const Triple a = f(h), b = f(-h), c = f(2 * h), d = f(-2 * h), o = f(0);
  Triple r;
  for (int i = 0; i < 3; ++i) r[i] = (16 * (a[i] + b[i]) - c[i] - d[i] - 30 * o[i]) / (12 * h * h);
  return r;
}

Triple cross(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Turned at the start of the step and a little or much since.
State state() {
  const double size = GENERATE(0.0, 1e-3, 0.05, 1.0, 2.3);
  const Quaternion start = solid::turned(solid::no_rotation, Axis{{0.6, -0.7, 0.5}});
  State s;
  s.old = {{"translation", {0, 0, 0}},
           {"rotation", {0.3, 7.0, -2.0}},
           {"orientation", {start.c.begin(), start.c.end()}},
           {"angular_momentum", {0, 0, 0}}};
  s.value = {{"translation", {0.1, -0.2, 0.3}},
             {"rotation", {0.3 + 0.4 * size, 7.0 + 0.5 * size, -2.0 - 0.3 * size}},
             {"angular_momentum", {0, 0, 0}}};
  s.rate = {{"translation", {0.4, 0.2, -0.1}}, {"rotation", {0.8, -0.3, 1.1}}};
  s.second_rate = {{"translation", {-0.3, 0.5, 0.2}}, {"rotation", {0.7, 0.9, -0.4}}};
  const Quaternion now = s.orientation();
  s.value["orientation"].assign(now.c.begin(), now.c.end());
  // Momentum and its rate, of the points that the body is made of.
  const solid::RigidBody body = body_of({});
  std::vector<double> momentum(3, 0.0), change(3, 0.0);
  for (const auto& [mass, x] : points) {
    const auto& place_of = x;
    const auto path = [&](double t) { return place(body, s.at(t), place_of); };
    Triple arm = path(0);
    for (int d = 0; d < 3; ++d) arm[d] -= s.value["translation"][d];
    const Triple spin = cross(arm, slope(path, 1e-3)), moment = cross(arm, curvature(path, 5e-3));
    for (int d = 0; d < 3; ++d) {
      momentum[d] += mass * spin[d];
      change[d] += mass * moment[d];
    }
  }
  s.value["angular_momentum"] = momentum;
  s.rate["angular_momentum"] = change;
  return s;
}

}  // namespace

TEST_CASE("a positive rotation about an axis turns the second to the third") {
  const solid::RigidBody body = body_of({});
  const Quaternion quarter = solid::turned(solid::no_rotation, Axis{{0, 0, std::acos(-1.0) / 2}});
  std::vector<double> motion(6, 0.0);
  motion.insert(motion.end(), quarter.c.begin(), quarter.c.end());
  const Triple moved = place(body, motion, {1, 0, 0});
  CHECK(moved[0] == Approx(0).margin(1e-15));
  CHECK(moved[1] == Approx(1));
}

TEST_CASE("turns follow each other about the axes of what has been turned") {
  // A quarter turn about z takes the body's x axis to y, about which it turns next.
  const double quarter = std::acos(-1.0) / 2;
  const Quaternion both =
      solid::turned(solid::turned(solid::no_rotation, Axis{{0, 0, quarter}}), Axis{{quarter, 0, 0}});
  const Axis z = solid::rotation_tensor(both) * Axis{{0, 0, 1}};
  CHECK(z[0] == Approx(1));
  CHECK(std::abs(z[1]) + std::abs(z[2]) < 1e-15);
}

TEST_CASE("the rotation vector of a quaternion is what has led to it, by the shorter way") {
  const double size = GENERATE(0.0, 1e-9, 1e-3, 0.19, 0.21, 1.0, 3.1);
  const Axis axis{{0.6 * size, -0.64 * size, 0.48 * size}};
  const Axis again = solid::rotation_vector(solid::turned(solid::no_rotation, axis));
  for (int i = 0; i < 3; ++i) CHECK(again[i] == Approx(axis[i]).epsilon(1e-13).margin(1e-300));
  const double whole = 2 * std::acos(-1.0);
  if (size == 0) return;
  const Axis longer = ((size - whole) / size) * axis;
  const Axis shorter = solid::rotation_vector(solid::turned(solid::no_rotation, longer));
  for (int i = 0; i < 3; ++i) CHECK(shorter[i] == Approx(axis[i]).epsilon(1e-6).margin(1e-15));
}

TEST_CASE("a rigid body's inertia is that of the points that it is made of") {
  const solid::RigidBody body = body_of({});
  const State s = state();
  const auto r = residual(body, s);
  for (int k = 0; k < 6; ++k) {
    double work = 0;
    for (const auto& [mass, x] : points) {
      const auto& place_of = x;
      const Triple acceleration = curvature([&](double t) { return place(body, s.at(t), place_of); }, 5e-3);
      const Triple direction = slope([&](double h) { return place(body, s.changed(k, h), place_of); }, 1e-3);
      work += mass * dot(acceleration, direction);
    }
    INFO("unknown " << k);
    CHECK((k < 3 ? r.at("translation")[k] : r.at("rotation")[k - 3]) ==
          Approx(work).epsilon(1e-6).margin(1e-6));
  }
  // Momentum and orientation are as the other unknowns say.
  for (const double rest : r.at("angular_momentum")) CHECK(std::abs(rest) < 1e-6);
  for (const double rest : r.at("orientation")) CHECK(std::abs(rest) < 1e-14);
  State other = s;
  other.value["angular_momentum"][1] += 0.5;
  CHECK(residual(body, other).at("angular_momentum")[1] == Approx(0.5).epsilon(1e-5));
}

TEST_CASE("moments and dashpots on a turned body work on its turns, its spring on its rotation vector") {
  const Constants constants{0, 0.9, 0.4, {0.3, -1.2, 0.8}};
  const solid::RigidBody body = body_of(constants);
  State s = state();
  s.value.erase("angular_momentum");
  const auto r = residual(body, s);
  const Axis vector = solid::rotation_vector(s.orientation());
  for (int k = 0; k < 3; ++k) {
    // The axis of the body, in space.
    const Axis axis = solid::rotation_tensor(s.orientation()) *
                      Axis{{k == 0 ? 1.0 : 0, k == 1 ? 1.0 : 0, k == 2 ? 1.0 : 0}};
    const double work = constants.stiffness * seam::dot(vector, axis) +
                        constants.damping * s.rate["rotation"][k] -
                        dot(constants.moment, {axis[0], axis[1], axis[2]});
    INFO("axis " << k);
    CHECK(r.at("rotation")[k] == Approx(work).epsilon(1e-12).margin(1e-14));
  }
}

TEST_CASE("a rigid body's weight is that of its mass, and a moment turns a plane body as it says") {
  for (const int dim : {2, 3}) {
    CAPTURE(dim);
    Parameters p = parameters_of({2.5, 0, 0, {0.3, -1.2, 0.8}}, dim);
    std::vector<Expression> gravity{Expression(1.0), Expression(-9.81), Expression(0.5)};
    gravity.resize(dim, Expression(0.0));
    p.set("body_force", {gravity, std::vector<bool>(dim, true), {}, true});
    double volume = 0;
    for (const auto& point : points) volume += point.first;
    std::vector<double> expected{2.5 * volume, 2.5 * volume * -9.81};
    if (dim == 3) expected.push_back(2.5 * volume * 0.5);
    expected.push_back(0.3);
    if (dim == 3) expected.insert(expected.end(), {-1.2, 0.8});
    const std::vector<double> loads = loads_at_rest(p, dim);
    REQUIRE(loads.size() == expected.size());
    for (std::size_t k = 0; k < loads.size(); ++k) CHECK(loads[k] == Approx(expected[k]).epsilon(1e-12));
  }
}

TEST_CASE("a rigid body's kinetic energy is that of the points that it is made of") {
  const solid::RigidBody body = body_of({});
  Terms setup;
  body.build(setup);
  const State s = state();
  double expected = 0;
  for (const auto& [mass, x] : points) {
    const auto& place_of = x;
    const Triple velocity = slope([&](double t) { return place(body, s.at(t), place_of); }, 1e-3);
    expected += 0.5 * mass * dot(velocity, velocity);
  }
  REQUIRE(setup.energy.term);
  CHECK(test::at_one_point(*setup.energy.term, 3, inputs_of(setup.energy, s), 1)[0] ==
        Approx(expected).epsilon(1e-8));
}
