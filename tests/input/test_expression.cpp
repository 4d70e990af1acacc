// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "seam/base/diagnostics.hpp"
#include "seam/scene/expression.hpp"

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
