// SPDX-License-Identifier: BSD-3-Clause
#include "seam/conformance/check.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace seam {

ConformanceCheck conformance_check(std::string name, bool passed, std::string figures) {
  return {std::move(name), passed ? ConformanceCheck::Outcome::passed : ConformanceCheck::Outcome::failed,
          std::move(figures)};
}

std::string conformance_table(const std::vector<ConformanceCheck>& checks) {
  constexpr std::size_t widest = 60;
  std::size_t width = 0;
  for (const ConformanceCheck& check : checks) width = std::max(width, std::min(widest, check.name.size()));
  std::string table;
  for (const ConformanceCheck& check : checks) {
    const char* word = check.outcome == ConformanceCheck::Outcome::passed   ? "ok"
                       : check.outcome == ConformanceCheck::Outcome::failed ? "FAIL"
                                                                            : "skip";
    std::string figures = check.figures;
    // Messages of several lines keep to their column.
    for (std::size_t at = 0; (at = figures.find('\n', at)) != std::string::npos; at += width + 11)
      figures.replace(at, 1, "\n" + std::string(width + 10, ' '));
    table += fmt::format("  {:<4}  {:<{}}  {}\n", word, check.name, width, figures);
  }
  return table;
}

bool any_failed(const std::vector<ConformanceCheck>& checks) {
  return std::any_of(checks.begin(), checks.end(), [](const ConformanceCheck& check) {
    return check.outcome == ConformanceCheck::Outcome::failed;
  });
}

}  // namespace seam
