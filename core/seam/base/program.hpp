// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace seam {

/// What a program that is not Seam's may take. It never outlives this process.
struct ProgramLimits {
  double seconds;       ///< by the clock
  double memory_bytes;  ///< of address space
  double file_bytes;    ///< of each file that it writes
};

/// A file without a name, for what a program writes: gone when this process ends, in whatever way.
class NamelessFile {
 public:
  /// @throws Error when none can be made
  NamelessFile();
  ~NamelessFile();
  NamelessFile(const NamelessFile&) = delete;
  NamelessFile& operator=(const NamelessFile&) = delete;
  /// What a program that this process starts opens it by.
  [[nodiscard]] std::string path() const;
  [[nodiscard]] std::string read() const;

 private:
  int handle_ = -1;
};

/// Runs a program (found by PATH when its name has no '/') and waits for it.
/// @param output file that gets what it prints, both streams; empty: as this process prints
/// @returns its exit code; 127 when it could not be started, 128 + number of the signal that ended it
int run_program(const std::vector<std::string>& arguments, const std::filesystem::path& output = {});

/// The same within limits, with what it prints in a file.
/// @returns also timed_out when it had to be ended
int run_program(const std::vector<std::string>& arguments, const NamelessFile& output,
                const ProgramLimits& limits);
constexpr int timed_out = -1;

/// A program that runs beside this process, in a group of its own with all that it starts. It ends when this
/// process does.
class RunningProgram {
 public:
  /// @param output file that gets what it prints, both streams
  RunningProgram(const std::vector<std::string>& arguments, const std::filesystem::path& output);
  /// Ends it when it still runs.
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  /// Its exit code, as run_program() returns it; none as long as it runs.
  [[nodiscard]] std::optional<int> ended();
  /// Sends a signal to its group.
  void send(int signal) const;

 private:
  int process_ = -1;
  std::optional<int> code_;
};

/// What a short program prints, without the last line break; "" when it fails.
std::string program_output(const std::vector<std::string>& arguments);

/// The file of this process.
std::filesystem::path own_executable();

}  // namespace seam
