// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "matrix_folder.hpp"
#include "plan.hpp"

namespace seam::cli {

/// Which variants are to be run.
struct Selection {
  std::string filter;  ///< part of "SCENE: VARIANT", or a pattern with * and ?; "" for all
  std::optional<std::pair<int, int>> shard;  ///< number of the part, from 1, and of all parts
  std::string tier = "fast";                 ///< of the scenes: `fast`, `nightly` or `all`
  /// What failed last time, with what it must agree with; none: whatever came of it
  std::optional<std::set<VariantName>> failed;
};

/// "2/5". @throws Error for anything else
std::pair<int, int> parse_shard(const std::string& text);

/// "fast", "nightly" or "all". @throws Error for anything else
std::string parse_tier(const std::string& text);

/// A scene, and whether it was named or found in a folder.
struct FoundScene {
  std::filesystem::path file;
  bool is_named;
};

/// The scenes that files and folders hold, each once, sorted within a folder; what is hidden is left out.
/// @throws Error for a folder without any
std::vector<FoundScene> find_scenes(const std::vector<std::string>& files_and_folders);

/// A variant by the numbers of its plan and within that.
using VariantId = std::pair<std::size_t, std::size_t>;

/// What is to be run, in the order of the plans. Shards share out what must agree as one, and together hold
/// all.
std::vector<VariantId> select(const std::vector<MatrixPlan>& plans, const Selection& selection);

}  // namespace seam::cli
