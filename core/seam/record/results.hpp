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

  /// Adds the numbers of a further time. Where a series has no number, now or so far, it gets nan: all have
  /// as many as there are times. @param row of one time
  void append(const Results& row);
  /// Value of a series at the end, or of a number known at the end.
  /// @throws Error listing the nearest known name
  [[nodiscard]] double value(const std::string& name) const;
  /// Value of a series at a time, linear between steps; of a number known at the end, that. No number at a
  /// time before or after those of the run.
  /// @throws Error listing the nearest known name
  [[nodiscard]] double value(const std::string& name, double at) const;
  [[nodiscard]] std::vector<std::string> names() const;
};

/// @throws Error where the last value of a series is no number; infinite ones are, as the gap is where
/// nothing lies opposite
void check_numbers(const Results& results);

}  // namespace seam
