// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "seam/plugin/plugin_host.hpp"
#include "seam/plugin/registry.hpp"
#include "seam/scene/scene.hpp"

namespace seam::cli {

/// What the command line returns to the shell.
/// A run that a signal interrupts returns 128 and its number, as shells do for a process that one ends.
enum ExitCode { ok = 0, failed = 1, broken_input = 2, plugin_failure = 3, out_of_time = 124 };

/// One subcommand: its options are declared when it is made, `run` is called when the user chose it.
struct Command {
  CLI::App* app;
  std::function<int()> run;  ///< returns an ExitCode; may throw seam::Error
};

// One file each.
Command plugins_command(CLI::App& parent);
Command plugin_test_command(CLI::App& parent);
Command check_command(CLI::App& parent);
Command explain_command(CLI::App& parent);
Command schema_command(CLI::App& parent);
Command run_command(CLI::App& parent);
Command verify_command(CLI::App& parent);
Command study_command(CLI::App& parent);
Command judge_command(CLI::App& parent);

/// `--restricted`, `--trust-geometry` and `--limit`, which hold for the whole process. They may stand before
/// the command's name or after it.
class Trust {
 public:
  void add_options(CLI::App& app);
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

/// A registry with the types that need no plugin.
Registry builtin_types();

/// Splits the values of `--set a.b=c` for load_scene().
/// @throws Error when one has no '='.
Overrides parse_overrides(const std::vector<std::string>& values);

/// Loads the named plugins, or (with `all`) every one that is found and can be used.
void load_plugins(const std::vector<std::string>& names, bool all, PluginHost& host, Registry& registry);

}  // namespace seam::cli
