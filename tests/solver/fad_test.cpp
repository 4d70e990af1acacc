// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of all functions against differences of fourth order.
#include "seam/term/fad.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "seam/term/tensor.hpp"

using namespace seam;

namespace {

template <class Function>
void check(const char* name, const Function& f, double x, double y) {
  INFO(name << " at " << x << ", " << y);
  using First = Fad<2>;
  using Second = Fad<2, First>;
  const auto exact = [&](double at_x, double at_y) {
    Second a{First(at_x)}, b{First(at_y)};
    a.v.d[0] = 1;
    b.v.d[1] = 1;
    a.d[0] = First(1.0);
    b.d[1] = First(1.0);
    return f(a, b);
  };
  const auto slope = [](const auto& g) {
    constexpr double h = 1e-3;
    return (8 * (g(h) - g(-h)) - g(2 * h) + g(-2 * h)) / (12 * h);
  };
  const Second found = exact(x, y);
  CHECK(found.v.v == Approx(f(x, y)).epsilon(1e-14));
  const double by_x = slope([&](double h) { return f(x + h, y); }),
               by_y = slope([&](double h) { return f(x, y + h); });
  CHECK(found.v.d[0] == Approx(by_x).epsilon(1e-8).margin(1e-8));
  CHECK(found.v.d[1] == Approx(by_y).epsilon(1e-8).margin(1e-8));
  for (int i = 0; i < 2; ++i) {
    CHECK(found.d[i].v == Approx(found.v.d[i]).epsilon(1e-14));
    CHECK(found.d[i].d[0] ==
          Approx(slope([&](double h) { return exact(x + h, y).v.d[i]; })).epsilon(1e-8).margin(1e-8));
    CHECK(found.d[i].d[1] ==
          Approx(slope([&](double h) { return exact(x, y + h).v.d[i]; })).epsilon(1e-8).margin(1e-8));
  }
}

}  // namespace

TEST_CASE("first and second derivatives of every function are those of differences") {
  using std::abs, std::acos, std::acosh, std::asin, std::asinh, std::atan, std::atan2, std::atanh, std::cbrt,
      std::cos, std::cosh, std::erf, std::exp, std::expm1, std::log, std::log1p, std::max, std::min, std::pow,
      std::sin, std::sinh, std::sqrt, std::tan, std::tanh;
  for (const auto& [x, y] : {std::pair(0.7, 1.3), std::pair(1.9, 0.4)}) {
    check(
        "a + b", [](auto a, auto b) { return a + b + 2.0 + (1.0 + b); }, x, y);
    check(
        "a - b", [](auto a, auto b) { return a - b - 2.0 + (1.0 - b) + -a; }, x, y);
    check(
        "a b", [](auto a, auto b) { return 2.0 * a * b * 3.0; }, x, y);
    check(
        "a / b", [](auto a, auto b) { return a / b + a / 2.0 + 3.0 / b; }, x, y);
    check(
        "sqrt", [](auto a, auto b) { return sqrt(a * b); }, x, y);
    check(
        "exp", [](auto a, auto b) { return exp(a * b); }, x, y);
    check(
        "expm1", [](auto a, auto b) { return expm1(a * b); }, x, y);
    check(
        "log", [](auto a, auto b) { return log(a + b * b); }, x, y);
    check(
        "sin", [](auto a, auto b) { return sin(a + 2.0 * b); }, x, y);
    check(
        "cos", [](auto a, auto b) { return cos(a - 2.0 * b); }, x, y);
    check(
        "tanh", [](auto a, auto b) { return tanh(a - 0.3 * b); }, x, y);
    check(
        "tan", [](auto a, auto b) { return tan(0.3 * a * b); }, x, y);
    check(
        "asin, acos, atan",
        [](auto a, auto b) { return asin(0.4 * a * b) + 2.0 * acos(0.3 * a) + atan(a / b); }, x, y);
    check(
        "sinh, cosh", [](auto a, auto b) { return sinh(a * b) + 2.0 * cosh(a - 0.4 * b); }, x, y);
    check(
        "asinh, acosh, atanh",
        [](auto a, auto b) { return asinh(a * b) + 2.0 * acosh(1.5 + a * b) + 3.0 * atanh(0.3 * a * b); }, x,
        y);
    check(
        "erf, log1p, cbrt",
        [](auto a, auto b) { return erf(a - b) + 2.0 * log1p(a * b) + 3.0 * cbrt(a * a + b); }, x, y);
    check(
        "pow of variables", [](auto a, auto b) { return pow(a, b) + pow(1.7, a * b) + pow(a + b, a); }, x, y);
    check(
        "select", [](auto a, auto b) { return select(a < b, a * b, a + 0.0 * b); }, x, y);
    check(
        "atan2", [](auto a, auto b) { return atan2(a * a, b - 3.0); }, x, y);
    check(
        "pow", [](auto a, auto b) { return pow(a * b, 2.3) + pow(b, -0.7); }, x, y);
    check(
        "abs", [](auto a, auto b) { return abs(a - 3.0 * b) + abs(a + b); }, x, y);
    check(
        "max", [](auto a, auto b) { return max(a * a, b * b); }, x, y);
    check(
        "min", [](auto a, auto b) { return min(a * a, b * b); }, x, y);
  }
}

TEST_CASE("lengths have no derivative that is none where they are 0") {
  using T = Fad<2>;
  const Vec<2, T> zero{{T(0.0, 0), T(0.0, 1)}}, other{{T(3.0, 0), T(-4.0, 1)}};
  CHECK(norm(zero).v == 0);
  CHECK_FALSE(isnan(norm(zero)));
  CHECK(isnan(sqrt(dot(zero, zero))));
  CHECK(norm(other).v == 5);
  CHECK(norm(other).d[0] == Approx(0.6));
  CHECK(norm(other).d[1] == Approx(-0.8));
  const Vec<2, T> half = other / 2.0, twice = other * T(2.0);
  CHECK(half[1].v == -2);
  CHECK(twice[0].d[0] == 2);
}
