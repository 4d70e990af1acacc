// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "command_line.hpp"

namespace seam::cli {

/// What the command line returns to the shell.
/// A run that a signal interrupts returns 128 and its number, as shells do for a process that one ends.
enum ExitCode { ok = 0, failed = 1, broken_input = 2, plugin_failure = 3, out_of_time = 124 };

/// One subcommand: its options are declared when it is made, `run` is called when the user chose it.
struct Command {
  CommandLine line;
  std::function<int()> run;  ///< returns an ExitCode; may throw seam::Error
};

// One file each.
Command plugins_command(CommandLine& parent);
Command plugin_test_command(CommandLine& parent);
Command check_command(CommandLine& parent);
Command explain_command(CommandLine& parent);
Command schema_command(CommandLine& parent);
Command run_command(CommandLine& parent);
Command verify_command(CommandLine& parent);
Command study_command(CommandLine& parent);
Command judge_command(CommandLine& parent);

/// `--restricted`, `--trust-geometry` and `--limit`, which hold for the whole process. They may stand before
/// the command's name or after it.
class Trust {
 public:
  void add_options(CommandLine& line);
  /// Makes them the policy of this process. @throws Error
  void apply() const;

 private:
  bool restricted_ = false;
  bool trust_geometry_ = false;
  std::vector<std::string> limits_;
};

/// The options above as words, for a process that this one starts.
std::vector<std::string> trust_as_words();

/// What an exception means to the user.
struct Failure {
  ExitCode code;
  std::string message;
};
/// A message that says that it is an error, as those with a place in a file do by themselves.
std::string as_error(const std::string& message);
/// The exception of the catch block this is called in.
Failure current_failure();

}  // namespace seam::cli
