// SPDX-License-Identifier: BSD-3-Clause
#include "agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "seam/base/diagnostics.hpp"
#include "seam/record/series_table.hpp"

namespace seam::cli {
namespace {

bool came_to_its_end(const VariantResult* result) {
  return result && std::ranges::none_of(result->findings, &Finding::is_broken);
}

/// The series that an agreement is about. @throws Error when the run has none of that name
SeriesTable chosen(const SeriesTable& all, const std::vector<std::string>& names) {
  if (names.empty()) return all;
  SeriesTable result;
  for (const std::string& name : names) {
    const std::size_t before = result.size();
    for (const auto& [column, values] : all)
      if (is_series(column, name)) result[column] = values;
    if (result.size() == before) throw Error(fmt::format("the run has no series '{}'", name));
  }
  return result;
}

std::string tell(const SeriesDifference& difference, const SeriesTable& expected, const SeriesTable& found,
                 const std::string& other, double within) {
  if (difference.name.empty()) return fmt::format("the same to the bit as '{}'", other);
  const auto rows = found.find(difference.name);
  if (rows == found.end())
    return fmt::format("there is no series '{}', which '{}' has", difference.name, other);
  const std::size_t wanted = expected.at(difference.name).size();
  if (rows->second.size() != wanted)
    return fmt::format("{} has {} rows, {} with '{}'", difference.name, rows->second.size(), wanted, other);
  return fmt::format("{} {:.1e} of its size, at most {:.0e}, from '{}'", difference.name, difference.relative,
                     within, other);
}

class Group {
 public:
  Group(const Agreement& agreement, const std::filesystem::path& reference, std::string name)
      : agreement_(agreement), name_(std::move(name)) {
    const SeriesTable all = read(reference);
    // By all components of a vector, whichever of them are compared.
    size_ = sizes_of(all);
    expected_ = chosen(all, agreement.series);
  }

  [[nodiscard]] Finding compare(const std::filesystem::path& folder) const {
    const SeriesTable found = read(folder);
    const SeriesDifference difference = largest_difference(expected_, found, size_);
    return {describe(agreement_), difference.relative <= agreement_.within, false,
            tell(difference, expected_, found, name_, agreement_.within)};
  }

 private:
  static SeriesTable read(const std::filesystem::path& folder) {
    return read_series_table(folder / "series.csv");
  }

  const Agreement& agreement_;
  std::string name_;
  SeriesTable expected_;
  std::map<std::string, double> size_;
};

}  // namespace

void compare(const MatrixPlan& plan, const std::vector<VariantResult*>& results,
             const std::function<std::filesystem::path(std::size_t variant)>& folder_of) {
  for (const Agreement& agreement : plan.agreements)
    for (const std::vector<std::size_t>& members : agreement.groups) {
      std::optional<Group> group;
      // What is to pass is what others are compared with, where there is such a one.
      std::vector<std::size_t> order = members;
      std::stable_partition(order.begin(), order.end(),
                            [&](std::size_t i) { return plan.variants[i].known.empty(); });
      for (const std::size_t i : order) {
        if (!came_to_its_end(results[i])) continue;
        try {
          if (group)
            results[i]->findings.push_back(group->compare(folder_of(i)));
          else
            group.emplace(agreement, folder_of(i), plan.variants[i].name);
        } catch (const Error& error) {
          results[i]->findings.push_back({describe(agreement), false, false, error.what()});
        }
      }
    }
}

}  // namespace seam::cli
