// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "command.hpp"

namespace {

using namespace seam::cli;

int run_chosen(const std::vector<Command>& commands) {
  try {
    for (const Command& command : commands) {
      if (command.app->parsed()) return command.run();
    }
  } catch (const seam::PluginError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return plugin_failure;
  } catch (const seam::Error& e) {
    fmt::print(stderr, "{}\n", e.what());
    return broken_input;
  } catch (const std::exception& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return failed;
  }
  return ok;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Seam: multiphysics finite elements with physics in plugins");
  app.require_subcommand(1);
  app.set_version_flag("--version", SEAM_VERSION);
  const std::vector<Command> commands{plugins_command(app), check_command(app), explain_command(app),
                                      schema_command(app),  run_command(app),   verify_command(app)};
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? ok : broken_input;
  }
  return run_chosen(commands);
}
