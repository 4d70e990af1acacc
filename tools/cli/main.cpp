// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <malloc.h>

#include <csignal>
#include <cstdio>

#include "command.hpp"
#include "crash.hpp"

namespace {

using namespace seam::cli;

/// Matrices and factors are made anew in every iteration: their pages are kept, since to be given fresh ones
/// costs a tenth of the time on small scenes.
void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
}

int run_chosen(const std::vector<Command>& commands, const Trust& trust) {
  try {
    trust.apply();
    for (const Command& command : commands) {
      if (command.app->parsed()) return command.run();
    }
  } catch (...) {
    const Failure failure = current_failure();
    fmt::print(stderr, "{}\n", as_error(failure.message));
    return failure.code;
  }
  return ok;
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  explain_crashes();
  // A file that grows beyond `ulimit -f` is then an error that can be told, as on a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  CLI::App app("Seam: multiphysics finite elements with physics in plugins");
  app.require_subcommand(1);
  app.set_version_flag("--version", SEAM_VERSION);
  const std::vector<Command> commands{plugins_command(app), plugin_test_command(app), check_command(app),
                                      explain_command(app), schema_command(app),      run_command(app),
                                      verify_command(app),  study_command(app),       judge_command(app)};
  Trust trust;
  trust.add_options(app);
  for (const Command& command : commands) trust.add_options(*command.app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? ok : broken_input;
  }
  return run_chosen(commands, trust);
}
