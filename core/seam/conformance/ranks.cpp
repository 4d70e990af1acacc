// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "seam/conformance/finite_difference.hpp"
#include "seam/conformance/scene_checks.hpp"

namespace seam {
namespace {

using Series = std::map<std::string, std::vector<double>>;

Series read_series(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line, cell;
  if (!std::getline(in, line)) throw Error(fmt::format("the run left no series in '{}'", file.string()));
  std::vector<std::string> names;
  for (std::istringstream header(line); std::getline(header, cell, ',');) names.push_back(cell);
  Series series;
  while (std::getline(in, line)) {
    std::istringstream row(line);
    for (std::size_t k = 0; k < names.size() && std::getline(row, cell, ','); ++k)
      series[names[k]].push_back(std::strtod(cell.c_str(), nullptr));
  }
  return series;
}

double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double v : values) result = worse(result, std::abs(v));
  return result;
}

/// "tip" of "tip.x": the components of a vector share a scale.
std::string group_of(const std::string& name) { return name.substr(0, name.rfind('.')); }

/// Largest difference, relative to the size of the series; components that are zero but for rounding are
/// measured by the others of their vector.
std::pair<double, std::string> difference(const Series& expected, const Series& found) {
  std::map<std::string, double> group;
  for (const auto& [name, values] : expected)
    group[group_of(name)] = std::max(group[group_of(name)], largest(values));
  std::pair<double, std::string> worst{0, ""};
  for (const auto& [name, values] : expected) {
    const auto other = found.find(name);
    if (other == found.end() || other->second.size() != values.size()) return {INFINITY, name};
    const double scale = std::max(largest(values), 1e-6 * group[group_of(name)]);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double error = std::abs(other->second[k] - values[k]);
      const double relative = error == 0 ? 0.0 : worse(0, error / scale);
      if (relative > worst.first) worst = {relative, name};
    }
  }
  return worst;
}

}  // namespace

ConformanceCheck check_ranks(const std::vector<std::filesystem::path>& files, const std::vector<int>& ranks) {
  constexpr double tolerance = 1e-8;
  const Series expected = read_series(files.at(0));
  double worst = 0;
  std::string where;
  for (std::size_t k = 1; k < files.size(); ++k) {
    const auto [relative, name] = difference(expected, read_series(files[k]));
    if (relative > worst) where = fmt::format("; worst in {} on {} ranks", name, ranks[k]);
    worst = std::max(worst, relative);
  }
  return conformance_check(fmt::format("the same on {} ranks", fmt::join(ranks, ", ")), worst <= tolerance,
                           fmt::format("{:.1e} relative in {} series, at most {:.0e}{}", worst,
                                       expected.size() - 1, tolerance, worst <= tolerance ? "" : where));
}

}  // namespace seam
