// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/live_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

namespace seam {
namespace {

constexpr const char* series_name = "series.csv";
constexpr const char* events_name = "events.jsonl";

void put_row(const Results& results, std::size_t row, std::string& text) {
  // fmt's shortest form reads back to the same bits.
  text += fmt::format("{}", results.time[row]);
  for (const auto& [name, values] : results.series) text += fmt::format(",{}", values[row]);
  text += '\n';
}

std::string whole_table(const std::vector<std::string>& columns, const Results& results) {
  std::string text = fmt::format("time{}{}\n", columns.empty() ? "" : ",", fmt::join(columns, ","));
  for (std::size_t row = 0; row < results.time.size(); ++row) put_row(results, row, text);
  return text;
}

int iterations_of(const NewtonReport& report) {
  return std::max(0, static_cast<int>(report.history.size()) - 1);
}

std::string line_of(const nlohmann::ordered_json& event) {
  // A reason may hold what is no UTF-8, as a file's name.
  return event.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

/// Complete lines up to a step. The last line of a run that was killed may be half of one.
std::string lines_until(const std::string& file, long step_number) {
  std::ifstream in(file, std::ios::binary);
  std::string kept;
  for (std::string line; std::getline(in, line) && !in.eof();) {
    const auto event = nlohmann::json::parse(line, nullptr, false);
    if (!event.is_object() || !event.contains("number") || !event.at("number").is_number()) continue;
    const bool is_step = event.contains("event") && event.at("event") == "step";
    if (is_step && event.at("number") <= step_number) kept += line + "\n";
  }
  return kept;
}

}  // namespace

void SeriesFile::append(const Results& results) {
  std::vector<std::string> columns;
  for (const auto& entry : results.series) columns.push_back(entry.first);
  const std::string path = (folder_->path() / series_name).string();
  if (!file_.is_open() || columns != columns_) {
    folder_->claim(series_name);
    write_whole_file(path, whole_table(columns, results));
    file_ = GrowingFile(path);
    columns_ = columns;
    return;
  }
  std::string row;
  put_row(results, results.time.size() - 1, row);
  file_.append(row);
}

void EventFile::open(long step_number) {
  const std::string path = (folder_->path() / events_name).string();
  folder_->claim(events_name);
  write_whole_file(path, lines_until(path, step_number));
  file_ = GrowingFile(path);
}

void EventFile::refuse(double length, const NewtonReport& report) {
  refusals_.push_back({length, report.reason, iterations_of(report)});
}

void EventFile::put_refusals(nlohmann::ordered_json& event) {
  event["refused"] = nlohmann::json::array();
  for (const auto& [length, reason, iterations] : std::exchange(refusals_, {}))
    event["refused"].push_back({{"length", length}, {"iterations", iterations}, {"reason", reason}});
}

void EventFile::take(long step_number, double time, double length, const NewtonReport& report,
                     double seconds) {
  nlohmann::ordered_json event{{"event", "step"},
                               {"number", step_number},
                               {"time", time},
                               {"length", length},
                               {"iterations", iterations_of(report)},
                               {"residuals", nlohmann::json::array()},
                               {"seconds", seconds}};
  for (const NewtonIteration& iteration : report.history) event["residuals"].push_back(iteration.residual);
  put_refusals(event);
  file_.append(line_of(event));
}

void EventFile::end(long step_number, double time, const std::string& status, const std::string& reason,
                    double seconds) {
  if (!file_.is_open()) return;
  nlohmann::ordered_json event{
      {"event", "end"}, {"number", step_number}, {"time", time}, {"status", status}, {"seconds", seconds}};
  if (!reason.empty()) event["reason"] = reason;
  put_refusals(event);
  file_.append(line_of(event));
}

}  // namespace seam
