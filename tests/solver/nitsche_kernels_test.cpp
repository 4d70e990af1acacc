// SPDX-License-Identifier: BSD-3-Clause
// Conditions between fluid and bodies at single points, against their formulas and the energies they take.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "nitsche_fsci/contact_in_fluid_kernels.hpp"
#include "nitsche_fsci/fluid_porous.hpp"

using namespace seam;
using namespace seam::fsci;

namespace {

/// P = k grad u: no law of a material, but one whose traction is known by hand.
struct Proportional final : Law {
  double k = 3;
  void evaluate(int dimension, const double* x, double* value, double* first, double* second) const override {
    const int n = dimension * dimension;
    for (int i = 0; i < n; ++i) value[i] = k * x[i];
    if (first) std::fill_n(first, n * n, 0.0);
    for (int i = 0; first && i < n; ++i) first[i * n + i] = k;
    if (second) std::fill_n(second, n * n * n, 0.0);
  }
};

/// Porosity and a third of the trace of the permeability, whatever the state is.
struct Pores final : Law {
  double porosity = 0.4, permeability = 0.09;
  void evaluate(int dimension, const double*, double* value, double* first, double* second) const override {
    const int n = dimension * dimension + 1;
    value[0] = porosity, value[1] = permeability;
    if (first) std::fill_n(first, 2 * n, 0.0);
    if (second) std::fill_n(second, 2 * n * n, 0.0);
  }
};

const Flow flow{1.7, 0.23, true};
constexpr double step = 0.2, theta = 0.6, trace_size = 0.17;

Point<2> point() {
  Point<2> x;
  x.position = {{0.3, -0.4}};
  x.partner_position = {{0.3, -0.4}};
  x.normal = {{0.6, 0.8}};
  x.cell_size = 0.3;
  x.trace_size = trace_size;
  x.constant = {5, 11};
  x.time = 1.1;
  x.step = step;
  x.theta = theta;
  return x;
}

std::vector<double> random_numbers(std::size_t count) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> part(-0.5, 0.5);
  std::vector<double> all(count);
  for (double& one : all) one = part(generator);
  return all;
}

/// What a kernel gives in the plane for what it reads, slot by slot.
template <class Kernel>
std::vector<double> residual(const Kernel& kernel, const Point<2>& x, const std::vector<double>& in) {
  REQUIRE(in.size() == static_cast<std::size_t>(Kernel::Reads::size(2)));
  std::vector<double> out(static_cast<std::size_t>(Kernel::Tests::size(2)), 0.0);
  const Trial<2, double, typename Kernel::Reads> s{in.data()};
  Test<2, double, typename Kernel::Tests> r{out.data()};
  kernel.template operator()<2, double, double>(x, s, r);
  return out;
}

/// Phi of thesis (3.27) times h.
double phi_at(double speed) {
  const double h = trace_size, slow = 0.1 * flow.viscosity / (flow.density * h);
  return flow.viscosity + h * flow.density / 6 * speed * speed / std::hypot(speed, slow) +
         h * h / 12 * flow.density / (theta * step);
}

std::vector<Expression> constants(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

/// sigma n = P F^T n / J of Proportional.
Vec<2, double> traction(const std::vector<double>& gradient, const Vec<2, double>& n) {
  const double f[4] = {1 + gradient[0], gradient[1], gradient[2], 1 + gradient[3]};
  const double j = f[0] * f[3] - f[1] * f[2];
  Vec<2, double> t;
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k)
      for (int l = 0; l < 2; ++l) t[i] += 3 * gradient[2 * i + k] * f[2 * l + k] * n[l] / j;
  return t;
}

}  // namespace

TEST_CASE("near another surface the slip length grows as thesis (6.30) has it") {
  Point<2> x = point();
  const auto length = [&](const Slip& slip, double gap) {
    x.gap = gap;
    const auto ratio = slip.ratio<2, double, double>(x);
    return ratio.gliding / ratio.resisting;
  };
  const double width = 0.3 / std::sqrt(2.0);  // of the cell, whose diagonal is 0.3
  for (const double gap : {0.01, 0.1, 0.2}) {
    CHECK(length({0.5, 0.7, 0}, gap) == Approx(0.5 + 0.7 * width * (width / gap - 1)));
    CHECK(length({0.5, 0.7, 0.25}, gap) == Approx(0.5 + 0.7 * 0.25 * (0.25 / gap - 1)));
  }
  CHECK(length({0.5, 0.7, 0}, 0.22) == 0.5);
  CHECK(std::isinf(length({0.5, 0.7, 0}, 0)));
  CHECK(length({0.5, 0, 0}, 1e-9) == 0.5);
}

TEST_CASE("with the skew adjoint, fluid tied to a body takes the energy of its penalty and its friction") {
  const Point<2> x = point();
  const double length = 0.4;
  const FluidSided kernel{flow, {}, {length}, {1, 20, 30}};
  // v, grad v, p, du/dt.
  const std::vector<double> in = random_numbers(9);
  const std::vector<double> r = residual(kernel, x, in);
  double energy = 0;
  for (std::size_t i = 0; i < in.size(); ++i) energy += r[i] * in[i];
  const double n[2] = {0.6, 0.8}, jump[2] = {in[0] - in[7], in[1] - in[8]};
  const double across = jump[0] * n[0] + jump[1] * n[1];
  double shear[2], normal = 0, along = 0, friction = 0;
  for (int i = 0; i < 2; ++i) {
    shear[i] = 0;
    for (int j = 0; j < 2; ++j) shear[i] += flow.viscosity * (in[2 + 2 * i + j] + in[2 + 2 * j + i]) * n[j];
    normal += shear[i] * n[i];
  }
  for (int i = 0; i < 2; ++i) {
    along += std::pow(jump[i] - across * n[i], 2);
    friction += std::pow(shear[i] - normal * n[i], 2);
  }
  const double phi = phi_at(std::hypot(in[0], in[1])), beta = trace_size / (30 * phi),
               lambda = length / flow.viscosity;
  CHECK(energy ==
        Approx(20 * phi / trace_size * across * across + (along + beta * lambda * friction) / (lambda + beta))
            .epsilon(1e-12));
}

TEST_CASE(
    "a given difference of tractions goes to the body where the traction is the fluid's, else to the fluid") {
  const Point<2> x = point();
  const std::vector<double> given{1.5, -0.3, 0.7, 2.0};
  const double g[2] = {1.5 * 0.6 - 0.3 * 0.8, 0.7 * 0.6 + 2.0 * 0.8};
  const Jumps jumps{{}, {constants(given), {}}};
  const std::vector<double> in = random_numbers(9);
  const auto with = residual(FluidSided{flow, jumps, {0}, {1, 20, 30}}, x, in),
             without = residual(FluidSided{flow, {}, {0}, {1, 20, 30}}, x, in);
  for (int i = 0; i < 7; ++i) CHECK(with[i] == without[i]);
  for (int i = 0; i < 2; ++i) CHECK(with[7 + i] - without[7 + i] == Approx(-g[i]));

  const auto law = std::make_shared<Proportional>();
  const std::vector<double> solid = random_numbers(8);
  const auto plus = residual(SolidSided{law, jumps, 1, 10}, x, solid),
             zero = residual(SolidSided{law, {}, 1, 10}, x, solid);
  for (int i = 0; i < 2; ++i) {
    CHECK(plus[i] - zero[i] == Approx(-g[i]));
    CHECK(plus[2 + i] == zero[2 + i]);
  }
}

TEST_CASE("the traction of the body, its penalty and its adjoint are those of thesis (3.29), (3.30)") {
  const Point<2> x = point();
  const auto law = std::make_shared<Proportional>();
  const double gamma = 10, xi = -1;
  // v, du/dt, grad u.
  const std::vector<double> in = random_numbers(8);
  const std::vector<double> gradient(in.begin() + 4, in.end());
  const auto r = residual(SolidSided{law, {}, xi, gamma}, x, in);
  const Vec<2, double> out_of_body{{-0.6, -0.8}}, t = traction(gradient, out_of_body);
  const double jump[2] = {in[0] - in[2], in[1] - in[3]};
  for (int i = 0; i < 2; ++i) {
    CHECK(r[i] == Approx(t[i] + gamma * theta * step * 5 * jump[i]).epsilon(1e-12));
    CHECK(r[2 + i] == Approx(-r[i]).epsilon(1e-12));
  }
  for (int k = 0; k < 4; ++k) {
    constexpr double h = 1e-6;
    std::vector<double> ahead = gradient, behind = gradient;
    ahead[k] += h;
    behind[k] -= h;
    const Vec<2, double> plus = traction(ahead, out_of_body), minus = traction(behind, out_of_body);
    const double change = ((plus[0] - minus[0]) * jump[0] + (plus[1] - minus[1]) * jump[1]) / (2 * h);
    CHECK(r[4 + k] == Approx(-xi * theta * step * change).epsilon(1e-7));
  }
}

TEST_CASE("bodies press and do not pull; the adjoint varies their stress by what contact misses") {
  const auto law = std::make_shared<Proportional>();
  const BodyPull pull{law, law, 10, Whose::own};
  const double gamma = 10 * 5, xi = -1;
  Point<2> x = point();
  const std::vector<double> in{0.02, -0.01, 0.03, -0.04};
  const Vec<2, double> t = traction(in, x.normal);
  const double stress = t[0] * 0.6 + t[1] * 0.8;
  for (const double gap : {-0.02, 0.3}) {
    x.gap = gap;
    const double trial = stress + gamma * gap, pressed = std::min(trial, 0.0);
    REQUIRE((gap < 0) == (trial < 0));
    // du, grad du.
    const auto r = residual(Contact<1, false, true>{{pull}, 1, 1, xi}, x, in);
    for (int i = 0; i < 2; ++i) CHECK(r[i] == Approx(-pressed * x.normal[i]).epsilon(0).margin(1e-14));
    for (int k = 0; k < 4; ++k) {
      constexpr double h = 1e-6;
      std::vector<double> ahead = in, behind = in;
      ahead[k] += h;
      behind[k] -= h;
      const Vec<2, double> plus = traction(ahead, x.normal), minus = traction(behind, x.normal);
      const double change = ((plus[0] - minus[0]) * 0.6 + (plus[1] - minus[1]) * 0.8) / (2 * h);
      CHECK(r[2 + k] == Approx(-xi * (pressed - stress) / gamma * change).epsilon(1e-7));
    }
  }
}

TEST_CASE("hybrid contact holds the mean traction of a step at or below nothing") {
  const auto law = std::make_shared<Proportional>();
  const BodyPull pull{law, law, 10, Whose::own};
  const double gamma = 10 * 5;
  Point<2> x = point();
  x.gap = 0.05;  // they part in this step: at its start they overlapped by 0.01
  const double way = 0.06;
  // grad u, u, u and grad u at the start: it moves away from the other one, against its normal.
  const std::vector<double> in{0, 0, 0, 0, -way * 0.6, -way * 0.8, 0, 0, 0, 0, 0, 0};
  const auto r = residual(Contact<1, true, false>{{pull}, 1, 1}, x, in);
  const double at_start = gamma * (0.05 - way), trial = gamma * 0.05;
  REQUIRE(at_start < 0);
  const double limit = -(1 - theta) / theta * at_start;
  for (int i = 0; i < 2; ++i) CHECK(r[i] == Approx(-std::min(trial, limit) * x.normal[i]));
  // theta of the one and 1 - theta of the other add up to nothing.
  CHECK(theta * limit + (1 - theta) * at_start == Approx(0).margin(1e-14));
}

TEST_CASE("in a fluid the surface carries the lesser of what fluid and bodies exert") {
  const auto law = std::make_shared<Proportional>();
  Point<2> x = point();
  const FluidPull fluid{flow, 20};
  const BodyPull bodies{law, law, 10, Whose::own};
  // v, grad v, p, body's velocity, grad u, grad u of the other one.
  std::vector<double> in = random_numbers(17);
  in[6] = 0.4;
  for (int k = 9; k < 17; ++k) in[k] *= 0.02;
  const double n[2] = {0.6, 0.8};
  double f = -in[6];
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) f += flow.viscosity * (in[2 + 2 * i + j] + in[2 + 2 * j + i]) * n[i] * n[j];
    f -= 20 / trace_size * phi_at(std::hypot(in[0], in[1])) * (in[i] - in[7 + i]) * n[i];
  }
  const std::vector<double> gradient(in.begin() + 9, in.begin() + 13);
  const Vec<2, double> out_of_body{{-0.6, -0.8}}, t = traction(gradient, out_of_body);
  for (const double gap : {-1.0, 1.0}) {
    x.gap = gap;
    const double s = t[0] * out_of_body[0] + t[1] * out_of_body[1] + 10 * 5 * gap;
    REQUIRE((s < f) == (gap < 0));
    NearContact<false> near_contact;
    ClosedContact<false> closed_contact;
    near_contact.fluid = closed_contact.fluid = fluid;
    near_contact.bodies = closed_contact.bodies = bodies;
    closed_contact.reach = std::numeric_limits<double>::infinity();
    const auto near = residual(near_contact, x, in);
    std::vector<double> closed_in = in;
    closed_in.insert(closed_in.begin() + 9, {0.1, 0.2});  // the body's displacement
    const auto closed = residual(closed_contact, x, closed_in);
    for (int i = 0; i < 2; ++i) {
      CHECK(near[i] == Approx((std::min(s, f) - f) * n[i]).epsilon(0).margin(1e-13));
      CHECK(closed[i] == Approx(std::min(s, f) * n[i]).epsilon(1e-12));
    }
  }
}

TEST_CASE("Beavers and Joseph compare with the fluid in the pores, Saffmann with the skeleton") {
  const Point<2> x = point();
  const auto pores = std::make_shared<Pores>();
  // v, du/dt, grad u, v of the pores, p.
  const std::vector<double> in = random_numbers(11);
  const double porosity = pores->porosity, n[2] = {0.6, 0.8};
  double relative[2], seepage[2];
  for (int i = 0; i < 2; ++i) {
    relative[i] = in[i] - in[2 + i];
    seepage[i] = porosity * (in[8 + i] - in[2 + i]);
  }
  const double across = (relative[0] - seepage[0]) * n[0] + (relative[1] - seepage[1]) * n[1];
  const auto measure = [&](bool saffmann, PorousMeasure::Of of) {
    double value = 0;
    const Trial<2, double, PorousMeasure::Reads> s{in.data()};
    PorousMeasure{{pores, {}, saffmann}, of}.operator()<2>(x, s, &value);
    return value;
  };
  for (const bool saffmann : {false, true}) {
    CHECK(measure(saffmann, PorousMeasure::Of::across) == Approx(across));
    const double part = saffmann ? 0 : 1;
    // Along the surface: (-0.8, 0.6).
    const double along = -0.8 * (relative[0] - part * seepage[0]) + 0.6 * (relative[1] - part * seepage[1]);
    CHECK(measure(saffmann, PorousMeasure::Of::along) == Approx(std::abs(along)));
  }
}

TEST_CASE("fluid glides along a porous body by the root of its permeability over alpha") {
  const Point<2> x = point();
  const auto pores = std::make_shared<Pores>();
  const double alpha = 0.6;
  std::vector<double> in = random_numbers(16);
  // v, grad v, p, du/dt, grad u, v of the pores, p of the pores; no seepage.
  in[13] = in[7];
  in[14] = in[8];
  const auto porous = residual(FluidPorous{flow, {pores, {}, true}, alpha, {1, 20, 30}}, x, in);
  const std::vector<double> solid(in.begin(), in.begin() + 9);
  const auto gliding =
      residual(FluidSided{flow, {}, {std::sqrt(pores->permeability) / alpha}, {1, 20, 30}}, x, solid);
  for (int k = 0; k < 9; ++k) CHECK(porous[k] == Approx(gliding[k]).epsilon(1e-12).margin(1e-13));
  // What is normal of the traction reaches the pores.
  const double normal = porous[7] * 0.6 + porous[8] * 0.8;
  for (int i = 0; i < 2; ++i) CHECK(porous[9 + i] == Approx(normal * x.normal[i]).epsilon(1e-12));
}
