// SPDX-License-Identifier: BSD-3-Clause
// What passes between a film of fluid and the pores of a body that closes it, at a single point.
#include <catch2/catch.hpp>
#include <random>

#include "nitsche_fsci/porous_contact_measures.hpp"

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
  // A resistance leaves dry films a level of pressure.
  CHECK(closed(wide, 0.005, 5e-5) == Approx(1 - 1e-4).epsilon(1e-12));
  CHECK(closed(wide, -1e-9, 0.01) == Approx(1 - 1e-4).epsilon(1e-12));
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

struct NoStress final : Law {
  void evaluate(int, const double*, double* value, double*, double*) const override {
    std::fill_n(value, 4, 0.0);
  }
};

/// Where pores are tight their pressure resists what flows out, with c = mu l/k: power is lost, not won.
void check_tight() {
  Point<2> x;
  x.normal = {{-0.6, -0.8}};  // out of the fluid: the body's own is (0.6, 0.8)
  x.cell_size = 0.5;
  const PorousSide body{
      {std::make_shared<GivenPores>(), {}, false}, {nullptr, nullptr, 1}, 3, {Seal::Kind::resistance, 0, 0}};
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

/// Both see the mean of both pressures; what leaves one enters the other, and no power is lost.
void check_open_pores() {
  Point<2> x;
  x.normal = {{-0.6, -0.8}};
  x.cell_size = 0.5;
  x.gap = -0.01;
  x.constant = {200, 50};
  using Kernel = PorousShut<Facing::porous>;
  const auto law = std::make_shared<NoStress>();
  Kernel kernel{{{std::make_shared<GivenPores>(), {}, false}, {law, law, 0.5}, 3, {}}, true};
  // grad u, du/dt, v, p; du'/dt, grad u', p'
  const double in[] = {0.1, 0.2, -0.1, 0.3, 0.5, -0.2, 0.9, 0.7, 1.7, 0.3, -0.1, 0.05, 0.1, -0.2, 0.1, 0.6};
  REQUIRE(Kernel::Reads::size(2) == 16);
  const auto at = [&](Whose whose) {
    kernel.body.bodies.stress = whose;
    std::array<double, 6> out{};
    Test<2, double, Kernel::Tests> r{out.data()};
    kernel.operator()<2, double, double>(x, Trial<2, double, Kernel::Reads>{in}, r);
    return out;
  };
  const auto out = at(Whose::own);
  const double seepage = 0.4 * ((0.9 - 0.5) * 0.6 + (0.7 + 0.2) * 0.8), mean = (1.7 + 0.6) / 2;
  // u, v, p, p'
  CHECK(out[2] == Approx(mean * 0.6));
  CHECK(out[3] == Approx(mean * 0.8));
  CHECK(out[4] == Approx(seepage / 2));
  CHECK(out[5] == Approx(-seepage / 2));
  // Half of what this look's own power is: q (p^ - p) + q^ p - q^ p' = 0.
  CHECK(seepage * (mean - 1.7) + out[4] * 1.7 + out[5] * 0.6 == Approx(0).margin(1e-12));
  // The gap's penalty is that of whose stress it is; F = -p^ where it is less.
  CHECK(out[0] == Approx(-std::min(-0.5 * 200 * 0.01, -mean) * 0.6));
  CHECK(at(Whose::other)[1] == Approx(-std::min(-0.5 * 50 * 0.01, -mean) * 0.8));
  // Across what the fluid's mesh ends before they are sealed.
  x.gap = 0.1;
  const auto apart = at(Whose::own);
  CHECK(apart[2] == Approx((1.7 + 3 * 0.5 / 0.02 * seepage) * 0.6));
  CHECK(apart[4] == 0);
  CHECK(apart[5] == 0);
  const Exchange<double> dry = between_pores<double>(-2, mean, seepage, 0);
  CHECK(dry.pull == -2);
  CHECK(dry.into_fluid == 0);
  CHECK(dry.out_of_pores == out[4]);
  CHECK(dry.into_facing == -out[5]);
  CHECK(dry.pore_pressure == Approx(mean));
}

/// Pores fill a gap that opens, and resist it: p^ = p + c (q - g'), of which power is lost.
void check_opening() {
  Point<2> x;
  x.normal = {{-0.6, -0.8}};
  x.cell_size = 0.5;
  x.constant = {200, 50};
  const auto law = std::make_shared<NoStress>();
  const auto at = [&]<Facing facing>(std::integral_constant<Facing, facing>, bool fades, double gap,
                                     double pressure = 9) {
    using Kernel = PorousShut<facing>;
    const Kernel kernel{
        {{std::make_shared<GivenPores>(), {}, false}, {law, law, 0.5}, 3, {Seal::Kind::resistance, 0, 0}},
        fades};
    std::vector<double> in(Kernel::Reads::size(2), 0.0), out(Kernel::Tests::size(2), 0.0);
    const auto set = [&]<class R>(R, std::initializer_list<double> values) {
      std::copy(values.begin(), values.end(), &in[Kernel::Reads::template offset<R>(2)]);
    };
    set(Rate<Displacement>{}, {0.5, -0.2});
    set(Value<PoreVelocity>{}, {0.9, 0.7});
    set(Value<PorePressure>{}, {pressure});
    set(Rate<FacingDisplacement>{}, {0.8, 0.1});
    if constexpr (facing == Facing::porous) set(Value<FacingPressure>{}, {0.6});
    x.gap = gap;
    Test<2, double, typename Kernel::Tests> r{out.data()};
    kernel.template operator()<2, double, double>(x, Trial<2, double, typename Kernel::Reads>{in.data()}, r);
    return out;
  };
  const auto tight = std::integral_constant<Facing, Facing::tight>{};
  const auto porous = std::integral_constant<Facing, Facing::porous>{};
  const double seepage = 0.4 * ((0.9 - 0.5) * 0.6 + (0.7 + 0.2) * 0.8), opening = 0.3 * 0.6 + 0.3 * 0.8,
               c = 3 * 0.5 / 0.02;
  // u, v, p; S = 0.5 * 200 g is more than F.
  const auto open = at(tight, true, 1e-4);
  CHECK(open[4] == Approx(opening));
  CHECK(open[2] == Approx((9 + c * (seepage - opening)) * 0.6));
  CHECK(open[0] == Approx(open[2]));
  // In contact, S less than F (the harmonic mean of both scales is 80), what fills the gap resists by as
  // much.
  CHECK(at(tight, true, 1e-4, -40)[0] == Approx(-(0.5 * 80 * 1e-4 + c * opening) * 0.6));
  // Half of it where it fades, nothing in an overlap, far away, or where the fluid at the edge decides.
  CHECK(at(tight, true, 0.75 * 5e-3 * 0.5)[4] == Approx(opening / 2));
  CHECK(at(tight, true, -0.5 * 1e-3 * 0.5)[4] == Approx(opening / 2));
  for (const double gap : {-1e-3, 5e-3}) CHECK(at(tight, true, gap)[4] == 0);
  CHECK(at(tight, false, 1e-4)[4] == 0);
  CHECK(at(tight, false, 1e-4)[2] == Approx((9 + c * seepage) * 0.6));
  // Each side fills a half, and each look says so of both.
  const auto both = at(porous, true, 1e-4);
  CHECK(both[4] == Approx(seepage / 2 + opening / 4));
  CHECK(both[5] == Approx(-seepage / 2 + opening / 4));
}

/// What is said of a point that touches, and of one that does not.
void check_touch() {
  const Touch pressed{-1e-3, -5, -1, 2}, apart{1e-3, -1, -5, 2};
  CHECK(pressed(TouchNumber::gap, 0.6) == -1e-3);
  CHECK(pressed(TouchNumber::touches, 0.6) == 1);
  CHECK(pressed(TouchNumber::pressure, 0.6) == 5);
  CHECK(pressed(TouchNumber::effective, 0.6) == 3);
  CHECK(pressed(TouchNumber::traction, 0.6) == Approx(3));
  CHECK(std::isinf(apart(TouchNumber::effective, 0.6)));
  for (const TouchNumber number : {TouchNumber::touches, TouchNumber::pressure, TouchNumber::traction})
    CHECK(apart(number, 0.6) == 0);
}

/// A wet point that counts as dry: what leaves the pores enters those opposite, and next to nothing the film.
void check_dry_film() {
  using Kernel = PorousFilm<Facing::porous>;
  Point<2> x;
  x.normal = {{-0.6, -0.8}};
  x.cell_size = x.trace_size = 0.5;
  x.gap = 1e-3;
  const auto law = std::make_shared<NoStress>();
  // As narrow at the start of the step, by as much as nothing has moved since.
  Kernel kernel{
      {1, 3, false},
      {{std::make_shared<GivenPores>(), {}, false}, {law, law, 0.5}, 3, {Seal::Kind::resistance, 0, 2e-3}},
      {},
      1,
      {}};
  std::vector<double> in(Kernel::Reads::size(2), 0.0);
  const auto set = [&]<class R>(R, std::initializer_list<double> values) {
    std::copy(values.begin(), values.end(), &in[Kernel::Reads::offset<R>(2)]);
  };
  set(Rate<Displacement>{}, {0.5, -0.2});
  set(Value<PoreVelocity>{}, {0.9, 0.7});
  set(Value<PorePressure>{}, {1.7});
  set(Value<FacingPressure>{}, {0.6});
  std::vector<double> out(Kernel::Tests::size(2), 0.0);
  Test<2, double, Kernel::Tests> r{out.data()};
  kernel.operator()<2, double, double>(x, Trial<2, double, Kernel::Reads>{in.data()}, r);
  const double seepage = 0.4 * ((0.9 - 0.5) * 0.6 + (0.7 + 0.2) * 0.8);
  const double left = 1e-4 / (3 * 0.5 / 0.02) * 1.7;  // of the pores' own pressure, into the film
  CHECK(*r.value(PorePressure{}).data == Approx(seepage / 2 + left).epsilon(1e-9));
  CHECK(*r.value(FacingPressure{}).data == Approx(-seepage / 2));
  CHECK(r.value(PoreVelocity{}).data[0] == Approx((1.7 + 0.6) / 2 * 0.6));
  // The fluid's balance has v - du/dt along the body's normal, and what is left to the film.
  CHECK(*r.value(Pressure{}).data == Approx(-(0.5 * 0.6 - 0.2 * 0.8) - left).epsilon(1e-9));
  // Where the pores' pressure stands for the fluid's in contact the film stays open, but for none at all.
  const auto passing = [&](bool fades, double gap) {
    kernel.fades = fades;
    x.gap = gap;
    return kernel.passes<2, double, double>(x, Trial<2, double, Kernel::Reads>{in.data()});
  };
  CHECK(passing(false, 1e-3).into_fluid == Approx(left).epsilon(1e-9));
  CHECK(passing(true, 1e-3).into_facing == 0);
  CHECK(passing(true, 1e-3).into_fluid == passing(true, 1e-3).out_of_pores);
  CHECK(std::abs(passing(true, 1e-3).into_fluid) > 0.1);
  CHECK(passing(true, -1e-3).into_fluid == Approx(left).epsilon(1e-9));
}

}  // namespace

TEST_CASE("a seal takes power, loses no fluid, and closes within its width") {
  check_exchange();
  check_width();
  check_tight();
  check_open_pores();
  check_opening();
  check_touch();
  check_dry_film();
}
