// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "study_plan.hpp"

namespace seam::cli {

/// What a case of a study gave.
struct StudyRecord {
  StudyCase of;
  std::string problem;                    ///< why there are no numbers, "" when there are
  std::map<std::string, double> numbers;  ///< by column
  int code = 0;                           ///< that the run ended with
  bool has_begun = false;                 ///< whether it left a summary of its own
  bool is_interrupted = false;            ///< by a signal
};

/// A study that was run.
struct StudyReport {
  std::string title;
  std::vector<std::pair<std::string, std::string>> circumstances;  ///< machine, commit, date, command, ...
  StudyPlan plan;
  std::vector<StudyRecord> records;

  /// The measures, then what every study reports of cost: unknowns, seconds, bytes.
  [[nodiscard]] std::vector<std::string> columns() const;
};

/// A number of a run by the name a study gives it.
/// @param summary content of the run's summary.json
/// @throws Error listing the nearest known name
double measure(const nlohmann::json& summary, const std::string& name);

/// True for numbers that go to zero: then an order of convergence can be observed.
bool is_error(const std::string& measure);

/// Observed order of a measure between a record and the one before it on the horizontal axis; NaN without
/// one.
double observed_order(const StudyReport& report, std::size_t record, const std::string& measure);

/// Comma-separated, one line a case, the circumstances before it as comments.
std::string csv(const StudyReport& report);

/// A page with the circumstances, the table and the picture.
/// @param picture file name, "" for none
std::string markdown(const StudyReport& report, const std::string& picture);

}  // namespace seam::cli
