// SPDX-License-Identifier: BSD-3-Clause
#include "study_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "seam/base/diagnostics.hpp"
#include "seam/scene/expression.hpp"

namespace seam::cli {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double as_number(const nlohmann::json& value) { return value.is_number() ? value.get<double>() : none; }

/// |value - reference| / |reference|; the difference itself where the reference is 0.
double relative_error(double value, double reference) {
  return std::abs(value - reference) / (reference == 0 ? 1 : std::abs(reference));
}

/// error(NAME): against what the check of that name expects.
double error_of_check(const nlohmann::json& summary, const std::string& name) {
  std::vector<std::string> known;
  for (const auto& check : summary.at("checks")) {
    if (!check.contains("is")) continue;
    known.push_back(check.at("that"));
    if (known.back() == name) return relative_error(as_number(check.at("value")), as_number(check.at("is")));
  }
  throw Error(fmt::format(
      "study.measure: error({0}) needs a check of '{0}' with `is`; error({0}, VALUE) gives the reference "
      "itself. The scene has such checks of: {1}",
      name, known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
}

/// error(NAME) or error(NAME, REFERENCE).
double error_measure(const nlohmann::json& summary, const std::string& inside) {
  const std::size_t comma = inside.rfind(',');
  if (comma == std::string::npos) return error_of_check(summary, inside);
  return relative_error(measure(summary, inside.substr(0, comma)),
                        evaluate_constant(inside.substr(comma + 1), {}));
}

std::vector<std::string> keys(const nlohmann::json& object) {
  std::vector<std::string> result;
  for (const auto& entry : object.items()) result.push_back(entry.key());
  return result;
}

/// A text as a field of a CSV file.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : c == '\n' ? " " : std::string(1, c);
  return result + "\"";
}

std::string cell(const std::string& column, double value) {
  if (std::isnan(value)) return "–";
  if (column == "unknowns") return fmt::format("{:.0f}", value);
  if (column == "peak_memory_bytes") return fmt::format("{:.0f}", value / 1e6);
  if (column.starts_with("seconds")) return fmt::format("{:.3f}", value);
  return is_error(column) ? fmt::format("{:.2e}", value) : fmt::format("{:.8g}", value);
}

std::string heading(const std::string& column) {
  if (column == "peak_memory_bytes") return "peak memory, MB";
  return column.starts_with("seconds.") ? "s, " + column.substr(8) : column;
}

double number(const StudyRecord& record, const std::string& column) {
  const auto found = record.numbers.find(column);
  return found == record.numbers.end() ? none : found->second;
}

}  // namespace

std::vector<std::string> StudyReport::columns() const {
  std::vector<std::string> result = plan.measures;
  for (const std::string cost :
       {"unknowns", "seconds.total", "seconds.assembly", "seconds.linear", "peak_memory_bytes"})
    if (std::find(result.begin(), result.end(), cost) == result.end()) result.push_back(cost);
  return result;
}

double measure(const nlohmann::json& summary, const std::string& name) {
  if (name.starts_with("error(") && name.ends_with(")"))
    return error_measure(summary, name.substr(6, name.size() - 7));
  const std::string seconds = "seconds.";
  if (name.starts_with(seconds) && summary.at("seconds").contains(name.substr(seconds.size())))
    return as_number(summary.at("seconds").at(name.substr(seconds.size())));
  for (const std::string own : {"time", "unknowns", "peak_memory_bytes", "steps", "rejected_steps"})
    if (name == own) return as_number(summary.at(own));
  const nlohmann::json& results = summary.at("results");
  if (results.contains(name)) return as_number(results.at(name));
  const std::string guess = nearest_name(name, keys(results));
  throw Error(
      fmt::format("study.measure: the run has no '{}'.{} It has: {}, time, unknowns, steps, rejected_steps, "
                  "peak_memory_bytes, seconds.{}",
                  name, guess.empty() ? "" : fmt::format(" Did you mean '{}'?", guess),
                  fmt::join(keys(results), ", "), fmt::join(keys(summary.at("seconds")), ", seconds.")));
}

bool is_error(const std::string& measure) {
  return measure.starts_with("error(") || measure.ends_with(".l2") || measure.ends_with(".h1");
}

double observed_order(const StudyReport& report, std::size_t record, const std::string& measure) {
  const StudyRecord& here = report.records[record];
  const std::size_t axis = report.plan.against;
  for (std::size_t r = record; r-- > 0;) {
    const StudyRecord& before = report.records[r];
    std::vector<std::string> same = before.of.values;
    same[axis] = here.of.values[axis];
    if (same != here.of.values) continue;
    const double finer = std::abs(std::log(here.of.numbers[axis] / before.of.numbers[axis]));
    const double order = std::log(number(before, measure) / number(here, measure)) / finer;
    return std::isfinite(order) ? order : none;
  }
  return none;
}

std::string csv(const StudyReport& report) {
  std::string text = fmt::format("# {}\n", report.title);
  for (const auto& [what, value] : report.circumstances) text += fmt::format("# {}: {}\n", what, value);
  const std::vector<std::string> columns = report.columns();
  for (const std::string& label : report.plan.labels) text += quoted(label) + ",";
  for (const std::string& column : columns) text += quoted(column) + ",";
  text += "problem\n";
  for (const StudyRecord& record : report.records) {
    for (const std::string& value : record.of.values) text += quoted(value) + ",";
    for (const std::string& column : columns) {
      const double value = number(record, column);
      text += std::isnan(value) ? "," : fmt::format("{:.12g},", value);
    }
    text += quoted(record.problem) + "\n";
  }
  return text;
}

std::string markdown(const StudyReport& report, const std::string& picture) {
  std::string text = fmt::format("# {}\n\n", report.title);
  for (const auto& [what, value] : report.circumstances)
    text += fmt::format("- {}: {}\n", what, what == "command" ? "`" + value + "`" : value);
  std::string head = "\n|", rule = "|", problems;
  const auto add_heading = [&](const std::string& name) {
    head += fmt::format(" {} |", name);
    rule += "---:|";
  };
  const std::vector<std::string> columns = report.columns();
  for (const std::string& label : report.plan.labels) add_heading(label);
  for (const std::string& column : columns) {
    add_heading(heading(column));
    if (is_error(column)) add_heading("observed order");
  }
  text += head + "\n" + rule + "\n";
  for (std::size_t r = 0; r < report.records.size(); ++r) {
    const StudyRecord& record = report.records[r];
    text += "|";
    for (const std::string& value : record.of.values) text += fmt::format(" {} |", value);
    for (const std::string& column : columns) {
      text += fmt::format(" {} |", cell(column, number(record, column)));
      if (!is_error(column)) continue;
      const double order = observed_order(report, r, column);
      text += std::isnan(order) ? " |" : fmt::format(" {:.2f} |", order);
    }
    text += "\n";
    if (!record.problem.empty())
      problems += fmt::format("- {}: {}\n", fmt::join(record.of.values, ", "), record.problem);
  }
  if (!problems.empty())
    text += fmt::format("\n{}:\n\n{}", report.plan.until_failure ? "Failed" : "Without numbers", problems);
  if (!picture.empty()) text += fmt::format("\n![{}]({})\n", report.title, picture);
  return text;
}

}  // namespace seam::cli
