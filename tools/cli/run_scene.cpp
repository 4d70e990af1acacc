// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "run.hpp"
#include "seam/base/program.hpp"
#include "seam/output/atomic_file.hpp"
#include "session.hpp"

namespace seam::cli {
namespace {

std::filesystem::path results_folder(const SceneRun& run, const Scene& scene) {
  if (!run.folder.empty()) return run.folder;
  const Parameters& output = scene.root.object("output");
  if (output.has("folder")) return output.text("folder");
  return std::filesystem::path("results") / scene.path.stem();
}

/// The picture program stands beside this one.
std::filesystem::path make_picture(const Scene& scene, const std::filesystem::path& folder) {
  const Parameters& output = scene.root.object("output");
  if (!output.has("picture") || !output.boolean("fields")) return {};
  const Parameters& p = output.object("picture");
  const std::filesystem::path picture = folder / "picture.png";
  const auto beside = own_executable().parent_path() / "seam-picture";
  std::vector<std::string> call{beside.string(),
                                (folder / (p.text("field") + ".pvd")).string(),
                                picture.string(),
                                "--array",
                                p.text("quantity"),
                                "--width",
                                std::to_string(p.integer("width")),
                                "--title",
                                scene.root.text("title")};
  if (p.has("component")) call.insert(call.end(), {"--component", p.text("component")});
  if (p.number("deformed") != 0)
    call.insert(call.end(), {"--deform", "displacement", "--scale", fmt::format("{}", p.number("deformed"))});
  return run_program(call) == 0 ? picture : std::filesystem::path();
}

void write_summary(const nlohmann::json& summary, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  write_text_atomically((folder / "summary.json").string(), summary.dump(1) + "\n");
}

/// Within a catch block: leaves the last good state and the reason on disk.
/// @returns what to tell the user, the same on all ranks
std::string record_failure(Simulation& simulation, const std::filesystem::path& folder,
                           const Communicator& communicator) {
  const std::string message = agree_on_exception();
  try {
    simulation.record_failure(message);
    const nlohmann::json summary = simulation.summary({});
    if (communicator.rank() == 0) write_summary(summary, folder);
  } catch (const std::exception& error) {
    // What made the run fail (a full disk, say) may prevent its record, too; the first reason is the one to
    // show.
    return fmt::format("error: {}\nthe last good state could not be saved: {}", message, error.what());
  }
  return fmt::format(
      "error: {}\nThe last good state (t = {:.6g}, step {}) is in {}; `seam run --resume` starts from it",
      message, simulation.time(), simulation.step_number(), folder.string());
}

}  // namespace

bool SceneOutcome::passed() const {
  return std::all_of(checks.begin(), checks.end(), [](const CheckResult& c) { return c.passed; });
}

SceneOutcome run_scene(const SceneRun& run) {
  Registry registry = builtin_types();
  PluginHost host = PluginHost::standard();
  const Scene scene = load_scene(run.scene, parse_overrides(run.set), host, registry);
  const Communicator communicator;
  if (communicator.rank() == 0 && !scene.warnings.all().empty() && !run.quiet)
    fmt::print(stderr, "{}\n", scene.warnings.text());

  SceneOutcome outcome;
  outcome.title = scene.root.text("title");
  outcome.folder = results_folder(run, scene);
  Simulation simulation(scene, registry, communicator);
  RunOptions options;
  options.folder = outcome.folder;
  options.resume = run.resume;
  options.quiet = run.quiet;
  options.stop_after = run.stop_after;
  try {
    outcome.results = simulation.run(options);
  } catch (const Error&) {
    throw RunFailure(record_failure(simulation, outcome.folder, communicator));
  }
  if (!run.stop_after) outcome.checks = evaluate_checks(scene.root.list("checks"), outcome.results);
  outcome.timings = simulation.timings();
  outcome.unknowns = simulation.unknowns();
  const nlohmann::json summary = simulation.summary(outcome.checks);
  outcome.peak_memory = summary["peak_memory_bytes"];
  if (communicator.rank() == 0) {
    write_summary(summary, outcome.folder);
    if (run.pictures) outcome.picture = make_picture(scene, outcome.folder);
  }
  return outcome;
}

}  // namespace seam::cli
