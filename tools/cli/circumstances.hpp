// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace seam::cli {

/// Machine, commit, date and versions, for tables that are kept.
/// @param file whose folder's commit is told
/// @param fingerprint of the Seam that ran
std::vector<std::pair<std::string, std::string>> circumstances(const std::filesystem::path& file,
                                                               const std::string& fingerprint);

}  // namespace seam::cli
