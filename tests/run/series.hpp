// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace seam_cli_test {

/// The numbers of a series.csv, [step][column].
std::vector<std::vector<double>> table(const std::string& csv);

/// The numbers of a column of a series.csv.
std::vector<double> column(const std::string& csv, const std::string& name);

/// Largest difference between two series, each column relative to its largest value, or to `least` where that
/// is less.
double difference(const std::string& first, const std::string& second, double least = 0);

}  // namespace seam_cli_test
