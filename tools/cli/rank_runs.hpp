// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "seam/conformance/check.hpp"
#include "seam/scene/scene.hpp"

namespace seam::cli {

/// Runs a scene through mpirun on several numbers of ranks and compares the series. Call it before MPI starts
/// in this process: an mpirun started from within an MPI process refuses to work.
/// @param folder for the results; created
ConformanceCheck run_on_ranks(const std::filesystem::path& scene, const Overrides& overrides,
                              const std::vector<int>& ranks, const std::filesystem::path& folder);

}  // namespace seam::cli
