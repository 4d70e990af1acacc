// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "seam/base/rates.hpp"

using seam::rates_of;

TEST_CASE("rates of functions of time are found from the past") {
  const auto check = [](const std::function<double(double)>& function, double t, double first,
                        double second) {
    const auto [rate, second_rate] = rates_of(function, t);
    CAPTURE(t);
    CHECK(rate == Approx(first).epsilon(1e-10).margin(1e-10));
    CHECK(second_rate == Approx(second).epsilon(1e-6).margin(1e-6));
  };
  check([](double) { return 3.0; }, 7, 0, 0);
  check([](double t) { return 2 * t; }, 1000, 2, 0);
  check([](double t) { return 2 * t + t * t; }, 0, 2, 2);
  for (const double t : {0.0, 1.0, 10.0, 100.0})
    check([](double s) { return 0.3 * std::sin(s); }, t, 0.3 * std::cos(t), -0.3 * std::sin(t));
  // Periods of which many a length is a multiple.
  constexpr double rate = 16 * std::numbers::pi;
  check([](double t) { return std::sin(rate * t) / rate; }, 0, 1, 0);
  // A kink: what was before. Just behind it: what is now.
  const auto ramp = [](double t) { return t < 1 ? 5 * t : 5.0; };
  check(ramp, 1, 5, 0);
  CHECK(rates_of(ramp, 1.01)[0] == Approx(0).margin(1e-8));
  // No past: the future.
  CHECK(rates_of([](double t) { return t < 0 ? std::nan("") : 2 * t + std::pow(t, 3); }, 0)[0] == Approx(2));
  CHECK(std::isnan(rates_of([](double) { return std::nan(""); }, 0)[0]));
}
