// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/result_names.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "seam/base/diagnostics.hpp"

namespace seam {
namespace {

std::string spelled_in_formulas(std::string name) {
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

class Names {
 public:
  explicit Names(const Scene& scene) : output_(scene.root.object("output")) {
    taken_ = {{"time", "the time"}, {"t", "the time"}};
    if (output_.map("formulas").empty()) return;
    for (const auto& [name, value] : scene.parameters) taken_[name] = "a parameter";
  }
  /// From here on come numbers that formulas do not see: parameters may be called like them.
  void leave_formulas() {
    std::erase_if(taken_, [](const auto& entry) { return entry.second == "a parameter"; });
  }
  /// A number that the run records under this name.
  void take(const std::string& name, const std::string& what, const Location& where) {
    const auto [found, is_new] = taken_.emplace(spelled_in_formulas(name), what);
    if (!is_new)
      wrong_.error(where,
                   fmt::format("{} and {} are both called '{}'{}: rename one", what, found->second, name,
                               name.find('.') == std::string::npos
                                   ? ""
                                   : fmt::format(", '{}' in formulas", spelled_in_formulas(name))));
    names_.push_back(name);
  }
  void require(const std::string& name, const std::vector<std::string>& known, const Location& where) {
    if (std::ranges::find(known, name) != known.end()) return;
    const std::string nearest = nearest_name(name, known);
    wrong_.error(where, fmt::format("no result is called '{}'{}; the run has: {}", name,
                                    nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest),
                                    fmt::join(known, ", ")));
  }
  /// Where the scene names what records a series: a probe, or nothing but a field or an interface.
  [[nodiscard]] Location place_of(const std::string& series) const {
    for (const auto& [name, p] : output_.map("probes"))
      if (series == name || series.starts_with(name + ".")) return p.where();
    return output_.where();
  }
  /// What was taken.
  [[nodiscard]] const std::vector<std::string>& all() const { return names_; }
  void throw_if_wrong() const { wrong_.throw_if_errors(); }

 private:
  const Parameters& output_;
  std::map<std::string, std::string> taken_;  ///< by the name in formulas
  std::vector<std::string> names_;
  Diagnostics wrong_;
};

}  // namespace

void check_result_names(const Scene& scene, const Results& row) {
  const Parameters& output = scene.root.object("output");
  Names names(scene);
  std::vector<std::string> series;
  for (const auto& [name, values] : row.series) {
    // Two that record under one name have left two numbers.
    for (std::size_t k = 0; k < values.size(); ++k)
      names.take(name, fmt::format("the series '{}'", name), names.place_of(name));
    series.push_back(name);
  }
  for (const auto& [name, p] : output.map("formulas")) {
    names.take(name, "a formula", p.where());
    series.push_back(name);
  }
  names.leave_formulas();
  for (const auto& [name, p] : output.map("statistics")) {
    names.take(name, "a statistic", p.where());
    names.require(p.text("of"), series, p.where("of"));
  }
  for (const auto& [name, p] : output.map("errors"))
    for (const std::string norm : {".l2", ".h1"})
      if (norm == ".l2" || p.has("gradient")) names.take(name + norm, "an error", p.where());
  for (const std::string& name : counts_at_the_end) names.take(name, "a count of the run", output.where());
  for (const Parameters& check : scene.root.list("checks"))
    names.require(check.text("that"), names.all(), check.where("that"));
  names.throw_if_wrong();
}

}  // namespace seam
