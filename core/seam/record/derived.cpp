// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/derived.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace seam {
namespace {

/// A part of a series with its times.
struct Window {
  std::span<const double> time, value;

  /// Over time, by the trapezoidal rule.
  [[nodiscard]] double integral() const {
    double sum = 0;
    for (std::size_t k = 1; k < time.size(); ++k)
      sum += (time[k] - time[k - 1]) * (value[k] + value[k - 1]) / 2;
    return sum;
  }
  [[nodiscard]] double mean() const { return integral() / (time.back() - time.front()); }
  /// Of the upward crossings of the mean, interpolated between the steps; no number when there are fewer than
  /// two.
  [[nodiscard]] double frequency() const {
    const double level = mean();
    double first = 0, last = 0;
    int crossings = 0;
    for (std::size_t k = 1; k < time.size(); ++k) {
      if (value[k - 1] >= level || value[k] < level) continue;
      const double part = (level - value[k - 1]) / (value[k] - value[k - 1]);
      last = time[k - 1] + part * (time[k] - time[k - 1]);
      if (crossings++ == 0) first = last;
    }
    return crossings > 1 ? (crossings - 1) / (last - first) : std::nan("");
  }
  /// Largest increase from one step to the next; 0 when it never increases.
  [[nodiscard]] double rise() const {
    double most = 0;
    for (std::size_t k = 1; k < value.size(); ++k) most = std::max(most, value[k] - value[k - 1]);
    return most;
  }
  /// The first step at which the value is above 0; infinite when it never is.
  [[nodiscard]] double onset() const {
    const auto first = std::find_if(value.begin(), value.end(), [](double v) { return v > 0; });
    return first == value.end() ? std::numeric_limits<double>::infinity() : time[first - value.begin()];
  }
  /// The step after the last one at which the value is above 0; infinite when it never is or still is at the
  /// end.
  [[nodiscard]] double release() const {
    const auto last = std::find_if(value.rbegin(), value.rend(), [](double v) { return v > 0; });
    const auto after = static_cast<std::size_t>(last.base() - value.begin());
    return last == value.rend() || after == value.size() ? std::numeric_limits<double>::infinity()
                                                         : time[after];
  }
  /// Largest deviation of a value from the cubic through its four neighbours, over the largest magnitude. For
  /// a smooth series at equal steps it falls with the fourth power of the step; jumps keep it up.
  [[nodiscard]] double roughness() const {
    double deviation = 0, largest = 0;
    for (std::size_t k = 2; k + 2 < value.size(); ++k) {
      const double cubic = (4 * (value[k - 1] + value[k + 1]) - value[k - 2] - value[k + 2]) / 6;
      deviation = std::max(deviation, std::abs(value[k] - cubic));
    }
    for (const double v : value) largest = std::max(largest, std::abs(v));
    return largest > 0 ? deviation / largest : 0;
  }
  /// Magnitude of the second derivative in time at each inner step, by divided differences.
  [[nodiscard]] std::vector<double> curvatures() const {
    std::vector<double> result;
    for (std::size_t k = 1; k + 1 < value.size(); ++k) {
      const double before = (value[k] - value[k - 1]) / (time[k] - time[k - 1]);
      const double after = (value[k + 1] - value[k]) / (time[k + 1] - time[k]);
      result.push_back(std::abs(after - before) / (0.5 * (time[k + 1] - time[k - 1])));
    }
    return result;
  }
};

/// @param what one of those that speak of the second derivative
double curvature_statistic(const std::string& what, const Window& window) {
  std::vector<double> all = window.curvatures();
  const auto largest = std::max_element(all.begin(), all.end());
  if (what == "kink_time") return window.time[static_cast<std::size_t>(largest - all.begin()) + 1];
  const double most = *largest;
  if (what == "curvature") return most;
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  const double median = all[all.size() / 2];
  return median > 0 ? most / median : 0;
}

double statistic(const Parameters& p, const Results& results) {
  const auto series = results.series.find(p.text("of"));
  if (series == results.series.end())
    throw Error(p.where("of"), fmt::format("no series '{}' was recorded", p.text("of")));
  const double from = p.has("from") ? p.number("from") : results.time.front();
  const double to = p.has("to") ? p.number("to") : results.time.back();
  const auto begin = std::lower_bound(results.time.begin(), results.time.end(), from);
  const auto count = static_cast<std::size_t>(
      std::max<std::ptrdiff_t>(0, std::upper_bound(begin, results.time.end(), to) - begin));
  const std::size_t first = begin - results.time.begin();
  const std::string& what = p.text("what");
  const bool bends = what == "curvature" || what.starts_with("kink");
  // Of too few samples a statistic says nothing: it is no number, and fails.
  const std::size_t least = what == "roughness" ? 5 : bends ? 3 : 2;
  if (count < least) return std::nan("");
  const Window window{std::span(results.time).subspan(first, count),
                      std::span(series->second).subspan(first, count)};
  if (std::ranges::any_of(window.value, [](double v) { return std::isnan(v); })) return std::nan("");
  if (what == "maximum") return *std::max_element(window.value.begin(), window.value.end());
  if (what == "minimum") return *std::min_element(window.value.begin(), window.value.end());
  if (what == "integral") return window.integral();
  if (what == "rise") return window.rise();
  if (what == "onset") return window.onset();
  if (what == "release") return window.release();
  if (what == "roughness") return window.roughness();
  if (bends) return curvature_statistic(what, window);
  return what == "mean" ? window.mean() : window.frequency();
}

}  // namespace

void record_formulas(const Scene& scene, Results& results) {
  for (const auto& [name, p] : scene.root.object("output").map("formulas")) {
    std::map<std::string, double> known = scene.parameters;
    known["t"] = results.time.back();
    for (const auto& [series, values] : results.series) {
      std::string spelled = series;
      std::replace(spelled.begin(), spelled.end(), '.', '_');
      if (!values.empty()) known[spelled] = values.back();
    }
    try {
      results.series[name].push_back(evaluate_formula(p.text("value"), known));
    } catch (const Error& error) {
      throw Error(p.where(), error.what());
    }
  }
}

void finish_statistics(const Scene& scene, Results& results) {
  for (const auto& [name, p] : scene.root.object("output").map("statistics"))
    results.once[name] = statistic(p, results);
}

}  // namespace seam
