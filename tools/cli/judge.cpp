// SPDX-License-Identifier: BSD-3-Clause
// seam judge: whether a record of a run still speaks for its scene. Nothing is solved.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "all_ranks.hpp"
#include "command.hpp"
#include "common.hpp"
#include "seam/record/run_record.hpp"

namespace seam::cli {
namespace {

struct Options {
  std::string scene, record;
};

double end_of(const Scene& scene) {
  return scene.root.has("time") ? scene.root.object("time").number("end") : 1;
}

Scene load(const std::string& path, const Overrides& overrides, Registry& registry) {
  PluginHost host = PluginHost::standard();
  return load_scene(path, overrides, host, registry);
}

/// What speaks against the record, as text; "" when nothing does.
std::string find_differences(const RunRecord& record, const ResolvedScene& now) {
  std::string text;
  for (const std::string& line : resolved_differences(record.resolved, now)) text += "  " + line + "\n";
  const std::string checksum = resolved_checksum(now);
  if (text.empty() && checksum != record.checksum)
    text = fmt::format("  checksum of the resolved scene: {}, now {}\n", record.checksum, checksum);
  return text;
}

int judge(const Options& options, bool is_root) {
  const RunRecord record = read_record(options.record);
  Registry registry = builtin_types(), plain_registry = builtin_types();
  const Scene scene = load(options.scene, record.overrides, registry);
  const std::string differences = find_differences(record, resolve(scene, registry));
  if (!differences.empty()) {
    if (is_root)
      fmt::print(
          "FAIL {}: the scene is not the one that was recorded in {}\n{}  run it again and record it with "
          "tools/record_run.py, or take the change back\n",
          options.scene, options.record, differences);
    return failed;
  }
  // How far the scene goes without what was replaced: a run to an earlier end is no whole one.
  const double end = end_of(load(options.scene, {}, plain_registry));
  if (record.status != "finished" || record.time < end - 1e-9 * std::abs(end)) {
    if (is_root)
      fmt::print("early {}: {} at t = {:.6g} of {:.6g}; nothing is checked\n", options.scene, record.status,
                 record.time, end);
    return ok;
  }
  const std::vector<CheckResult> checks = seam::judge(scene, record);
  const bool passed = std::ranges::all_of(checks, &CheckResult::passed);
  if (is_root)
    fmt::print("{} {} ({} checks, from {})\n{}", passed ? "ok  " : "FAIL", options.scene, checks.size(),
               options.record, check_table(checks));
  return passed ? ok : failed;
}

}  // namespace

Command judge_command(CommandLine& parent) {
  CommandLine line = parent.add_subcommand(
      "judge", "Compare a recorded run with its scene: the resolved scene, and its checks, evaluated anew");
  auto options = std::make_shared<Options>();
  line.add_option("scene", options->scene, "YAML file").required();
  line.add_option("record", options->record, "folder that tools/record_run.py wrote").required();
  return {line,
          [options] { return run_on_all_ranks([&](bool is_root) { return judge(*options, is_root); }); }};
}

}  // namespace seam::cli
