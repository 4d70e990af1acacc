// SPDX-License-Identifier: BSD-3-Clause
// seam verify: run scenes, and variants of them, and compare each with its own checks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "all_ranks.hpp"
#include "command.hpp"
#include "matrix/matrix.hpp"
#include "run.hpp"
#include "seam/base/policy.hpp"
#include "seam/run/interruption.hpp"

namespace seam::cli {
namespace {
int verify(const std::vector<std::string>& scenes, SceneRun options, bool is_root) {
  int passed = 0, bad = 0;
  std::vector<CheckResult> all;
  for (const std::string& scene : scenes) {
    options.scene = scene;
    options.ignore_scenes_folder = true;
    try {
      const SceneOutcome outcome = run_scene(options);
      // A signal is meant for all; the time that one scene may take is its own.
      if (outcome.interruption && is_root) report_interruption(outcome);
      if (outcome.interruption && outcome.interruption->signal != 0) return outcome.exit_code();
      const bool holds = outcome.passed() && !outcome.interruption;
      if (is_root)
        fmt::print("{} {} ({} checks, {:.2f} s)\n{}", holds ? "ok  " : "FAIL", on_one_line(scene),
                   outcome.checks.size(), outcome.timings.total, check_table(outcome.checks));
      ++(holds ? passed : bad);
      all.insert(all.end(), outcome.checks.begin(), outcome.checks.end());
    } catch (const std::exception&) {
      ++bad;
      const std::string message = agree_on_exception();
      if (is_root) fmt::print("FAIL {}\n{}\n", on_one_line(scene), message);
    }
  }
  if (is_root && !all.empty()) fmt::print("checks that hold: {}\n", count_by_kind(all));
  if (is_root) fmt::print("{} passed, {} failed\n", passed, bad);
  return bad == 0 ? ok : failed;
}

/// What the matrix takes of the options that all runs have.
int verify_matrix_as(MatrixOptions matrix, const SceneRun& options) {
  constexpr double an_hour = 3600;
  matrix.set = options.set;
  matrix.seconds_each = std::min(options.time_limit, 1e9);
  if (!std::isfinite(options.time_limit)) matrix.seconds_each = an_hour;
  return verify_matrix(matrix);
}

}  // namespace

Command verify_command(CommandLine& parent) {
  CommandLine line = parent.add_subcommand(
      "verify",
      "Run scenes, and with --matrix the variants that they ask for, and compare each with its checks");
  auto options = std::make_shared<SceneRun>();
  auto matrix = std::make_shared<MatrixOptions>();
  auto is_matrix = std::make_shared<bool>(false);
  line.add_option("scenes", matrix->scenes, "YAML files; with --matrix folders, too").required();
  add_common(line, *options);
  options->pictures = false;
  line.add_flag(
      "--matrix", *is_matrix,
      "run all variants of the scenes' `matrix` blocks, each in a process of its own, several at once; "
      "--time-limit is that of each, an hour when it is not given");
  const auto of_matrix = [&](Option option) { option.needs("--matrix"); };
  of_matrix(
      line.add_option("--folder", matrix->folder, "where results and tables go; default results/matrix"));
  of_matrix(line.add_option("--jobs", matrix->jobs, "cores to use; default all").positive());
  of_matrix(
      line.add_option("--filter", matrix->selection.filter,
                      "only variants whose 'SCENE: VARIANT' holds this text, or matches it with * and ?"));
  of_matrix(line.add_option(
      "--shard", [matrix](const std::string& text) { matrix->selection.shard = parse_shard(text); },
      "only one of so many parts, 2/5; all of them together are the whole"));
  of_matrix(line.add_option(
      "--tier", [matrix](const std::string& text) { matrix->selection.tier = parse_tier(text); },
      "only scenes of this tier: fast (the default), nightly, or all"));
  of_matrix(line.add_flag("--failed", matrix->failed, "only what failed last time in this folder"));
  of_matrix(line.add_flag("--coverage", matrix->coverage,
                          "say which types, choices and pairs of coupling and field no variant uses"));
  of_matrix(
      line.add_option("--cover", matrix->cover,
                      "fail where no variant uses a type of this plugin, or of the core; may be repeated")
          .take_all());
  of_matrix(line.add_flag("--list", matrix->list, "say what would be run, and end"));
  return {line, [options, matrix, is_matrix] {
            if (*is_matrix) return verify_matrix_as(*matrix, *options);
            return run_on_all_ranks([&](bool is_root) { return verify(matrix->scenes, *options, is_root); });
          }};
}

}  // namespace seam::cli
