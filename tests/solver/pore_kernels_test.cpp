// SPDX-License-Identifier: BSD-3-Clause
// Pores and what flows through them at a single point, against the balances written out by hand.
#include <catch2/catch.hpp>
#include <cmath>

#include "poroelasticity/kernels.hpp"
#include "poroelasticity/quantities.hpp"

using namespace seam;
using namespace seam::poro;

namespace {

constexpr double step = 0.2, theta = 0.6;
constexpr double bulk = 7, opening = 2, initial = 0.3;

using Pair = std::array<double, 2>;
using Square = std::array<std::array<double, 2>, 2>;

/// What F, its cofactor and its determinant are for a gradient, row by row.
struct Deformed {
  Square f, cofactor;
  double j;
  explicit Deformed(const std::vector<double>& g)
      : f{{{1 + g[0], g[1]}, {g[2], 1 + g[3]}}},
        cofactor{{{f[1][1], -f[1][0]}, {-f[0][1], f[0][0]}}},
        j(f[0][0] * f[1][1] - f[0][1] * f[1][0]) {}
};

Pair times(const Square& a, const Pair& x) {
  return {a[0][0] * x[0] + a[0][1] * x[1], a[1][0] * x[0] + a[1][1] * x[1]};
}
Square turned(const Square& a) { return {{{a[0][0], a[1][0]}, {a[0][1], a[1][1]}}}; }

/// J phi by bisection of (2.51): kappa/S - eta/(J - S) = p + kappa/(1 - phi_0) - eta/phi_0.
double fluid_volume(double j, double pressure) {
  const double wanted = pressure + bulk / (1 - initial) - opening / initial;
  double low = 1e-9 * j, high = (1 - 1e-9) * j;  // of the solid's share, with which the left side falls
  for (int k = 0; k < 200; ++k) {
    const double s = 0.5 * (low + high);
    (bulk / s - opening / (j - s) > wanted ? low : high) = s;
  }
  return j - low;
}

/// Kozeny and Carman in the thesis' form (4.26).
double opened(double m) {
  const auto shape = [](double of) { return of * of * of / (1 - of * of); };
  return shape(m) / shape(initial);
}

const Porosity porosity{initial, false, bulk, opening};
const Square inverse_permeability{{{4, 1}, {1, 3}}};
const PoreFlow flow{1.3, 0.5, porosity, true, {4, 1, 0, 1, 3, 0, 0, 0, 2}};
const std::vector<double> stretch{0.1, 0.3, -0.2, 0.15};

/// mu phi C K^-1 C^T w
Pair drag(const Deformed& d, double m, const Pair& w) {
  const Pair inner = times(inverse_permeability, times(turned(d.cofactor), w));
  Pair result = times(d.cofactor, inner);
  for (double& r : result) r *= 0.5 * m / d.j / opened(m);
  return result;
}

Point<2> point() {
  Point<2> x;
  x.position = {{0.3, -0.4}};
  x.normal = {{0.6, 0.8}};
  x.cell_size = 0.3;
  x.trace_size = 0.17;
  x.time = 1.1;
  x.step = step;
  x.theta = theta;
  return x;
}

/// What a kernel gives for what it reads, slot by slot.
template <class Kernel>
std::vector<double> residual(const Kernel& kernel, const std::vector<std::vector<double>>& slots) {
  std::vector<double> in;
  for (const auto& slot : slots) in.insert(in.end(), slot.begin(), slot.end());
  REQUIRE(in.size() == static_cast<std::size_t>(Kernel::Reads::size(2)));
  std::vector<double> out(static_cast<std::size_t>(Kernel::Tests::size(2)), 0.0);
  const Trial<2, double, typename Kernel::Reads> s{in.data()};
  Test<2, double, typename Kernel::Tests> r{out.data()};
  kernel.template operator()<2, double>(point(), s, r);
  return out;
}

struct NoEnergy {
  template <class T>
  T energy(const std::array<T, 3>&) const {
    return T(0.0);
  }
};

}  // namespace

TEST_CASE("pores are as wide as their balance of pressures says") {
  CHECK(porosity.fluid_volume(1.0, 0.0) == Approx(initial));
  for (const double j : {0.8, 1.0, 1.4})
    for (const double pressure : {-1.0, 0.0, 3.0}) {
      const double m = porosity.fluid_volume(j, pressure);
      CHECK(m == Approx(fluid_volume(j, pressure)).epsilon(1e-9));
      CHECK(porosity.back_pressure(m, pressure) ==
            Approx(pressure - opening / initial + opening / m).epsilon(1e-12));
    }
  double value = 0;
  std::vector<double> in = stretch;
  in.push_back(0.7);
  const Trial<2, double, PorosityValue::Reads> s{in.data()};
  PorosityValue{porosity}.operator()<2>(point(), s, &value);
  const double j = Deformed(stretch).j;
  CHECK(value == Approx(fluid_volume(j, 0.7) / j));
}

TEST_CASE("couplings see porosity and a third of the trace of the current permeability, in the plane, too") {
  const PoresFormula formula{flow, {0.4, 0.1, 0, 0.1, 0.6, 0, 0, 0, 0.9}};
  const auto at = formula.at<2, double>({stretch[0], stretch[1], stretch[2], stretch[3], 0.7});
  const Deformed d(stretch);
  const double m = fluid_volume(d.j, 0.7);
  double trace = 0.9;
  const Square k{{{0.4, 0.1}, {0.1, 0.6}}};
  for (int i = 0; i < 2; ++i)
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) trace += d.f[i][a] * k[a][b] * d.f[i][b];
  CHECK(at[0] == Approx(m / d.j));
  CHECK(at[1] == Approx(opened(m) * trace / (3 * d.j)).epsilon(1e-8));
}

TEST_CASE("what is stored is the change of J phi") {
  const std::vector<double> rate{0.2, -0.1, 0.3, 0.25}, old{0.05, 0.2, -0.1, 0.1},
      old_rate{-0.3, 0.1, 0.2, 0.4};
  const std::vector<double> u_rate{0.3, -0.2}, velocity{0.9, 0.5};
  const double p = 0.7, p_rate = -1.1, p_old = 0.4, p_old_rate = 0.6;
  const auto slots = [&] {
    return std::vector<std::vector<double>>{stretch,  rate, u_rate,  velocity, {p},
                                            {p_rate}, old,  {p_old}, old_rate, {p_old_rate}};
  };
  // By differences of J phi along the motion.
  const auto change = [&](const std::vector<double>& g, const std::vector<double>& g_rate, double at,
                          double at_rate) {
    constexpr double h = 1e-5;
    std::vector<double> ahead = g, behind = g;
    for (int k = 0; k < 4; ++k) {
      ahead[k] += h * g_rate[k];
      behind[k] -= h * g_rate[k];
    }
    return (fluid_volume(Deformed(ahead).j, at + h * at_rate) -
            fluid_volume(Deformed(behind).j, at - h * at_rate)) /
           (2 * h);
  };
  const Deformed d(stretch);
  const double m = fluid_volume(d.j, p);
  const auto by_rate = residual(Storage{porosity, false}, slots());
  CHECK(by_rate[0] == Approx(change(stretch, rate, p, p_rate)).epsilon(1e-6));
  const auto conservative = residual(Storage{porosity, true}, slots());
  CHECK(conservative[0] == Approx((m - fluid_volume(Deformed(old).j, p_old)) / (theta * step) -
                                  (1 - theta) / theta * change(old, old_rate, p_old, p_old_rate))
                               .epsilon(1e-6));
  const Pair w{velocity[0] - u_rate[0], velocity[1] - u_rate[1]};
  const Pair through = times(turned(d.cofactor), w);
  for (int i = 0; i < 2; ++i) CHECK(by_rate[1 + i] == Approx(-m / d.j * through[i]).epsilon(1e-8));
  const Pair area = times(d.cofactor, {0.6, 0.8});
  CHECK(residual(Seepage{porosity}, {stretch, u_rate, velocity, {p}})[0] ==
        Approx(m / d.j * (area[0] * w[0] + area[1] * w[1])).epsilon(1e-8));
  CHECK(residual(MassSource{Expression(0.8)}, {})[0] == -0.8);
}

TEST_CASE(
    "fluid in pores is driven by its pressure and its weight, and held by the skeleton, which gets the "
    "drag") {
  const std::vector<double> u_rate{0.3, -0.2}, velocity{0.9, 0.5}, v_rate{1.2, -0.8},
      v_gradient{0.7, 0.4, -0.3, 0.6};
  const std::vector<double> p_gradient{0.5, -0.9};
  const double p = 0.7;
  const Deformed d(stretch);
  const double m = fluid_volume(d.j, p), phi = m / d.j;
  const Pair w{velocity[0] - u_rate[0], velocity[1] - u_rate[1]}, held = drag(d, m, w);
  // J grad v du/dt = grad0 v C^T du/dt.
  const Pair moved = times(turned(d.cofactor), {u_rate[0], u_rate[1]});
  const auto r = residual(PoreMomentum{flow}, {stretch, u_rate, velocity, {p}});
  for (int i = 0; i < 2; ++i) {
    CHECK(r[i] == Approx(held[i]).epsilon(1e-8));
    for (int k = 0; k < 2; ++k) CHECK(r[2 + 2 * i + k] == Approx(-p * d.cofactor[i][k]));
  }
  const Pair pressed = times(d.cofactor, {p_gradient[0], p_gradient[1]});

  // The mixture has phi of what acts on the fluid, or as printed the drag and the gradient of pressure.
  for (const bool printed : {false, true}) {
    const MixtureShare share{porosity, printed};
    const double of_mixture = printed ? 0 : phi;
    const auto inertia = residual(PoreInertia{1.3, share}, {stretch, u_rate, v_rate, v_gradient, {p}});
    for (int i = 0; i < 2; ++i) {
      const double carried = v_gradient[2 * i] * moved[0] + v_gradient[2 * i + 1] * moved[1];
      const double force = 1.3 * (d.j * v_rate[i] - carried);
      CHECK(inertia[2 + i] == Approx(force).epsilon(1e-8));
      CHECK(inertia[i] == Approx(of_mixture * force).epsilon(1e-8));
    }
    const auto weight = residual(FluidLoad{{Expression(0.0), Expression(-9.0)}, 1.3, share}, {stretch, {p}});
    const auto nodal = residual(NodalFluidLoad{1.3, share}, {stretch, {p}, {0, -9}});
    for (const auto& load : {weight, nodal}) {
      CHECK(load[0] == 0);
      CHECK(load[1] == Approx(of_mixture * 1.3 * d.j * 9));
      CHECK(load[2] == 0);
      CHECK(load[3] == Approx(1.3 * d.j * 9));
    }
  }
  const auto exchange = residual(PrintedExchange{flow}, {stretch, u_rate, velocity, {p}, p_gradient});
  for (int i = 0; i < 2; ++i) CHECK(exchange[i] == Approx(-phi * (pressed[i] + held[i])).epsilon(1e-8));

  const auto skeleton = std::make_shared<LawPotential<3, NoEnergy>>(NoEnergy{});
  const auto mixture = residual(MixtureStress{{skeleton, porosity}}, {stretch, {p}});
  const double back = p - opening / initial + opening / m;
  for (int k = 0; k < 4; ++k) CHECK(mixture[k] == Approx(-back * d.cofactor[k / 2][k % 2]).epsilon(1e-8));

  const auto stabilised = residual(ResidualStabilisation{flow, {}, 0.5},
                                   {stretch, u_rate, velocity, v_rate, v_gradient, {p}, p_gradient});
  // tau = phi_0/2/(mu phi_0/K + rho/(theta dt)), with the mean of the resistances as pores are now.
  const double tau = 0.5 * initial / (0.5 * initial * 3.5 / opened(m) + 1.3 / (theta * step));
  Pair all{};
  for (int i = 0; i < 2; ++i)
    all[i] = pressed[i] + held[i] +
             1.3 * (d.j * v_rate[i] - v_gradient[2 * i] * moved[0] - v_gradient[2 * i + 1] * moved[1]);
  const Pair tested = times(turned(d.cofactor), all);
  for (int i = 0; i < 2; ++i) CHECK(stabilised[i] == Approx(tau / d.j * tested[i]).epsilon(1e-7));
}
