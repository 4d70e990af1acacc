// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// Their header takes a compiler longer than most of our files: command_line.cpp alone reads it.
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace seam::cli {

/// An option that was declared, to say more of it.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option& required();
  Option& positive();  ///< a number above 0
  Option& hidden();    ///< not in the help
  /// May be given again: the values come one after the other.
  Option& take_all();
  /// Takes a single word each time it is given, though it has a list of values.
  Option& one_word_each();
  /// One word may hold several values.
  Option& delimiter(char between);
  /// @param name of an option of the same command that was declared before
  Option& needs(const std::string& name);
  Option& excludes(const std::string& name);

 private:
  CLI::Option* option_;
};

/// What may stand on the command line, of the program or of one of its commands. Copies are the same one.
class CommandLine {
 public:
  /// That of the program, which then has `--help` and `--version`.
  CommandLine(const std::string& description, const std::string& version);

  CommandLine add_subcommand(const std::string& name, const std::string& description);
  /// One of the subcommands must be given.
  void require_subcommand();

  /// @param name `--name`, or `!--name` for one that makes the value false
  Option add_flag(const std::string& name, bool& value, const std::string& description = "");

  /// An option with a value; parse() leaves the value alone when it is not given.
  /// @param name `--name`, or `name` for one that is known by its place
  Option add_option(const std::string& name, std::string& value, const std::string& description = "");
  Option add_option(const std::string& name, std::filesystem::path& value, const std::string& description);
  Option add_option(const std::string& name, std::optional<long>& value, const std::string& description);
  Option add_option(const std::string& name, std::vector<std::string>& value, const std::string& description);
  Option add_option(const std::string& name, std::vector<int>& value, const std::string& description);
  /// @param read is called with the value; what it throws as seam::Error is told as a wrong value
  Option add_option(const std::string& name, const std::function<void(const std::string&)>& read,
                    const std::string& description);

  /// Reads what the user gave, for the program and its commands.
  /// @returns the ExitCode to end with at once: help was asked for and printed, or something is wrong and
  /// told; nothing when there is a command to run
  std::optional<int> parse(int argc, char** argv);

  /// Whether the user chose this command.
  [[nodiscard]] bool parsed() const;

 private:
  explicit CommandLine(std::shared_ptr<CLI::App> app) : app_(std::move(app)) {}
  std::shared_ptr<CLI::App> app_;
};

}  // namespace seam::cli
