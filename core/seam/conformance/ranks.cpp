// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "seam/conformance/finite_difference.hpp"
#include "seam/conformance/scene_checks.hpp"
#include "seam/record/checks.hpp"
#include "seam/record/series_table.hpp"
#include "seam/scene/expression.hpp"

namespace seam {
namespace {

constexpr double tolerance = 1e-8;

/// The size of what a formula is made of: how much it changes with each of the series that it names, times
/// their size, where that is largest.
double size_of_formula(const std::string& formula, const SeriesTable& series,
                       const std::map<std::string, double>& parameters) {
  constexpr double part = 1e-3;
  const auto value = [&](std::size_t k, const std::string& changed) {
    std::map<std::string, double> known = parameters;
    for (const auto& [name, values] : series) {
      std::string spelled = name;
      std::replace(spelled.begin(), spelled.end(), '.', '_');
      known[spelled] = values[k] * (name == changed ? 1 + part : 1);
    }
    known["t"] = series.at("time")[k];
    return evaluate_formula(formula, known);
  };
  double most = 0;
  for (std::size_t k = 0; k < series.at("time").size(); ++k) {
    const double here = value(k, "");
    double size = 0;
    for (const auto& entry : series) size += std::abs(value(k, entry.first) - here) / part;
    if (std::isfinite(size)) most = std::max(most, size);
  }
  return most;
}

/// What differences of a series are measured by.
std::map<std::string, double> sizes(const Scene& scene, const SeriesTable& series) {
  std::map<std::string, double> result = sizes_of(series);
  for (const auto& [name, p] : scene.root.object("output").map("formulas"))
    if (result.contains(name))
      result[name] = std::max(result[name], size_of_formula(p.text("value"), series, scene.parameters));
  for (const Parameters& check : scene.root.list("checks")) {
    const auto found = result.find(check.text("that"));
    if (found == result.end() || !check.has("within") || check.number("is") != 0) continue;
    found->second = std::max(found->second, allowed_deviation(check, 0) / tolerance);
  }
  return result;
}

}  // namespace

ConformanceCheck check_ranks(const Scene& scene, const std::vector<std::filesystem::path>& files,
                             const std::vector<int>& ranks) {
  const SeriesTable expected = read_series_table(files.at(0));
  const std::map<std::string, double> size = sizes(scene, expected);
  double worst = 0;
  std::string where;
  for (std::size_t k = 1; k < files.size(); ++k) {
    const auto [relative, name] = largest_difference(expected, read_series_table(files[k]), size);
    if (relative > worst) where = fmt::format("; worst in {} on {} ranks", name, ranks[k]);
    worst = std::max(worst, relative);
  }
  return conformance_check(fmt::format("the same on {} ranks", fmt::join(ranks, ", ")), worst <= tolerance,
                           fmt::format("{:.1e} relative in {} series, at most {:.0e}{}", worst,
                                       expected.size() - 1, tolerance, worst <= tolerance ? "" : where));
}

}  // namespace seam
