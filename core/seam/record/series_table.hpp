// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace seam {

/// What a run's series.csv holds: a row at each recorded time, by the name of its column.
using SeriesTable = std::map<std::string, std::vector<double>>;

/// @throws Error when there is no such file
SeriesTable read_series_table(const std::filesystem::path& file);

/// What differences of a series are measured by: its largest value; of a component that of its whole vector
/// or tensor.
std::map<std::string, double> sizes_of(const SeriesTable& series);

/// Where two runs differ most.
struct SeriesDifference {
  double relative = 0;  ///< to the size; infinite where a series is missing or has another number of rows
  std::string name;     ///< of the series; empty where nothing differs
};

/// @param size of each series of `expected`
SeriesDifference largest_difference(const SeriesTable& expected, const SeriesTable& found,
                                    const std::map<std::string, double>& size);

}  // namespace seam
