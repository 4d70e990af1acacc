// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace seam {

/// One line of the conformance kit's report: a property that every plugin must have, and whether this one has
/// it.
struct ConformanceCheck {
  enum class Outcome { passed, failed, skipped };
  std::string name;
  Outcome outcome = Outcome::passed;
  std::string figures;  ///< what was measured, or why it failed or was skipped
};

/// @param figures shown in either case
ConformanceCheck conformance_check(std::string name, bool passed, std::string figures);

/// One line per check: ok, FAIL or skip, the name, the figures.
std::string conformance_table(const std::vector<ConformanceCheck>& checks);

bool any_failed(const std::vector<ConformanceCheck>& checks);

}  // namespace seam
