// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace seam_test {

std::string read_text(const std::filesystem::path& file);

/// Replaces every occurrence.
std::string replaced(std::string text, const std::string& from, const std::string& to);

/// Compares with the committed text of a file, or writes it when the variable SEAM_UPDATE_GOLDEN is set.
void check_golden(const std::string& text, const std::filesystem::path& file);

}  // namespace seam_test
