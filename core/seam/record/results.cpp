// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/results.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "seam/base/diagnostics.hpp"

namespace seam {

namespace {

const std::vector<double>& series_of(const Results& results, const std::string& name) {
  const auto found = results.series.find(name);
  if (found != results.series.end()) return found->second;
  const std::string nearest = nearest_name(name, results.names());
  throw Error(fmt::format("no result is called '{}'{}; the run has: {}", name,
                          nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest),
                          fmt::join(results.names(), ", ")));
}

}  // namespace

double Results::value(const std::string& name) const {
  if (const auto found = once.find(name); found != once.end()) return found->second;
  return series_of(*this, name).back();
}

double Results::value(const std::string& name, double at) const {
  if (const auto found = once.find(name); found != once.end()) return found->second;
  const std::vector<double>& values = series_of(*this, name);
  const double slack = 1e-9 * (time.back() - time.front());
  if (time.empty() || at < time.front() - slack || at > time.back() + slack) return std::nan("");
  const auto after =
      static_cast<std::size_t>(std::lower_bound(time.begin(), time.end() - 1, at - slack) - time.begin());
  if (after == 0 || std::abs(time[after] - at) <= slack) return values.at(after);
  const double part = (at - time[after - 1]) / (time[after] - time[after - 1]);
  return values.at(after - 1) + part * (values.at(after) - values.at(after - 1));
}

void check_numbers(const Results& results) {
  for (const auto& [name, values] : results.series)
    if (values.size() == results.time.size() && !values.empty() && std::isnan(values.back()))
      throw Error(
          fmt::format("'{}' is no number at t = {:.6g}: its quantity gives 0/0 or the like somewhere "
                      "in the field",
                      name, results.time.back()));
}

void Results::append(const Results& row) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [name, values] : row.series) series[name].resize(time.size(), none);
  time.insert(time.end(), row.time.begin(), row.time.end());
  for (auto& [name, values] : series) {
    const auto found = row.series.find(name);
    if (found != row.series.end()) values.insert(values.end(), found->second.begin(), found->second.end());
    values.resize(time.size(), none);
  }
}

std::vector<std::string> Results::names() const {
  std::vector<std::string> all;
  for (const auto& entry : series) all.push_back(entry.first);
  for (const auto& entry : once) all.push_back(entry.first);
  return all;
}

}  // namespace seam
