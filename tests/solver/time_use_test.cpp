// SPDX-License-Identifier: BSD-3-Clause
// At which times the expressions of a scene change their form.
#include "seam/run/time_use.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace seam;

namespace {

TimeUse use_of(const std::string& text, const std::map<std::string, double>& parameters = {}) {
  Scene scene;
  scene.text = text;
  scene.parameters = parameters;
  return find_time_use(scene, 0, 2);
}

}  // namespace

TEST_CASE("kinks are where a condition on the time alone changes, wherever between two samples") {
  CHECK(use_of("a: \"t < 0.3 ? 0 : 1\"").kinks == std::vector<double>{0.3});
  CHECK(use_of("a: \"t < h ? 0 : 1\"", {{"h", 0.7}}).kinks == std::vector<double>{0.7});
  const std::vector<double> sine = use_of("a: [1, \"max(sin(2*t), 0.5)\"]").kinks;
  REQUIRE(sine.size() == 2);
  CHECK(sine[0] == Approx(std::asin(0.5) / 2).epsilon(1e-14));
  CHECK(sine[1] == Approx((std::acos(-1.0) - std::asin(0.5)) / 2).epsilon(1e-14));
  CHECK(use_of("a: \"abs(3*t - 2)\"").kinks.size() == 1);
}

TEST_CASE("what depends on the place has no kinks, nor has what is only recorded or told") {
  CHECK(use_of("a: \"x + t < 0.4 ? 0 : 1\"").kinks.empty());
  CHECK(use_of("a: \"max(t, y)\"").kinks.empty());
  const TimeUse recorded = use_of("output: {derived: {a: \"t < 0.3 ? 0 : 1\"}}");
  CHECK(recorded.any);
  CHECK(recorded.kinks.empty());
  CHECK_FALSE(use_of("title: t < 0.3\nchecks: [{source: t > 0.1}]").any);
  CHECK_FALSE(use_of("a: \"2*theta + x\"").any);
}
