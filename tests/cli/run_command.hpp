// SPDX-License-Identifier: BSD-3-Clause
// The command line as a user calls it.
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

namespace seam_cli_test {

struct Result {
  int code;
  std::string output;  ///< both streams
};

/// This program has started MPI itself; what it inherits from that would make mpirun and its children refuse
/// to work.
extern const std::string without_own_mpi;

/// @param before words before the command, such as `mpirun -np 2`
Result seam(const std::string& arguments, const std::string& before = "");

/// A folder that goes away again, for scenes and results.
struct Folder {
  std::filesystem::path path;
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// Writes a file; returns its path.
  [[nodiscard]] std::string file(const std::string& name, const std::string& text) const;
  [[nodiscard]] std::string read(const std::string& name) const;
};

}  // namespace seam_cli_test
