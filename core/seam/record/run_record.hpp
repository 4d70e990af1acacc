// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "seam/record/checks.hpp"
#include "seam/record/results.hpp"
#include "seam/scene/resolved.hpp"

namespace seam {

/// A run that was kept: record.json, and series.csv with what it recorded in every step, formulas left out.
struct RunRecord {
  std::filesystem::path folder;
  Overrides overrides;
  std::string status;      ///< as in summary.json
  double time = 0;         ///< of its last state
  ResolvedScene resolved;  ///< what decided the numbers, and what was measured
  std::string checksum;    ///< of the scene that ran, as in summary.json
  Results results;         ///< series, and what is no series: counts and error norms
};

/// @throws Error naming the file and what is wrong with it
RunRecord read_record(const std::filesystem::path& folder);

/// Computes formulas and statistics anew, as the scene has them now, and compares with its checks.
/// @throws Error with the place in the scene, as where it needs a series that was not recorded
std::vector<CheckResult> judge(const Scene& scene, const RunRecord& record);

}  // namespace seam
