// SPDX-License-Identifier: BSD-3-Clause
// Equations of a rigid body in space against d'Alembert's principle for the points that it is made of.
#include "rigid_body.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "solver/one_point.hpp"

using namespace seam;

namespace {

using Triple = std::array<double, 3>;
using Motion = std::array<double, 6>;  ///< translation and rotation vector

/// Mass points whose centre is the origin, all moments of inertia different.
const std::vector<std::pair<double, Triple>> points{
    {1.0, {1, 0, 0}},   {1.0, {-1, 0, 0}},   {2.0, {0, 1.3, 0.2}},    {2.0, {0, -1.3, -0.2}},
    {0.5, {0, 0, 2.1}}, {0.5, {0, 0, -2.1}}, {0.7, {0.4, 0.5, -0.3}}, {0.7, {-0.4, -0.5, 0.3}}};

/// Keeps the terms of the body; nothing else is asked of it.
class Terms final : public FieldSetup {
 public:
  explicit Terms(int dim = 3) : dim_(dim) {}
  std::vector<std::shared_ptr<const Term>> all;
  std::shared_ptr<const Term> energy;
  [[nodiscard]] int dimension() const override { return dim_; }
  void add_cell_term(std::shared_ptr<const Term> term, std::vector<std::string>) override {
    all.push_back(std::move(term));
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
  void add_integral(const std::string&, std::shared_ptr<const Term> term, std::vector<std::string>) override {
    energy = std::move(term);
  }

  [[nodiscard]] const std::string& field_name() const override { throw unexpected(); }
  [[nodiscard]] std::vector<std::string> boundaries() const override { throw unexpected(); }
  [[nodiscard]] int boundary_axis(const std::string&) const override { throw unexpected(); }
  void publish(const std::string&, double) override { throw unexpected(); }
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
  void add_surface_term(std::shared_ptr<const Term>, std::vector<std::string>) override {
    throw unexpected();
  }
  void add_interior_face_term(std::shared_ptr<const Term>, std::vector<Operand>) override {
    throw unexpected();
  }
  void add_ghost_face_term(GhostFaces, std::shared_ptr<const Term>, std::vector<Operand>) override {
    throw unexpected();
  }
  void fix_level(const std::string&, double, std::vector<std::string>) override { throw unexpected(); }
  void prescribe(const std::string&, const std::string&, int, Expression, const Location&) override {
    throw unexpected();
  }
  void give(const std::string&, int, Expression) override { throw unexpected(); }
  void set_initial(const std::string&, int, Expression) override { throw unexpected(); }
  void set_initial_rate(const std::string&, int, Expression) override { throw unexpected(); }
  void add_output(const std::string&, std::shared_ptr<const Term>, std::vector<std::string>) override {
    throw unexpected();
  }

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

/// At one instant: the unknowns and their rates.
struct State {
  Motion value, rate, second_rate;
  [[nodiscard]] Motion at(double t) const {
    Motion m;
    for (int i = 0; i < 6; ++i) m[i] = value[i] + t * rate[i] + t * t / 2 * second_rate[i];
    return m;
  }
};

Triple place(const solid::RigidBody& body, const Motion& motion, const Triple& x) {
  Triple moved;
  body.displace(3, motion.data(), x.data(), moved.data());
  for (int d = 0; d < 3; ++d) moved[d] += x[d];
  return moved;
}

/// What a term reads of a state.
std::vector<double> inputs_of(const Term& term, const State& state) {
  std::vector<double> inputs;
  for (const Slot& slot : term.signature(3).inputs) {
    const Motion& level = slot.level == Level::now    ? state.value
                          : slot.level == Level::rate ? state.rate
                                                      : state.second_rate;
    inputs.insert(inputs.end(), level.begin() + 3 * slot.operand, level.begin() + 3 * slot.operand + 3);
  }
  return inputs;
}

/// The sum of what all terms give in the directions of the six unknowns.
Motion residual(const solid::RigidBody& body, const State& state) {
  Terms setup;
  body.build(setup);
  Motion sum{};
  for (const auto& term : setup.all) {
    const std::vector<double> r = test::residual(*term, 3, inputs_of(*term, state));
    REQUIRE(r.size() == 6);
    for (int k = 0; k < 6; ++k) sum[k] += r[k];
  }
  return sum;
}

/// Loads on a body at rest in its reference position, in the directions of its unknowns.
std::vector<double> loads_at_rest(const Parameters& p, int dim) {
  Terms setup(dim);
  solid::RigidBody(p).build(setup);
  std::vector<double> sum(dim == 2 ? 3 : 6, 0.0);
  for (const auto& term : setup.all) {
    const std::vector<double> r =
        test::residual(*term, dim, std::vector<double>(term->signature(dim).input_size(dim), 0.0));
    // A weight has nothing to say of the rotation.
    for (std::size_t k = 0; k < r.size(); ++k) sum[k] -= r[k];
  }
  return sum;
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

/// How a small change of a motion turns the body: half the sum of R e x dR e over the axes e.
template <class Path>
Triple turn(const solid::RigidBody& body, const Path& path) {
  Triple sum{};
  for (int axis = 0; axis < 3; ++axis) {
    Triple e{};
    e[axis] = 1;
    const auto direction = [&](double h) {
      Motion m = path(h);
      m[0] = m[1] = m[2] = 0;
      return place(body, m, e);
    };
    const Triple r = direction(0), d = slope(direction, 1e-3);
    for (int i = 0; i < 3; ++i)
      sum[i] += 0.5 * (r[(i + 1) % 3] * d[(i + 2) % 3] - r[(i + 2) % 3] * d[(i + 1) % 3]);
  }
  return sum;
}

Motion changed(Motion m, int k, double h) {
  m[k] += h;
  return m;
}

double dot(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Turned by little, where series replace quotients, and by much.
State state() {
  const double size = GENERATE(1e-3, 0.05, 1.0, 2.3);
  return {{0.1, -0.2, 0.3, 0.6 * size, -0.7 * size, 0.5 * size},
          {0.4, 0.2, -0.1, 0.8, -0.3, 1.1},
          {-0.3, 0.5, 0.2, 0.7, 0.9, -0.4}};
}

}  // namespace

TEST_CASE("a positive rotation about an axis turns the second to the third") {
  const solid::RigidBody body = body_of({});
  const Triple moved = place(body, {0, 0, 0, 0, 0, std::acos(-1.0) / 2}, {1, 0, 0});
  CHECK(moved[0] == Approx(0).margin(1e-15));
  CHECK(moved[1] == Approx(1));
}

TEST_CASE("a rigid body's inertia is that of the points that it is made of") {
  const solid::RigidBody body = body_of({});
  const State s = state();
  const Motion r = residual(body, s);
  for (int k = 0; k < 6; ++k) {
    double work = 0;
    for (const auto& [mass, x] : points) {
      const auto& place_of = x;
      const Triple acceleration = curvature([&](double t) { return place(body, s.at(t), place_of); }, 5e-3);
      const Triple direction =
          slope([&](double h) { return place(body, changed(s.value, k, h), place_of); }, 1e-3);
      work += mass * dot(acceleration, direction);
    }
    INFO("unknown " << k);
    CHECK(r[k] == Approx(work).epsilon(1e-6).margin(1e-6));
  }
}

TEST_CASE("moments and dashpots on a turned body work on its turns, its spring on its rotation vector") {
  const Constants constants{0, 0.9, 0.4, {0.3, -1.2, 0.8}};
  const solid::RigidBody body = body_of(constants);
  const State s = state();
  const Triple spin = turn(body, [&](double t) { return s.at(t); });
  const Motion r = residual(body, s);
  for (int k = 3; k < 6; ++k) {
    const Triple turned = turn(body, [&](double h) { return changed(s.value, k, h); });
    const double work = constants.stiffness * s.value[k] + constants.damping * dot(spin, turned) -
                        dot(constants.moment, turned);
    INFO("unknown " << k);
    CHECK(r[k] == Approx(work).epsilon(1e-8).margin(1e-9));
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
  REQUIRE(setup.energy);
  CHECK(test::at_one_point(*setup.energy, 3, inputs_of(*setup.energy, s), 1)[0] ==
        Approx(expected).epsilon(1e-8));
}
