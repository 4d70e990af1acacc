// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "seam/conformance/check.hpp"
#include "seam/scene/scene.hpp"

namespace seam::cli {

/// Runs a scene through mpirun on several numbers of ranks. In a process without MPI: an mpirun started from
/// within an MPI process refuses to work.
/// @param folder for the results; created
/// @return why the series cannot be compared, if they cannot
std::optional<ConformanceCheck> run_on_ranks(const std::filesystem::path& scene, const Overrides& overrides,
                                             const std::vector<int>& ranks,
                                             const std::filesystem::path& folder);

/// Where the run on so many ranks leaves its series.
std::filesystem::path series_on_ranks(const std::filesystem::path& folder, int ranks);

/// What a run said first, from its log; mpirun's own remarks come after.
std::string first_lines(const std::filesystem::path& log);

}  // namespace seam::cli
