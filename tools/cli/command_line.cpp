// SPDX-License-Identifier: BSD-3-Clause
#include "command_line.hpp"

#include <CLI/CLI.hpp>

#include "command.hpp"
#include "seam/base/diagnostics.hpp"

namespace seam::cli {

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::positive() {
  option_->check(CLI::PositiveNumber);
  return *this;
}

Option& Option::hidden() {
  option_->group("");
  return *this;
}

Option& Option::take_all() {
  option_->take_all();
  return *this;
}

Option& Option::one_word_each() {
  option_->allow_extra_args(false);
  return *this;
}

Option& Option::delimiter(char between) {
  option_->delimiter(between);
  return *this;
}

Option& Option::needs(const std::string& name) {
  option_->needs(name);
  return *this;
}

Option& Option::excludes(const std::string& name) {
  option_->excludes(name);
  return *this;
}

CommandLine::CommandLine(const std::string& description, const std::string& version)
    : app_(std::make_shared<CLI::App>(description)) {
  app_->set_version_flag("--version", version);
}

CommandLine CommandLine::add_subcommand(const std::string& name, const std::string& description) {
  // The program's own keeps all others.
  return CommandLine(std::shared_ptr<CLI::App>(app_, app_->add_subcommand(name, description)));
}

void CommandLine::require_subcommand() { app_->require_subcommand(1); }

Option CommandLine::add_flag(const std::string& name, bool& value, const std::string& description) {
  return Option(*app_->add_flag(name, value, description));
}

Option CommandLine::add_option(const std::string& name, std::string& value, const std::string& description) {
  return Option(*app_->add_option(name, value, description));
}

Option CommandLine::add_option(const std::string& name, std::filesystem::path& value,
                               const std::string& description) {
  return Option(*app_->add_option(name, value, description));
}

Option CommandLine::add_option(const std::string& name, std::optional<long>& value,
                               const std::string& description) {
  return Option(*app_->add_option(name, value, description));
}

Option CommandLine::add_option(const std::string& name, std::vector<std::string>& value,
                               const std::string& description) {
  return Option(*app_->add_option(name, value, description));
}

Option CommandLine::add_option(const std::string& name, std::vector<int>& value,
                               const std::string& description) {
  return Option(*app_->add_option(name, value, description));
}

Option CommandLine::add_option(const std::string& name, const std::function<void(const std::string&)>& read,
                               const std::string& description) {
  const auto checked = [name, read](const std::string& text) {
    try {
      read(text);
    } catch (const Error& error) {
      throw CLI::ValidationError(name, error.what());
    }
  };
  return Option(*app_->add_option_function<std::string>(name, checked, description));
}

std::optional<int> CommandLine::parse(int argc, char** argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app_->exit(e) == 0 ? ok : broken_input;
  }
  return std::nullopt;
}

bool CommandLine::parsed() const { return app_->parsed(); }

}  // namespace seam::cli
