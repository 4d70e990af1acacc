// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace seam {

/// Runs a program (found by PATH when its name has no '/') and waits for it.
/// @param output file that gets what it prints, both streams; empty: as this process prints
/// @returns its exit code; 127 when it could not be started, 128 + number of the signal that ended it
int run_program(const std::vector<std::string>& arguments, const std::filesystem::path& output = {});

/// What a short program prints, without the last line break; "" when it fails.
std::string program_output(const std::vector<std::string>& arguments);

/// The file of this process.
std::filesystem::path own_executable();

}  // namespace seam
