// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace seam::cli {

/// One run of a study.
struct StudyCase {
  std::vector<std::string> values;  ///< of the plan's keys, as written
  std::vector<double> numbers;      ///< the same as numbers; NaN for words
};

/// What a scene's `study` block asks for.
struct StudyPlan {
  std::string title;                  ///< of the scene
  std::vector<std::string> keys;      ///< key paths of the scene
  std::vector<std::string> labels;    ///< the same for readers: parameters by their names
  std::vector<std::string> measures;  ///< numbers of each run
  std::size_t against = 0;            ///< key on the horizontal axis
  bool until_failure = false;         ///< measure failed runs at their last good state
  std::vector<StudyCase> cases;
};

/// Lists the cases and checks each: a scene that one of them breaks is found before the first run.
/// @param set values of `--set`, which hold for all cases
/// @throws Error when the scene has no study, or a key or a case of it is wrong
StudyPlan plan_study(const std::string& scene_file, const std::vector<std::string>& set);

/// The values of `--set` for one case.
std::vector<std::string> overrides_of(const StudyPlan& plan, const StudyCase& one);

}  // namespace seam::cli
