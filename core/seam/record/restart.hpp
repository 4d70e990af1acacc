// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "seam/record/refusals.hpp"
#include "seam/record/results.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

/// Where a run stands between two steps.
struct RunState {
  double time = 0;
  double step = 0;    ///< next step to try, s
  Refusals refusals;  ///< when the last step was taken
  long step_number = 0;
  Results results;              ///< recorded so far
  std::vector<int> iterations;  ///< of Newton's method in each step that was taken
  long rejected_steps = 0;      ///< steps that failed and were taken again, shorter
};

/// Writes the states of all fields and `state` as one file, by global node numbers, so that any number of
/// ranks can read it. The file gets its name only when it is complete and on disk: a run that is killed while
/// writing loses nothing but this point. Collective.
/// @param run which run it belongs to, see ResultsFolder::run()
/// @throws FileError on all ranks
void write_restart(const std::filesystem::path& file, const Problem& problem, const RunState& state,
                   const std::string& run);

/// Reads a restart point into the problem. Collective.
/// @throws Error when the file is damaged or belongs to other fields
RunState read_restart(const std::filesystem::path& file, Problem& problem);

/// The first of some restart points that is undamaged and of the given run, "" if there is none among them.
/// @param points the newest first
/// @param warnings gets a line for every one that was passed over
std::filesystem::path latest_restart(const std::vector<std::filesystem::path>& points, const std::string& run,
                                     std::vector<std::string>& warnings);

}  // namespace seam
