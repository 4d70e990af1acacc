// SPDX-License-Identifier: BSD-3-Clause
// seam run: solve a scene and compare it with its own checks.
#include "run.hpp"

#include <fmt/format.h>

#include "session.hpp"

namespace seam::cli {
namespace {

void report(const SceneOutcome& outcome) {
  fmt::print("{}\n", outcome.title);
  if (!outcome.checks.empty()) fmt::print("{}", check_table(outcome.checks));
  const Timings& t = outcome.timings;
  fmt::print(
      "  {} unknowns, {:.2f} s: setup {:.2f}, cut {:.2f}, pattern {:.2f}, assembly {:.2f}, linear solver "
      "{:.2f}, "
      "output {:.2f}; {:.0f} MB\n",
      outcome.unknowns, t.total, t.setup, t.cut, t.pattern, t.assembly, t.linear, t.output,
      outcome.peak_memory / 1e6);
  fmt::print("  results: {}\n", outcome.folder.string());
  if (!outcome.picture.empty()) fmt::print("  picture: {}\n", outcome.picture.string());
}

int run(const SceneRun& options, bool is_root) {
  const SceneOutcome outcome = run_scene(options);
  if (is_root) report(outcome);
  return outcome.passed() ? ok : failed;
}

int verify(const std::vector<std::string>& scenes, SceneRun options, bool is_root) {
  int passed = 0, bad = 0;
  for (const std::string& scene : scenes) {
    options.scene = scene;
    options.folder = std::filesystem::path("results") / std::filesystem::path(scene).stem();
    try {
      const SceneOutcome outcome = run_scene(options);
      if (is_root)
        fmt::print("{} {} ({} checks, {:.2f} s)\n{}", outcome.passed() ? "ok  " : "FAIL", scene,
                   outcome.checks.size(), outcome.timings.total, check_table(outcome.checks));
      ++(outcome.passed() ? passed : bad);
    } catch (const Error&) {
      ++bad;
      const std::string message = agree_on_exception();
      if (is_root) fmt::print("FAIL {}\n{}\n", scene, message);
    }
  }
  if (is_root) fmt::print("{} passed, {} failed\n", passed, bad);
  return bad == 0 ? ok : failed;
}

void add_common(CLI::App* app, SceneRun& run) {
  app->add_option("--set", run.set, "replace a value: key.key=value; may be repeated")->take_all();
  app->add_flag("--quiet", run.quiet, "no progress line");
  app->add_flag("!--no-picture", run.pictures, "make no picture");
}

}  // namespace

Command run_command(CLI::App& parent) {
  CLI::App* app = parent.add_subcommand("run", "Run a scene");
  auto options = std::make_shared<SceneRun>();
  app->add_option("scene", options->scene, "YAML file")->required();
  app->add_option("--folder", options->folder,
                  "where results go; default as the scene says, else results/<scene>");
  app->add_flag("--resume", options->resume, "continue from the newest restart point, if there is one");
  app->add_option("--stop-after", options->stop_after, "take so many steps only");
  add_common(app, *options);
  return {app, [options] { return run_on_all_ranks([&](bool is_root) { return run(*options, is_root); }); }};
}

Command verify_command(CLI::App& parent) {
  CLI::App* app = parent.add_subcommand("verify", "Run scenes and compare each with its checks");
  auto options = std::make_shared<SceneRun>();
  auto scenes = std::make_shared<std::vector<std::string>>();
  app->add_option("scenes", *scenes, "YAML files")->required();
  add_common(app, *options);
  options->pictures = false;
  return {app, [options, scenes] {
            return run_on_all_ranks([&](bool is_root) { return verify(*scenes, *options, is_root); });
          }};
}

}  // namespace seam::cli
