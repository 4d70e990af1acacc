// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/results.hpp"

#include <fmt/ranges.h>

#include <cmath>

#include "seam/base/diagnostics.hpp"

namespace seam {

double Results::value(const std::string& name, double at) const {
  if (const auto found = once.find(name); found != once.end()) return found->second;
  const auto found = series.find(name);
  if (found == series.end())
    throw Error(fmt::format("no result is called '{}'; did you mean '{}'? The run has: {}", name,
                            nearest_name(name, names()), fmt::join(names(), ", ")));
  std::size_t nearest = 0;
  for (std::size_t k = 0; k < time.size(); ++k)
    if (std::abs(time[k] - at) <= std::abs(time[nearest] - at)) nearest = k;
  return found->second.at(nearest);
}

std::vector<std::string> Results::names() const {
  std::vector<std::string> all;
  for (const auto& entry : series) all.push_back(entry.first);
  for (const auto& entry : once) all.push_back(entry.first);
  return all;
}

}  // namespace seam
