// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/run_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "seam/record/derived.hpp"

namespace seam {
namespace {

constexpr const char* record_it_anew = "record the run anew with tools/record_run.py";

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words(1);
  for (const char c : line) {
    if (c == ',')
      words.emplace_back();
    else if (c != '\r')
      words.back() += c;
  }
  return words;
}

double number(const std::string& word, const Location& where) {
  double value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc{} || end != word.data() + word.size())
    throw Error(where, fmt::format("found '{}', expected a number; {}", word, record_it_anew));
  return value;
}

void read_series(const std::string& file, Results& results) {
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line) || !line.starts_with("time"))
    throw Error(Location{file, 1, 0},
                fmt::format("found no table, expected one whose first column is `time`; {}", record_it_anew));
  const std::vector<std::string> names = split(line);
  for (int row = 2; std::getline(in, line); ++row) {
    const Location where{file, row, 0};
    const std::vector<std::string> words = split(line);
    if (words.size() != names.size())
      throw Error(where, fmt::format("found {} numbers, expected {}, one for each name in the first line; {}",
                                     words.size(), names.size(), record_it_anew));
    results.time.push_back(number(words.front(), where));
    for (std::size_t k = 1; k < words.size(); ++k)
      results.series[names[k]].push_back(number(words[k], where));
  }
  if (results.time.empty())
    throw Error(Location{file, 2, 0},
                fmt::format("found no row of numbers, expected one for each step; {}", record_it_anew));
}

/// Formulas are computed from what else there is, step by step as the run does.
Results with_formulas(const Scene& scene, const Results& recorded) {
  const auto& formulas = scene.root.object("output").map("formulas");
  const auto is_formula = [&](const std::string& name) {
    return std::ranges::any_of(formulas, [&](const auto& entry) { return entry.first == name; });
  };
  Results results;
  for (std::size_t k = 0; k < recorded.time.size(); ++k) {
    Results row;
    row.time.push_back(recorded.time[k]);
    for (const auto& [name, values] : recorded.series)
      if (!is_formula(name)) row.series[name].push_back(values[k]);
    record_formulas(scene, row);
    results.append(row);
  }
  results.once = recorded.once;
  return results;
}

}  // namespace

RunRecord read_record(const std::filesystem::path& folder) {
  const std::string file = (folder / "record.json").string();
  std::ifstream in(file);
  if (!in) throw Error(Location{file, 0, 0}, fmt::format("there is no such record; {}", record_it_anew));
  RunRecord record;
  record.folder = folder;
  try {
    const nlohmann::json data = nlohmann::json::parse(in);
    for (const std::string replaced : data.at("overrides")) {
      const std::size_t equals = replaced.find('=');
      if (equals == std::string::npos)
        throw Error(Location{file, 0, 0}, fmt::format("overrides: found '{}', expected key.key=value; {}",
                                                      replaced, record_it_anew));
      record.overrides.emplace_back(replaced.substr(0, equals), replaced.substr(equals + 1));
    }
    record.status = data.at("status");
    record.time = data.at("time");
    record.checksum = data.at("resolved_checksum");
    record.resolved = data.at("resolved").get<ResolvedScene>();
    // What JSON has no word for is null: no number.
    for (const auto& [name, value] : data.at("numbers").items())
      record.results.once[name] = value.is_null() ? std::nan("") : value.get<double>();
  } catch (const nlohmann::json::exception& error) {
    throw Error(Location{file, 0, 0},
                fmt::format("this is no record of a run: {}; {}", error.what(), record_it_anew));
  }
  read_series((folder / "series.csv").string(), record.results);
  return record;
}

std::vector<CheckResult> judge(const Scene& scene, const RunRecord& record) {
  Results results = with_formulas(scene, record.results);
  finish_statistics(scene, results);
  return evaluate_checks(scene.root.list("checks"), results);
}

}  // namespace seam
