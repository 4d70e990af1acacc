// SPDX-License-Identifier: BSD-3-Clause
#include <muParser.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "seam/base/diagnostics.hpp"
#include "seam/base/rates.hpp"
#include "seam/scene/expression.hpp"
#include "seam/scene/formula_rates.hpp"

using seam::Error;
using seam::Expression;

namespace {
const std::map<std::string, double> parameters{{"h", 0.0625}, {"E", 100.0}};
}

TEST_CASE("constants are recognised and evaluated") {
  CHECK(seam::evaluate_constant("1/16", {}) == 0.0625);
  CHECK(seam::evaluate_constant("2*E", parameters) == 200.0);
  CHECK(seam::evaluate_constant("${h} * 2", parameters) == 0.125);
  CHECK(seam::evaluate_constant("-1.5e-3", {}) == -1.5e-3);
  CHECK(Expression("E - E", parameters).is_zero());
  CHECK(Expression("0", {}).is_zero());
  CHECK_FALSE(Expression("0*t", {}).is_constant());
}

TEST_CASE("expressions see position and time") {
  const std::array<double, 3> x{2.0, 3.0, 5.0};
  CHECK(Expression("x + 10*y + 100*z + 1000*t", {})(x.data(), 3, 7.0) == 7532.0);
  CHECK(Expression("z", {})(x.data(), 2, 0.0) == 0.0);
  const Expression ramp("t < 1000 ? 0 : 0.002*(t - 1000)", {});
  CHECK(ramp(x.data(), 2, 500.0) == 0.0);
  CHECK(ramp(x.data(), 2, 2000.0) == Approx(2.0));
  CHECK(Expression("x > 1 && y < 1 || t == 4 ? E : -1", parameters)(x.data(), 2, 4.0) == 100.0);
  CHECK(Expression("sin(pi/2)*t", {})(x.data(), 2, 3.0) == Approx(3.0));
}

TEST_CASE("expressions know their rates to rounding") {
  const std::array<double, 2> x{0.4, 0.7};
  const auto rates = [&](const std::string& text, double t) {
    return Expression(text, parameters).rates(x.data(), 2, t);
  };
  for (const double t : {0.0, 1.0, 10.0, 100.0, 1e6}) {
    CHECK(rates("0.3*sin(t)", t)[0] == Approx(0.3 * std::cos(t)).epsilon(1e-14));
    CHECK(rates("0.3*sin(t)", t)[1] == Approx(-0.3 * std::sin(t)).epsilon(1e-14));
  }
  CHECK(rates("E", 1) == std::array<double, 2>{0, 0});
  CHECK(rates("x*y", 1) == std::array<double, 2>{0, 0});
  CHECK(rates("x*t^2", 3) == std::array<double, 2>{0.4 * 6, 0.4 * 2});
}

TEST_CASE("rates of all that formulas are made of agree with differences") {
  const std::array<double, 2> x{0.4, 0.7};
  // clang-format off
  for (const std::string text :
       {"-2^2*t", "2^-t", "2^3^t", "-t^2*x", "t^3", "t*t*t*t", "2*t/3 + 1", "1 - 2 - 3*t", "8/4/2*t", "t/(1 + t^2)",
        "x/(t + y)", "t < 0.5 ? t : 1 - t*t", "t < 0.2 ? 0 : t < 0.6 ? (t - 0.2)^2 : 0.16 + 3*t", "1 - (x < 3 ? t : 2)*t",
        "t >= 0.5 && t <= 1 ? 3*t : -t", "t > 5 || t != t ? 1 : t^3", "(t == x)*t + t^2", "min(t, 0.5, x*t)", "max(t, x)*avg(t, x, 1)",
        "sum(t, t^2, 1)", "abs(t - 1)*t", "sign(t - 0.5)*rint(3*t)*t^2", "exp(-x*t)*cos(2*pi*t + y)", "sqrt(t + 1)/log(t + 3)",
        "log2(t + 1) + log10(t + 1) + ln(2 + t)", "atan2(sin(t), cos(t) + x)", "asin(t/9) + acos(t^2/9) + atan(t)",
        "sinh(t) + cosh(t)*tanh(t)", "asinh(t) + acosh(t + 1.5) + atanh(t/9)", "t^x", "(t + 2)^(x*t)", "tan(t)^2", "2*(t - 1)^0", "+t"}) {
    // clang-format on
    const Expression expression(text, {});
    for (const double t : {0.07, 0.3, 0.45, 0.77, 1.1, 1.3}) {
      CAPTURE(text, t);
      const auto [rate, second_rate] = expression.rates(x.data(), 2, t);
      const auto differences = seam::rates_of([&](double time) { return expression(x.data(), 2, time); }, t);
      CHECK(rate == Approx(differences[0]).epsilon(1e-8).margin(1e-8));
      CHECK(second_rate == Approx(differences[1]).epsilon(1e-4).margin(1e-4));
    }
  }
}

TEST_CASE("at a kink the rates of a formula are those of the past") {
  const double x = 0;
  const auto rates = [&](const std::string& text, double t) { return Expression(text, {}).rates(&x, 1, t); };
  using Rates = std::array<double, 2>;
  for (const std::string text : {"t < 1 ? 3*t : 3", "t <= 1 ? 3*t : 3", "t > 1 ? 3 : 3*t", "t >= 1 ? 3 : 3*t",
                                 "min(3*t, 3)", "3*min(t, 1)", "max(3*t, -1, t)", "3*t + 5*max(0, t - 1)"}) {
    CAPTURE(text);
    CHECK(rates(text, 1) == Rates{3, 0});
  }
  CHECK(rates("abs(t - 1)", 1) == Rates{-1, 0});
  CHECK(rates("sign(t - 1)*t", 1) == Rates{-1, 0});
  CHECK(rates("rint(t + 0.5)*t", 1) == Rates{1, 0});
  CHECK(rates("rint(0.5 - t)*t", 1) == Rates{0, 0});
  CHECK(rates("t < 1 ? 0 : (t - 1)^2", 1) == Rates{0, 0});
  CHECK(rates("(t - 1)^2 > 0 ? t : 2*t", 1) == Rates{1, 0});  // it was, before
  CHECK(rates("abs(x)*t", 1) == Rates{0, 0});
  // None: that is told, and not made up.
  CHECK_FALSE(std::isfinite(rates("sqrt(t)", 0)[0]));
  CHECK(rates("t^1.5", 0)[0] == 0);
  CHECK_FALSE(std::isfinite(rates("t^1.5", 0)[1]));
  CHECK(rates("sqrt(x)*t", 1) == Rates{0, 0});
}

TEST_CASE("the rates of every function that a formula can use are known") {
  mu::Parser parser;
  std::array<double, 4> variables{0.3, 0.4, 0.5, 0.6};
  parser.DefineVar("t", &variables[3]);
  for (const auto& [name, function] : parser.GetFunDef()) {
    CAPTURE(name);
    parser.SetExpr(name + (function.GetArgc() == 2 ? "(t, 1)" : "(t)"));
    const double value = parser.Eval();
    const auto jet = seam::evaluate_jet(parser, {{{0.3}, {0.4}, {0.5}, {0.6, 1, 0}}}, variables.data());
    REQUIRE(jet);
    if (name != "acosh") CHECK(jet->value == Approx(value).epsilon(1e-14));
  }
  parser.DefineFun(
      "own", +[](double a) { return a; });
  parser.SetExpr("own(t)");
  parser.Eval();
  CHECK_FALSE(seam::evaluate_jet(parser, {}, variables.data()));
}

TEST_CASE("what is wrong with an expression is said") {
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(Expression("2*hh", parameters),
                    Contains("unknown name 'hh' at character 3") && Contains("mean 'h'"));
  CHECK_THROWS_WITH(Expression("${mu", parameters), Contains("no closing '}'"));
  CHECK_THROWS_WITH(Expression("t = 3", {}), Contains("write '=='"));
  CHECK_THROWS_WITH(Expression("1/0", {}), Contains("finite"));
  CHECK_THROWS_WITH(Expression("nan", {}), Contains("unknown name"));
  CHECK_THROWS_WITH(Expression("1, 2", {}), Contains("several results"));
  CHECK_THROWS_WITH(seam::evaluate_constant("2*t", {}), Contains("expected a constant"));
  CHECK_THROWS_AS(Expression("", {}), Error);
  CHECK_THROWS_AS(Expression(std::string(5000, '('), {}), Error);
  CHECK_THROWS_AS(Expression(std::string(3999, '('), {}), Error);
}

TEST_CASE("no text crashes the parser") {
  const std::string letters = "xyzt0123456789.eE+-*/^()?:<>=!&|,${} hsinmax";
  std::mt19937 random(42);
  for (int i = 0; i < 20000; ++i) {
    std::string text(random() % 24, ' ');
    for (char& c : text) c = letters[random() % letters.size()];
    try {
      const Expression e(text, parameters);
      const std::array<double, 2> x{0.5, 0.25};
      e(x.data(), 2, 1.0);
    } catch (const Error&) {
    }
  }
}
