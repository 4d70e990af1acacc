// SPDX-License-Identifier: BSD-3-Clause
// Which results pass a check.
#include "seam/record/checks.hpp"

#include <catch2/catch.hpp>

using namespace seam;

namespace {

bool passes(double value, const std::map<std::string, double>& bounds, const std::string& within = "") {
  Parameters check;
  for (const auto& [key, text] :
       {std::pair("that", "x"), std::pair("kind", "exact"), std::pair("source", "nothing")})
    check.set(key, {std::string(text), {}, {}, true});
  if (!within.empty()) check.set("within", {within, {}, {}, true});
  for (const auto& [key, number] : bounds) check.set(key, {number, {}, {}, true});
  Results results;
  results.once["x"] = value;
  return evaluate_checks({check}, results).at(0).passed;
}

}  // namespace

TEST_CASE("a result may deviate either way by what a check allows, and by no more") {
  CHECK(passes(2, {{"is", 2}}, "0"));
  for (const double sign : {1.0, -1.0}) {
    CHECK(passes(2 + sign * 0.099, {{"is", 2}}, "5%"));
    CHECK_FALSE(passes(2 + sign * 0.101, {{"is", 2}}, "5%"));
    CHECK(passes(-2 + sign * 0.099, {{"is", -2}}, "5 %"));
    CHECK_FALSE(passes(-2 + sign * 0.101, {{"is", -2}}, "5%"));
    CHECK(passes(sign * 0.009, {{"is", 0}}, "0.01"));
    CHECK_FALSE(passes(sign * 0.011, {{"is", 0}}, "0.01"));
  }
  CHECK(passes(2, {{"at_least", 2}, {"at_most", 2}}));
  CHECK_FALSE(passes(1.99, {{"at_least", 2}}));
  CHECK_FALSE(passes(2.01, {{"at_most", 2}}));
  CHECK_FALSE(passes(std::nan(""), {{"at_most", 2}}));
}
