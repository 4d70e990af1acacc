// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

namespace seam {

/// Named numbers over time: probes, balances, energies. Every rank holds the same.
struct Results {
  std::vector<double> time;
  std::map<std::string, std::vector<double>> series;  ///< as long as `time`
  std::map<std::string, double> once;                 ///< error norms, counts: known at the end only

  /// Value of a series at the recorded time nearest to `at`, or of a number known at the end.
  /// @throws Error listing the nearest known name
  [[nodiscard]] double value(const std::string& name, double at) const;
  [[nodiscard]] std::vector<std::string> names() const;
};

}  // namespace seam
