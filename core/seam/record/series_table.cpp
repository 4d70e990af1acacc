// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/series_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "seam/base/diagnostics.hpp"

namespace seam {
namespace {

/// No number is worse than any.
double worse(double a, double b) { return std::isnan(b) ? INFINITY : std::max(a, b); }

double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double v : values) result = worse(result, std::abs(v));
  return result;
}

/// "tip" of "tip.x": the components of a vector share a scale.
std::string group_of(const std::string& name) { return name.substr(0, name.rfind('.')); }

}  // namespace

SeriesTable read_series_table(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line, cell;
  if (!std::getline(in, line)) throw Error(fmt::format("the run left no series in '{}'", file.string()));
  std::vector<std::string> names;
  for (std::istringstream header(line); std::getline(header, cell, ',');) names.push_back(cell);
  SeriesTable series;
  for (const std::string& name : names) series[name];
  while (std::getline(in, line)) {
    std::istringstream row(line);
    for (std::size_t k = 0; k < names.size() && std::getline(row, cell, ','); ++k)
      series[names[k]].push_back(std::strtod(cell.c_str(), nullptr));
  }
  return series;
}

std::map<std::string, double> sizes_of(const SeriesTable& series) {
  std::map<std::string, double> group, result;
  for (const auto& [name, values] : series) {
    double& of_group = group[group_of(name)];
    of_group = std::max(of_group, largest(values));
  }
  for (const auto& entry : series) result[entry.first] = group[group_of(entry.first)];
  return result;
}

SeriesDifference largest_difference(const SeriesTable& expected, const SeriesTable& found,
                                    const std::map<std::string, double>& size) {
  SeriesDifference worst;
  for (const auto& [name, values] : expected) {
    const auto other = found.find(name);
    if (other == found.end() || other->second.size() != values.size()) return {INFINITY, name};
    const double scale = size.at(name);
    for (std::size_t k = 0; k < values.size(); ++k) {
      // Infinite is what both say where there is nothing.
      const bool same = other->second[k] == values[k];
      const double relative = same ? 0.0 : worse(0, std::abs(other->second[k] - values[k]) / scale);
      if (relative > worst.relative) worst = {relative, name};
    }
  }
  return worst;
}

}  // namespace seam
