// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "selection.hpp"

namespace seam::cli {

/// `seam verify --matrix`.
struct MatrixOptions {
  std::vector<std::string> scenes;  ///< files and folders
  std::vector<std::string> set;     ///< for all variants
  std::filesystem::path folder = std::filesystem::path("results") / "matrix";
  std::optional<long> jobs;  ///< cores to use; none: all
  double seconds_each;       ///< that a variant may take
  Selection selection;
  bool failed = false;             ///< only what failed last time, as the folder's matrix.json says
  bool list = false;               ///< say what would be run
  bool coverage = false;           ///< say what no variant uses
  std::vector<std::string> cover;  ///< plugins, or "core", each of whose types some variant must use
};

/// Runs variants of scenes, each in a process and a folder of its own, several at once; writes matrix.json,
/// matrix.md and junit.xml. In a process without MPI.
/// @returns an ExitCode; 128 and the signal's number where one ended it
int verify_matrix(const MatrixOptions& options);

}  // namespace seam::cli
