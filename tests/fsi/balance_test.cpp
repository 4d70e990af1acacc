// SPDX-License-Identifier: BSD-3-Clause
// Signs: at the exact state of a manufactured solution each side is left with its own traction.
#include <catch2/catch.hpp>
#include <cmath>

#include "exact_state.hpp"
#include "fluid_sided.hpp"
#include "kernels.hpp"
#include "solid_sided.hpp"

using namespace seam;
using namespace seam::fsci;

namespace {

constexpr double mu = 0.7, time_step = 0.05, theta = 0.8, lambda_e = 37, t = 0.4;
constexpr double material_point[2] = {0.31, -0.27}, normal[2] = {0.6, -0.8};
constexpr double sizes = 0.1;

struct State {
  std::shared_ptr<const Function> exact = test::vortices(
      "viscosity: 0.7, density: 1.3, body_density: 2.1, young: 90, poisson: 0.2, fluid_amplitude: 0.8, "
      "body_amplitude: 0.6, decay: 1.9, wave_number: 2.3");
  double place[2];  ///< of the material point now

  State() {
    const auto u = test::values(*exact, "displacement", material_point, t);
    for (int i = 0; i < 2; ++i) place[i] = material_point[i] + u[i];
  }
  [[nodiscard]] std::vector<double> fluid(const std::string& name) const {
    return test::values(*exact, name, place, t);
  }
  [[nodiscard]] std::vector<double> body(const std::string& name) const {
    return test::values(*exact, name, material_point, t);
  }
  /// sigma n of a side.
  [[nodiscard]] std::vector<double> traction(const std::vector<double>& sigma) const {
    return {sigma[0] * normal[0] + sigma[1] * normal[1], sigma[2] * normal[0] + sigma[3] * normal[1]};
  }
  [[nodiscard]] Jumps jumps() const {
    return {{test::part(exact, "velocity"), test::part(exact, "displacement_rate")},
            {test::part(exact, "fluid_stress"), test::part(exact, "body_stress")}};
  }
  [[nodiscard]] std::vector<double> residual(const Term& term, const std::vector<double>& inputs) const {
    PointBatch batch;
    batch.count = 1;
    batch.position = place;
    batch.partner_position = material_point;
    batch.normal = normal;
    batch.cell_size = batch.trace_size = &sizes;
    batch.constant[0] = &lambda_e;
    batch.inputs = inputs.data();
    batch.time = t;
    batch.step = time_step;
    batch.theta = theta;
    std::vector<double> r(static_cast<std::size_t>(term.signature(2).output_size(2)));
    term.evaluate(batch, r.data(), nullptr);
    return r;
  }
};

std::vector<double> join(std::initializer_list<std::vector<double>> lists) {
  std::vector<double> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

std::shared_ptr<const Law> law() {
  return std::make_shared<LawStress<solid::Piola>>(solid::Piola{test::material("neo_hookean", 90, 0.2)});
}

}  // namespace

TEST_CASE("at the exact state the fluid's form leaves each side its own traction") {
  const State s;
  const FluidSided kernel{{1.3, mu, true}, s.jumps(), {0}, {1, 35, 35}};
  const auto inputs = join(
      {s.fluid("velocity"), s.fluid("velocity_gradient"), s.fluid("pressure"), s.body("displacement_rate")});
  const auto r = s.residual(*make_term(kernel), inputs);  // dv, grad dv, dp, du
  const auto of_fluid = s.traction(s.fluid("fluid_stress")), of_body = s.traction(s.body("body_stress"));
  for (int i = 0; i < 2; ++i) {
    CHECK(r[i] == Approx(-of_fluid[i]).epsilon(1e-12));
    // -<du, sigma_S n_S> with n_S = -n
    CHECK(r[7 + i] == Approx(of_body[i]).epsilon(1e-12));
  }
  for (int k = 2; k < 7; ++k) CHECK(r[k] == Approx(0).margin(1e-12));
}

TEST_CASE("at the exact state the body's form leaves each side its own traction") {
  const State s;
  const SolidSided kernel{law(), s.jumps(), 1, 2};
  const auto inputs =
      join({s.fluid("velocity"), s.body("displacement_rate"), s.body("displacement_gradient")});
  const auto r = s.residual(*make_term(kernel), inputs);  // dv, du, grad du
  const auto of_fluid = s.traction(s.fluid("fluid_stress")), of_body = s.traction(s.body("body_stress"));
  for (int i = 0; i < 2; ++i) {
    CHECK(r[i] == Approx(-of_fluid[i]).epsilon(1e-12));
    CHECK(r[2 + i] == Approx(of_body[i]).epsilon(1e-12));
  }
  for (int k = 4; k < 8; ++k) CHECK(r[k] == Approx(0).margin(1e-12));
}

TEST_CASE("the penalties resist a difference of velocities on both sides alike") {
  const State s;
  auto v = s.fluid("velocity");
  const double extra[2] = {0.02, 0.03};
  for (int i = 0; i < 2; ++i) v[i] += extra[i];
  const auto of_fluid = s.traction(s.fluid("fluid_stress")), of_body = s.traction(s.body("body_stress"));
  const auto body = s.residual(*make_term(SolidSided{law(), s.jumps(), 0, 2}),
                               join({v, s.body("displacement_rate"), s.body("displacement_gradient")}));
  const double scale = 2 * theta * time_step * lambda_e;  // gamma_0 theta dt lambda_e, (3.29), (3.30)
  for (int i = 0; i < 2; ++i) {
    CHECK(body[i] + of_fluid[i] == Approx(scale * extra[i]).epsilon(1e-9));
    CHECK(body[2 + i] - of_body[i] == Approx(-scale * extra[i]).epsilon(1e-9));
  }
  // Without convection phi of (3.27) is known by hand.
  const auto fluid =
      s.residual(*make_term(FluidSided{{1.3, mu, false}, s.jumps(), {0}, {0, 35, 35}}),
                 join({v, s.fluid("velocity_gradient"), s.fluid("pressure"), s.body("displacement_rate")}));
  const double phi = (mu + sizes * sizes * 1.3 / (12 * theta * time_step)) / sizes;
  for (int i = 0; i < 2; ++i) {
    CHECK(fluid[i] + of_fluid[i] == Approx(35 * phi * extra[i]).epsilon(1e-9));
    CHECK(fluid[7 + i] - of_body[i] == Approx(-35 * phi * extra[i]).epsilon(1e-9));
  }
}

TEST_CASE("the adjoint term of the body's form cancels the change of its traction") {
  // Thesis (3.32): tested with (du, dv) = (rate, v) of a change (u, v) with rate = u/(theta dt), the two
  // terms add up to nothing at xi = 1.
  const State s;
  const auto g = s.body("displacement_gradient");
  const auto at = [&](double size, double xi) {
    // v = 0 and du/dt = 0 but for the change: J = size (w - rate).
    const double w[2] = {0.3, -0.2}, rate[2] = {0.5, 0.4}, change[4] = {0.2, -0.3, 0.1, 0.25};
    std::vector<double> inputs;
    for (const double component : w) inputs.push_back(size * component);
    for (const double component : rate) inputs.push_back(size * component);
    for (int k = 0; k < 4; ++k) inputs.push_back(g[k] + size * theta * time_step * change[k]);
    const auto r = s.residual(*make_term(SolidSided{law(), {}, xi, 0}), inputs);
    double work = 0;
    for (int i = 0; i < 2; ++i) work += w[i] * r[i] + rate[i] * r[2 + i];
    for (int k = 0; k < 4; ++k) work += change[k] * r[4 + k];
    return work;
  };
  constexpr double h = 1e-4;
  const auto slope = [&](double xi) { return (at(h, xi) - at(-h, xi)) / (2 * h); };
  CHECK(slope(1) == Approx(0).margin(1e-7 * std::abs(slope(0))));
  CHECK(slope(-1) == Approx(2 * slope(0)).epsilon(1e-6));
  CHECK(std::abs(slope(0)) > 0.1);
}

TEST_CASE("a stress law carries exact first and second derivatives") {
  for (const std::string name : {"neo_hookean", "decoupled_neo_hookean", "saint_venant_kirchhoff"}) {
    const LawStress<solid::Piola> stress_law({test::material(name, 90, 0.2)});
    constexpr double h = 1e-5;
    double g[4] = {0.1, -0.05, 0.2, 0.15}, p[4], first[16], second[64];
    stress_law.evaluate(2, g, p, first, second);
    for (int k = 0; k < 4; ++k) {
      double plus[4], minus[4], first_plus[16], first_minus[16];
      g[k] += h;
      stress_law.evaluate(2, g, plus, first_plus, nullptr);
      g[k] -= 2 * h;
      stress_law.evaluate(2, g, minus, first_minus, nullptr);
      g[k] += h;
      for (int i = 0; i < 4; ++i)
        CHECK(first[i * 4 + k] == Approx((plus[i] - minus[i]) / (2 * h)).epsilon(0).margin(1e-6));
      for (int i = 0; i < 16; ++i)
        CHECK(second[i * 4 + k] == Approx((first_plus[i] - first_minus[i]) / (2 * h)).margin(2e-5));
    }
  }
}
