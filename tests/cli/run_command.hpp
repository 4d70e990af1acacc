// SPDX-License-Identifier: BSD-3-Clause
// The command line as a user calls it.
#pragma once

#include <sys/wait.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

namespace seam_cli_test {

struct Result {
  int code;
  std::string output;  ///< both streams
};

/// This program has started MPI itself; what it inherits from that would make mpirun and its children refuse
/// to work.
inline const std::string without_own_mpi =
    "env $(env | sed -nE 's/^((OMPI|PMIX|OPAL)_[A-Za-z0-9_]*)=.*/-u \\1/p' | grep -v ALLOW) "
    "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 ";

/// @param before words before the command, such as `mpirun -np 2`
inline Result seam(const std::string& arguments, const std::string& before = "") {
  const std::string command = without_own_mpi + "SEAM_PLUGIN_PATH=" SEAM_TEST_PLUGINS " " + before +
                              " " SEAM_COMMAND " " + arguments + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  Result result{-1, ""};
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    result.output.append(buffer.data(), n);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) result.code = WEXITSTATUS(status);
  return result;
}

/// A folder that goes away again, for scenes and results.
struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("seam_cli_" + std::to_string(std::random_device{}()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// Writes a file; returns its path.
  [[nodiscard]] std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
    return (path / name).string();
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream in(path / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

}  // namespace seam_cli_test
