// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "seam/record/results.hpp"
#include "seam/scene/parameters.hpp"

namespace seam {

/// Outcome of one of a scene's checks.
struct CheckResult {
  std::string that;
  std::string kind;  ///< "exact", "reference", "trend" or "regression"
  double value = 0;
  std::optional<double> is;  ///< true value, when the check gives one
  std::string expected;      ///< "13.772 within 0.1%"
  double deviation = 0;      ///< from `is`, relative unless `is` is 0
  bool passed = false;
  std::string source;
};

/// How far a check's number may be from its reference: "0.1%" is relative to that, "1e-3" absolute.
/// @throws Error for what is no deviation
double allowed_deviation(const Parameters& check, double reference);

/// Compares the results of a run with the `checks` of its scene. Results that are no number fail, too,
/// whether or not a check asks for them.
/// @throws Error naming the place of a check whose quantity the run does not have
std::vector<CheckResult> evaluate_checks(const std::vector<Parameters>& checks, const Results& results);

/// A table with one line per check.
std::string check_table(const std::vector<CheckResult>& checks);

/// "exact 12 of 12, reference 3 of 4": how many of each kind hold; "" without any.
std::string count_by_kind(const std::vector<CheckResult>& checks);

}  // namespace seam
