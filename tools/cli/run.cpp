// SPDX-License-Identifier: BSD-3-Clause
// seam run: solve a scene and compare it with its own checks.
#include "run.hpp"

#include <fmt/format.h>

#include "all_ranks.hpp"
#include "seam/base/policy.hpp"
#include "seam/run/interruption.hpp"
#include "seam/scene/expression.hpp"

namespace seam::cli {
namespace {

void report(const SceneOutcome& outcome) {
  fmt::print("{}\n", on_one_line(outcome.title));
  if (!outcome.checks.empty()) fmt::print("{}", check_table(outcome.checks));
  const Timings& t = outcome.timings;
  fmt::print(
      "  {} unknowns, {:.2f} s: setup {:.2f}, cut {:.2f}, pattern {:.2f}, assembly {:.2f}, linear solver "
      "{:.2f}, "
      "output {:.2f}; {:.0f} MB\n",
      outcome.unknowns, t.total, t.setup, t.cut, t.pattern, t.assembly, t.linear, t.output,
      outcome.peak_memory / 1e6);
  if (!outcome.linear_choice.empty()) fmt::print("  solved by {}\n", outcome.linear_choice);
  fmt::print("  results: {}\n", outcome.folder.string());
  if (!outcome.picture.empty()) fmt::print("  picture: {}\n", outcome.picture.string());
}

int run(const SceneRun& options, bool is_root) {
  const SceneOutcome outcome = run_scene(options);
  if (outcome.had_finished) {
    if (is_root)
      fmt::print("the run in {} is finished, there is nothing to resume; --overwrite solves it again\n",
                 outcome.folder.string());
    return ok;
  }
  if (is_root) report(outcome);
  if (is_root && outcome.lacks_picture)
    fmt::print(stderr, "error: the picture that the scene asks for was not made: see above\n");
  if (is_root && outcome.interruption) report_interruption(outcome);
  return outcome.exit_code();
}

}  // namespace

void report_interruption(const SceneOutcome& outcome) {
  fmt::print(
      stderr,
      "interrupted: {}. The state at t = {:.6g}, step {}, is in {}; the same command with --resume goes "
      "on from it\n",
      outcome.interruption->reason, outcome.time, outcome.steps, outcome.folder.string());
}

void add_common(CommandLine& line, SceneRun& run) {
  line.add_option("--set", run.set, "replace a value: key.key=value; may be repeated").take_all();
  line.add_flag("--overwrite", run.use.overwrite,
                "replace what is in the folder, whatever run wrote it and whatever came of it");
  line.add_option(
      "--time-limit", [&run](const std::string& text) { run.time_limit = parse_duration(text); },
      "begin no step after so much wall time (90m, 1h30m, seconds): writes a restart point, exit code 124");
  line.add_flag("--quiet", run.quiet, "no progress line, no warnings");
  line.add_flag("!--no-picture", run.pictures, "make no picture");
}

Command run_command(CommandLine& parent) {
  CommandLine line = parent.add_subcommand("run", "Run a scene");
  auto options = std::make_shared<SceneRun>();
  line.add_option("scene", options->scene, "YAML file").required();
  line.add_option("--folder", options->folder,
                  "where results go; default as the scene says, else results/<scene>");
  Option resume = line.add_flag("--resume", options->use.resume,
                                "continue from the newest restart point, if there is one");
  line.add_flag("--changed", options->use.changed, "with --resume: go on although the scene has changed")
      .needs("--resume");
  line.add_option("--stop-after", options->stop_after, "take so many steps, and leave a restart point")
      .positive();
  line.add_option(
      "--stop-at", [options](const std::string& text) { options->stop_at = evaluate_constant(text, {}); },
      "begin no step from this time on, and leave a restart point");
  add_common(line, *options);
  resume.excludes("--overwrite");
  return {line, [options] { return run_on_all_ranks([&](bool is_root) { return run(*options, is_root); }); }};
}

}  // namespace seam::cli
