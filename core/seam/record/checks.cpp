// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "seam/base/diagnostics.hpp"

namespace seam {

double allowed_deviation(const Parameters& check, double reference) {
  const std::string& text = check.text("within");
  std::size_t used = 0;
  double value = 0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  std::string rest = used == 0 ? "?" : text.substr(used);
  std::erase(rest, ' ');
  if ((!rest.empty() && rest != "%") || value < 0)
    throw Error(check.where("within"),
                fmt::format("`within: {}` is no deviation; write it as 0.1% or as a plain number", text));
  return rest == "%" ? value / 100 * std::abs(reference) : value;
}

namespace {

CheckResult evaluate(const Parameters& check, const Results& results) {
  CheckResult result;
  result.that = check.text("that");
  result.kind = check.text("kind");
  result.source = check.text("source");
  try {
    result.value =
        check.has("at") ? results.value(result.that, check.number("at")) : results.value(result.that);
  } catch (const Error& error) {
    throw Error(check.where("that"), error.what());
  }
  result.passed = std::isfinite(result.value);
  std::vector<std::string> expected;
  if (check.has("is")) {
    const double reference = check.number("is");
    if (!check.has("within")) throw Error(check.where("is"), "a check with `is` needs `within`");
    result.is = reference;
    const double allowed = allowed_deviation(check, reference);
    result.deviation = (result.value - reference) / (reference == 0 ? 1 : std::abs(reference));
    result.passed = result.passed && std::abs(result.value - reference) <= allowed;
    expected.push_back(fmt::format("{:.7g} within {}", reference, check.text("within")));
  }
  if (check.has("at_least")) {
    result.passed = result.passed && result.value >= check.number("at_least");
    expected.push_back(fmt::format(">= {:.4g}", check.number("at_least")));
  }
  if (check.has("at_most")) {
    result.passed = result.passed && result.value <= check.number("at_most");
    expected.push_back(fmt::format("<= {:.4g}", check.number("at_most")));
  }
  if (expected.empty())
    throw Error(check.where(), "a check needs `is` with `within`, `at_least` or `at_most`");
  if (check.has("at") && std::isnan(result.value))
    expected.push_back(fmt::format("at t = {:.6g}, which the run (to t = {:.6g}) does not have",
                                   check.number("at"), results.time.back()));
  for (const std::string& e : expected) result.expected += (result.expected.empty() ? "" : ", ") + e;
  return result;
}

}  // namespace

std::vector<CheckResult> evaluate_checks(const std::vector<Parameters>& checks, const Results& results) {
  std::vector<CheckResult> all;
  for (const Parameters& check : checks) all.push_back(evaluate(check, results));
  // Whatever a run tells at its end must be a number, asked for or not.
  for (const std::string& name : results.names()) {
    const bool is_checked =
        std::ranges::any_of(all, [&](const CheckResult& result) { return result.that == name; });
    if (is_checked || !std::isnan(results.value(name))) continue;
    CheckResult& result = all.emplace_back();
    result.that = name;
    result.kind = "exact";
    result.value = std::nan("");
    result.expected = "a number";
    result.source = "too few samples, or a formula without a value";
  }
  return all;
}

std::string check_table(const std::vector<CheckResult>& checks) {
  std::size_t name = 5, expected = 8;
  for (const CheckResult& c : checks) {
    name = std::max(name, c.that.size());
    expected = std::max(expected, c.expected.size());
  }
  std::string table = fmt::format("  {:{}}  {:10}  {:>14}  {:{}}  {:>10}  source\n", "check", name + 6,
                                  "kind", "value", "expected", expected, "deviation");
  for (const CheckResult& c : checks)
    table += fmt::format("  {}  {:{}}  {:10}  {:>14.7g}  {:{}}  {:>+10.2e}  {}\n", c.passed ? "ok  " : "FAIL",
                         c.that, name, c.kind, c.value, c.expected, expected, c.deviation, c.source);
  return table;
}

std::string count_by_kind(const std::vector<CheckResult>& checks) {
  std::string text;
  for (const char* kind : {"exact", "reference", "trend", "regression"}) {
    int all = 0, held = 0;
    for (const CheckResult& check : checks) {
      if (check.kind != kind) continue;
      ++all;
      if (check.passed) ++held;
    }
    if (all > 0) text += fmt::format("{}{} {} of {}", text.empty() ? "" : ", ", kind, held, all);
  }
  return text;
}

}  // namespace seam
