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
      if (command.line.parsed()) return command.run();
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
  CommandLine line("Seam: multiphysics finite elements with physics in plugins", SEAM_VERSION);
  line.require_subcommand();
  std::vector<Command> commands{plugins_command(line), plugin_test_command(line), check_command(line),
                                explain_command(line), schema_command(line),      run_command(line),
                                verify_command(line),  study_command(line),       judge_command(line)};
  Trust trust;
  trust.add_options(line);
  for (Command& command : commands) trust.add_options(command.line);
  if (const auto code = line.parse(argc, argv)) return *code;
  return run_chosen(commands, trust);
}
