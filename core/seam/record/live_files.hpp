// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "seam/output/results_folder.hpp"
#include "seam/output/safe_file.hpp"
#include "seam/record/results.hpp"
#include "seam/solve/newton.hpp"

namespace seam {

/// series.csv: a row for each state, written when it is known. Rank 0 only.
class SeriesFile {
 public:
  explicit SeriesFile(ResultsFolder& folder) : folder_(&folder) {}
  /// Writes the last row of the results, or all of them when the file was not begun or its columns are
  /// others now. @throws FileError
  void append(const Results& results);

 private:
  ResultsFolder* folder_;
  std::vector<std::string> columns_;
  GrowingFile file_;
};

/// events.jsonl: a JSON object a line, one for each step that was taken, with the attempts that were refused
/// before it, and one for the end of the run. Rank 0 only.
class EventFile {
 public:
  explicit EventFile(ResultsFolder& folder) : folder_(&folder) {}
  /// Begins the file, or goes on with one: its lines after this step are cut off. @throws FileError
  void open(long step_number);
  /// An attempt to step that failed. @param length of the step, s
  void refuse(double length, const NewtonReport& report);
  /// @param time at the end of the step, s
  /// @param seconds since this process began to run the scene
  void take(long step_number, double time, double length, const NewtonReport& report, double seconds);
  /// @param status as in the summary
  void end(long step_number, double time, const std::string& status, const std::string& reason,
           double seconds);

 private:
  struct Refusal {
    double length;
    std::string reason;
    int iterations;
  };
  void put_refusals(nlohmann::ordered_json& event);
  ResultsFolder* folder_;
  GrowingFile file_;
  std::vector<Refusal> refusals_;  ///< since the last step that was taken
};

}  // namespace seam
