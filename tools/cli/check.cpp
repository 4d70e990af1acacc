// SPDX-License-Identifier: BSD-3-Clause
// seam check: all that a run does before its first step, so that what a run would refuse is refused here.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "all_ranks.hpp"
#include "check_report.hpp"
#include "command.hpp"
#include "common.hpp"
#include "matrix/plan.hpp"
#include "seam/run/session.hpp"
#include "seam/scene/resolved.hpp"

namespace seam::cli {

namespace {

struct Options {
  std::string scene;
  std::vector<std::string> set;
  bool without_meshes = false;
  bool without_matrix = false;
  bool json = false;
  bool resolved = false;
};

struct Outcome {
  nlohmann::json contents = nlohmann::json::object();
  std::string messages;  ///< a line each
  int code = ok;
};

/// Every value, those that decide what is computed apart from the others.
std::string resolved_as_text(const ResolvedScene& values) {
  std::string text = fmt::format("# decide what is computed, checksum {}\n", resolved_checksum(values)),
              others = "# the others\n";
  for (const auto& [path, value] : values)
    (determines_numbers(path) ? text : others) += fmt::format("{}: {}\n", path, value);
  return text + others;
}

int print_resolved(const Options& options, bool is_root) {
  Registry registry = builtin_types();
  PluginHost host = PluginHost::standard();
  const Scene scene = load_scene(options.scene, parse_overrides(options.set), host, registry);
  if (is_root) fmt::print("{}", resolved_as_text(resolve(scene, registry)));
  return ok;
}

void require_recorded(const MatrixPlan& matrix, const nlohmann::json& contents) {
  std::vector<std::string> names;
  for (const nlohmann::json& series : contents.at("recorded")) names.push_back(series.at("name"));
  require_series(matrix, names);
}

Outcome check(const Options& options) {
  Registry registry = builtin_types();
  PluginHost host = PluginHost::standard();
  const Scene scene = load_scene(options.scene, parse_overrides(options.set), host, registry);
  MatrixPlan matrix;
  if (!options.without_matrix && scene.root.has("matrix")) matrix = plan_matrix(options.scene, options.set);
  Outcome outcome;
  Diagnostics warnings = scene.warnings;
  if (!options.without_meshes) {
    Session session(scene, registry, Communicator());
    session.prepare();
    session.require_held();
    session.find_conflicts();
    warnings = session.warnings();
    outcome.contents = describe_contents(registry, session);
    require_recorded(matrix, outcome.contents);
  }
  if (!warnings.all().empty()) outcome.messages = warnings.text();
  return outcome;
}

int print(const Options& options, const Outcome& outcome) {
  const std::string contents = outcome.contents.empty() ? std::string() : contents_as_text(outcome.contents);
  fmt::print("{}", contents);
  if (!outcome.messages.empty()) fmt::print(stderr, "{}\n", outcome.messages);
  fmt::print("{}: ok\n", options.scene);
  return ok;
}

/// For programs: one object, also for a scene that is refused.
int print_json(const Options& options) {
  Outcome outcome;
  try {
    outcome = check(options);
  } catch (...) {
    const Failure failure = current_failure();
    outcome.code = failure.code;
    outcome.messages = failure.message;
  }
  nlohmann::json all = outcome.contents;
  all["scene"] = options.scene;
  all["ok"] = outcome.code == ok;
  all["exit_code"] = outcome.code;
  all["diagnostics"] = diagnostics_as_json(outcome.messages);
  // What is no UTF-8 in a message is replaced: it is text of a file.
  fmt::print("{}\n", all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  return outcome.code;
}

int run(const Options& options, bool is_root) {
  if (options.resolved) return print_resolved(options, is_root);
  if (options.json) {
    if (Communicator().size() > 1)
      throw Error("error: --json is for one process; start `seam check` without mpirun");
    return print_json(options);
  }
  const Outcome outcome = check(options);
  return is_root ? print(options, outcome) : ok;
}

}  // namespace

Command check_command(CommandLine& parent) {
  CommandLine line = parent.add_subcommand(
      "check", "Check a scene: set it up as `run` does before the first step, without writing anything");
  auto options = std::make_shared<Options>();
  line.add_option("scene", options->scene, "YAML file").required();
  line.add_option("--set", options->set, "replace a value: key.key=value; may be repeated").take_all();
  line.add_flag("--without-meshes", options->without_meshes, "look at the text alone: nothing is built");
  line.add_flag("--without-matrix", options->without_matrix, "do not look at the variants of `matrix`")
      .hidden();
  line.add_flag("--json", options->json, "what is found as JSON, for editors and continuous integration");
  line.add_flag(
          "--resolved", options->resolved,
          "print every value with its key path, defaults filled in, and the checksum of those that decide "
          "what is computed; nothing is built")
      .excludes("--json");
  return {line, [options] { return run_on_all_ranks([&](bool is_root) { return run(*options, is_root); }); }};
}

}  // namespace seam::cli
