// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "all_ranks.hpp"
#include "common.hpp"
#include "run.hpp"
#include "seam/base/all_or_none.hpp"
#include "seam/base/memory.hpp"
#include "seam/base/plugin_fault.hpp"
#include "seam/base/policy.hpp"
#include "seam/base/program.hpp"
#include "seam/output/atomic_file.hpp"
#include "seam/output/results_folder.hpp"
#include "seam/run/interruption.hpp"
#include "seam/solve/newton.hpp"

namespace seam::cli {
namespace {

/// results/NAME, or, where another scene of that name has its results there, results/NAME-FOLDER with the
/// folder that the scene lies in.
std::filesystem::path default_folder(const Scene& scene) {
  const std::string name = scene.path.stem().string();
  std::filesystem::path usual = std::filesystem::path("results") / name;
  if (!ResultsFolder::belongs_to_another(usual, scene)) return usual;
  const std::string parent = std::filesystem::absolute(scene.path).parent_path().filename().string();
  return std::filesystem::path("results") / (name + "-" + parent);
}

/// Collective: the first rank looks, before any makes the folder.
std::filesystem::path results_folder(const SceneRun& run, const Scene& scene,
                                     const Communicator& communicator) {
  if (!run.folder.empty()) return run.folder;
  const Parameters& output = scene.root.object("output");
  const bool is_given = output.has("folder") && !run.ignore_scenes_folder;
  std::filesystem::path folder =
      is_given ? output.text("folder")
               : from_root(communicator, communicator.rank() == 0 ? default_folder(scene).string() : "");
  // A folder that is called like a file of a run would be in another one's way.
  for (const std::filesystem::path& part : folder)
    if (ResultsFolder::is_name_of_file(part))
      throw Error(
          is_given ? output.where("folder") : Location{folder.string()},
          fmt::format("'{}' is called like a file that runs write; choose another folder for the results",
                      part.string()));
  // What comes with a stranger's scene may hold links, too.
  if (policy().restricted && !is_below(folder, "."))
    throw Error(Location{folder.string()},
                "the results would be written outside the current folder, as a link on the "
                "way leads there; choose a folder by --folder");
  return folder;
}

bool wants_picture(const Scene& scene) {
  const Parameters& output = scene.root.object("output");
  return output.has("picture") && output.boolean("fields");
}

/// The picture program stands beside this one.
/// @param deforms the field shown has a displacement
std::filesystem::path make_picture(const Scene& scene, ResultsFolder& results, bool deforms) {
  const Parameters& p = scene.root.object("output").object("picture");
  const std::filesystem::path& folder = results.path();
  results.remove("picture.png");
  results.claim("picture.png", ResultsFolder::at_the_end);
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
  // Not asked for, a field without a displacement is shown as it is.
  if (p.number("deformed") != 0 && (deforms || p.given("deformed")))
    call.insert(call.end(), {"--deform", "displacement", "--scale", fmt::format("{}", p.number("deformed"))});
  return run_program(call) == 0 ? picture : std::filesystem::path();
}

/// Collective.
nlohmann::json write_summary(Simulation& simulation, const std::vector<CheckResult>& checks,
                             ResultsFolder& folder, const Communicator& communicator) {
  nlohmann::json summary = simulation.summary(checks);
  all_or_none<FileError>(communicator, [&] {
    if (communicator.rank() != 0) return;
    folder.claim("summary.json", ResultsFolder::at_the_end);
    // What is no UTF-8 (a path in a message) must not cost the summary.
    const std::string text = summary.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    write_text_atomically((folder.path() / "summary.json").string(), text);
  });
  return summary;
}

/// Within a catch block: whether the scene or the solver is to blame, and not what the run needs around it.
bool is_own_fault() {
  try {
    throw;
  } catch (const FileError&) {
    return false;
  } catch (const OutOfMemory&) {
    return false;
  } catch (const PluginFault&) {
    return false;
  } catch (const Error&) {
    return true;
  } catch (...) {
    return false;
  }
}

std::string name_newest_restart(const ResultsFolder& folder) {
  const std::vector<std::string> points = folder.restart_points();
  if (points.empty()) return "";
  return fmt::format("\nThe newest restart point is '{}'; `seam run --resume` starts from it",
                     (folder.path() / points.front()).string());
}

/// Within a catch block: leaves the last good state and the reason on disk.
/// @returns what to tell the user, the same on all ranks
std::string record_failure(Simulation& simulation, ResultsFolder& folder, const Communicator& communicator) {
  const bool keeps = !is_own_fault();
  const std::string message = agree_on_exception();
  std::string text = as_error(message);
  const std::string status = communicator.any(keeps) ? "broken" : "failed";
  try {
    simulation.record_failure(message);
    write_summary(simulation, {}, folder, communicator);
    folder.finish(status);
  } catch (const std::exception&) {
    // What made the run fail (a full disk, say) may prevent its record, too; the first reason is the one to
    // show.
    return from_root(communicator, fmt::format("{}\nthe last good state could not be saved: {}{}", text,
                                               agree_on_exception(), name_newest_restart(folder)));
  }
  if (!simulation.has_state()) return text;
  return fmt::format(
      "{}\nThe last good state (t = {:.6g}, step {}) is in {}; `seam run --resume` starts from it", text,
      simulation.session().state().time, simulation.session().state().step_number, folder.path().string());
}

/// Writes the summary even where the checks cannot be evaluated: what has been computed is not lost by a
/// check's misspelt name.
std::vector<CheckResult> judge(Simulation& simulation, const Scene& scene, const Results& results,
                               ResultsFolder& folder, const Communicator& communicator) {
  try {
    return evaluate_checks(scene.root.list("checks"), results);
  } catch (const Error&) {
    write_summary(simulation, {}, folder, communicator);
    folder.finish(simulation.status());
    throw;
  }
}

}  // namespace

bool SceneOutcome::passed() const {
  return std::all_of(checks.begin(), checks.end(), [](const CheckResult& c) { return c.passed; });
}

int SceneOutcome::exit_code() const {
  if (!interruption) return passed() && !lacks_picture ? ok : failed;
  constexpr int by_signal = 128;
  return interruption->signal != 0 ? by_signal + interruption->signal : out_of_time;
}

SceneOutcome run_scene(const SceneRun& run) {
  const SignalWatch watch;
  Registry registry = builtin_types();
  PluginHost host = PluginHost::standard();
  const Scene scene = load_scene(run.scene, parse_overrides(run.set), host, registry);
  const Communicator communicator;

  SceneOutcome outcome;
  outcome.title = scene.root.text("title");
  // Before anything is built: what the folder holds may forbid the run.
  ResultsFolder folder(communicator, scene, results_folder(run, scene, communicator), run.use);
  outcome.folder = folder.path();
  // Whoever starts a run again until it is done is not to have it solved again.
  outcome.had_finished = folder.has_finished() && !run.use.changed;
  if (outcome.had_finished) return outcome;
  Simulation simulation(scene, registry, communicator);
  RunOptions options;
  options.results = &folder;
  options.resume = run.use.resume;
  options.announce = true;
  options.quiet = run.quiet;
  options.stop_after = run.stop_after;
  options.stop_at = run.stop_at;
  options.time_limit = std::min(run.time_limit, policy().limits.seconds);
  try {
    outcome.results = simulation.run(options);
  } catch (const std::exception& error) {
    if (!folder.has_begun()) throw;
    ExitCode code = failed;
    if (dynamic_cast<const PluginFault*>(&error) != nullptr) code = plugin_failure;
    if (dynamic_cast<const NothingHolds*>(&error) != nullptr) code = broken_input;  // as `check` says
    throw RunFailure(record_failure(simulation, folder, communicator), code);
  }
  outcome.interruption = simulation.interruption();
  if (!run.stop_after && !run.stop_at && !outcome.interruption)
    outcome.checks = judge(simulation, scene, outcome.results, folder, communicator);
  outcome.timings = simulation.timings();
  outcome.linear_choice = simulation.session().linear_choice();
  outcome.unknowns = simulation.session().unknowns();
  outcome.steps = simulation.session().state().step_number;
  outcome.time = simulation.session().state().time;
  const nlohmann::json summary = write_summary(simulation, outcome.checks, folder, communicator);
  outcome.peak_memory = summary["peak_memory_bytes"];
  folder.finish(simulation.status());
  if (run.pictures && wants_picture(scene)) {
    const auto& shown =
        simulation.problem().field(scene.root.object("output").object("picture").text("field"));
    const bool deforms = std::ranges::any_of(shown.field->unknowns(),
                                             [](const Unknown& u) { return u.name == "displacement"; });
    if (communicator.rank() == 0) outcome.picture = make_picture(scene, folder, deforms);
    outcome.lacks_picture = communicator.any(communicator.rank() == 0 && outcome.picture.empty());
  }
  return outcome;
}

}  // namespace seam::cli
