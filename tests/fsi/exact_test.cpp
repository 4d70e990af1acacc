// SPDX-License-Identifier: BSD-3-Clause
// The manufactured solution against differences, and against the solid's own law.
#include <catch2/catch.hpp>
#include <functional>

#include "exact_state.hpp"
#include "kernels.hpp"
#include "seam/physics/stress_law.hpp"
#include "solid_sided.hpp"

using namespace seam;

namespace {

constexpr double mu = 0.7, rho = 1.3, rho_body = 2.1, young = 90, poisson = 0.2;
// A fast decay, so that rates matter.
const std::string fast =
    "viscosity: 0.7, density: 1.3, body_density: 2.1, young: 90, poisson: 0.2, fluid_amplitude: 0.8, "
    "body_amplitude: 0.6, decay: 1.9, wave_number: 2.3";
constexpr double x0[2] = {0.31, -0.27}, t0 = 0.4;

/// d/dx_j (j = 2: d/dt) by differences of fourth order.
std::vector<double> derivative(const std::function<std::vector<double>(const double*, double)>& f, int j) {
  constexpr double h = 1e-3;
  const auto at = [&](double s) {
    double x[2] = {x0[0], x0[1]}, t = t0;
    (j == 2 ? t : x[j]) += s * h;
    return f(x, t);
  };
  const auto a = at(-2), b = at(-1), c = at(1), d = at(2);
  std::vector<double> result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = (a[i] - 8 * b[i] + 8 * c[i] - d[i]) / (12 * h);
  return result;
}

}  // namespace

TEST_CASE("the manufactured fields have the gradients and rates that they say") {
  const auto exact = test::vortices(fast);
  const auto of = [&](const std::string& name) {
    return [&exact, name](const double* x, double t) { return test::values(*exact, name, x, t); };
  };
  for (const auto& [field, gradient] :
       {std::pair("velocity", "velocity_gradient"), std::pair("displacement", "displacement_gradient")}) {
    const auto known = test::values(*exact, gradient, x0, t0);
    for (int j = 0; j < 2; ++j) {
      const auto slope = derivative(of(field), j);
      for (int i = 0; i < 2; ++i) CHECK(known[i * 2 + j] == Approx(slope[i]).epsilon(1e-9));
    }
  }
  const auto rate = derivative(of("displacement"), 2);
  for (int i = 0; i < 2; ++i)
    CHECK(test::values(*exact, "displacement_rate", x0, t0)[i] == Approx(rate[i]).epsilon(1e-9));
  const auto grad = test::values(*exact, "velocity_gradient", x0, t0);
  CHECK(grad[0] + grad[3] == Approx(0).margin(1e-14));
}

TEST_CASE("the body forces balance momentum") {
  const auto exact = test::vortices(fast);
  const auto value = [&](const std::string& name, const double* x, double t) {
    return test::values(*exact, name, x, t);
  };
  SECTION("of the fluid, thesis (3.45)") {
    const auto rate = derivative([&](const double* x, double t) { return value("velocity", x, t); }, 2);
    const auto v = value("velocity", x0, t0), grad = value("velocity_gradient", x0, t0);
    const auto stress = [&](const double* x, double t) { return value("fluid_stress", x, t); };
    const auto along_x = derivative(stress, 0), along_y = derivative(stress, 1);
    for (int i = 0; i < 2; ++i) {
      const double balance = rho * (rate[i] + grad[i * 2] * v[0] + grad[i * 2 + 1] * v[1]) -
                             (along_x[i * 2] + along_y[i * 2 + 1]);
      CHECK(rho * value("fluid_force", x0, t0)[i] == Approx(balance).epsilon(1e-8));
    }
    const auto sigma = value("fluid_stress", x0, t0);
    CHECK(sigma[1] == Approx(mu * (grad[1] + grad[2])).epsilon(1e-14));
    CHECK(sigma[0] - sigma[3] == Approx(2 * mu * (grad[0] - grad[3])).epsilon(1e-14));
    CHECK(-0.5 * (sigma[0] + sigma[3]) == Approx(value("pressure", x0, t0)[0]).epsilon(1e-14));
  }
  SECTION("of the body, thesis (3.46)") {
    // The first Piola-Kirchhoff stress from the solid plugin's own law.
    const LawStress<solid::Piola> law({test::material("neo_hookean", young, poisson)});
    const auto piola = [&](const double* x, double t) {
      std::vector<double> p(4);
      law.evaluate(2, value("displacement_gradient", x, t).data(), p.data(), nullptr, nullptr);
      return p;
    };
    const auto along_x = derivative(piola, 0), along_y = derivative(piola, 1);
    const auto speed =
        derivative([&](const double* x, double t) { return value("displacement_rate", x, t); }, 2);
    for (int i = 0; i < 2; ++i) {
      const double balance = rho_body * speed[i] - (along_x[i * 2] + along_y[i * 2 + 1]);
      CHECK(rho_body * value("body_force", x0, t0)[i] == Approx(balance).epsilon(1e-8));
    }
    Mat<2, 2, double> gradient;
    const auto g = value("displacement_gradient", x0, t0), sigma = value("body_stress", x0, t0);
    std::copy(g.begin(), g.end(), gradient.c.begin());
    for (int j = 0; j < 2; ++j) {
      Vec<2, double> unit;
      unit[j] = 1;
      const auto traction = fsci::body_traction<2, double>(law, gradient, unit);
      for (int i = 0; i < 2; ++i) CHECK(traction[i] == Approx(sigma[i * 2 + j]).epsilon(1e-12));
    }
  }
}

TEST_CASE("a displacement of a tiny decay keeps its digits") {
  const auto exact = test::vortices("viscosity: 1, young: 100, poisson: 0.1, decay: 1e-9, wave_number: 2.3");
  const auto u = test::values(*exact, "displacement", x0, t0), v = test::values(*exact, "velocity", x0, t0);
  for (int i = 0; i < 2; ++i) CHECK(u[i] == Approx(t0 * v[i]).epsilon(1e-9));
}
