// SPDX-License-Identifier: BSD-3-Clause
// What passes between a film of fluid and the pores of a body that closes it, at a single point.
#include "nitsche_fsci/porous_contact_kernels.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace seam;
using namespace seam::fsci;

namespace {

void check_exchange() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1), positive(0.1, 3);
  for (int k = 0; k < 100; ++k) {
    const double stress = any(random), penalty = positive(random), speed = any(random),
                 pressure = any(random), seepage = any(random), c = positive(random);
    const auto at = [&](Seal::Kind kind, double alpha) {
      return exchange<double>({kind, 0, 0}, alpha, stress, penalty, speed, pressure, seepage, c);
    };
    for (const double alpha : {0.0, 0.3, 0.99, 1.0}) {
      INFO(alpha);
      const auto e = at(Seal::Kind::resistance, alpha);
      CHECK(e.pull == Approx(stress + penalty * (speed - e.into_fluid)).margin(1e-12));
      CHECK(e.into_fluid == e.out_of_pores);
      CHECK(e.into_fluid == Approx((1 - alpha) * (seepage + (pressure + e.pull) / c)).margin(1e-12));
      CHECK(e.pore_pressure == Approx(alpha * (pressure + c * seepage) - (1 - alpha) * e.pull).margin(1e-12));
      CHECK(seepage * (e.pore_pressure - pressure) + e.into_fluid * (pressure + e.pull) > -1e-12);
      const auto printed = at(Seal::Kind::printed, alpha);
      CHECK(printed.into_fluid == seepage);
      CHECK(printed.out_of_pores == Approx((1 - alpha) * seepage));
      CHECK(printed.pull == Approx(stress + penalty * (speed - seepage)));
      CHECK(printed.pore_pressure == Approx(alpha * pressure - (1 - alpha) * printed.pull).margin(1e-12));
    }
    // p + F = R q of the body's own seepage: then q^ is that.
    const double alpha = 0.4, resistance = c * alpha / (1 - alpha);
    const double flow = (stress + penalty * speed + pressure) / (resistance + penalty);
    const auto exact =
        exchange<double>({Seal::Kind::resistance, 0, 0}, alpha, stress, penalty, speed, pressure, flow, c);
    CHECK(exact.into_fluid == Approx(flow).margin(1e-12));
    CHECK(exact.pore_pressure == Approx(pressure).margin(1e-12));
    const auto shut = at(Seal::Kind::sudden, 1.0);
    CHECK(shut.into_fluid == 0);
    CHECK(shut.out_of_pores == 0);
    CHECK(shut.pore_pressure == pressure);
  }
}

/// Also where the gap was narrow at the start of a step, and where none is left.
void check_width() {
  Point<2> x;
  x.cell_size = 0.5;
  const auto closed = [&](const Seal& seal, double gap, double start) {
    x.gap = gap;
    return seal.closed<2, double, double>(x, start);
  };
  const Seal wide{Seal::Kind::resistance, 0.02, 1e-4}, by_cell{Seal::Kind::resistance, 0, 0},
      sudden{Seal::Kind::sudden, 0.02, 1e-4};
  CHECK(closed(wide, 0.03, 0.03) == 0);
  CHECK(closed(wide, 0.005, 0.005) == Approx(0.75));
  CHECK(closed(by_cell, 0.004, 0.004) == Approx(0.2));
  CHECK(closed(wide, 0.005, 5e-5) == 1);
  CHECK(closed(wide, -1e-9, 0.01) == 1);
  CHECK(closed(sudden, 0.005, 0.005) == 0);
  CHECK(closed(sudden, 0.005, 5e-5) == 1);
  CHECK(closed(by_cell, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()) ==
        0);
}

struct GivenPores final : Law {
  void evaluate(int, const double*, double* value, double*, double*) const override {
    value[0] = 0.4;   // porosity
    value[1] = 0.02;  // a third of the trace of the permeability
  }
};

/// Where pores are tight their pressure resists what flows out, with c = mu l/k: power is lost, not won.
void check_tight() {
  Point<2> x;
  x.normal = {{-0.6, -0.8}};  // out of the fluid: the body's own is (0.6, 0.8)
  x.cell_size = 0.5;
  const PorousSide body{
      {std::make_shared<GivenPores>(), {}, false}, nullptr, 3, 1, {Seal::Kind::resistance, 0, 0}};
  // grad u, du/dt, v, p
  const double in[] = {0.1, 0.2, -0.1, 0.3, 0.5, -0.2, 0.9, 0.7, 1.7};
  REQUIRE(PorousCovered::Reads::size(2) == 9);
  double out[2] = {};
  Test<2, double, PorousCovered::Tests> r{out};
  PorousCovered{body}.operator()<2, double, double>(x, Trial<2, double, PorousCovered::Reads>{in}, r);
  const double seepage = 0.4 * ((0.9 - 0.5) * 0.6 + (0.7 + 0.2) * 0.8), c = 3 * 0.5 / 0.02;
  CHECK(out[0] == Approx((1.7 + c * seepage) * 0.6));
  CHECK(out[1] == Approx((1.7 + c * seepage) * 0.8));
}

}  // namespace

TEST_CASE("a seal takes power, loses no fluid, and closes within its width") {
  check_exchange();
  check_width();
  check_tight();
}
