// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <mpi.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "run.hpp"

namespace seam::cli {
namespace {

std::filesystem::path results_folder(const SceneRun& run, const Scene& scene) {
  if (!run.folder.empty()) return run.folder;
  const Parameters& output = scene.root.object("output");
  if (output.has("folder")) return output.text("folder");
  return std::filesystem::path("results") / scene.path.stem();
}

/// Runs a program and waits; true when it succeeded.
bool run_program(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    execvp(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// The picture program stands beside this one.
std::filesystem::path make_picture(const Scene& scene, const std::filesystem::path& folder) {
  const Parameters& output = scene.root.object("output");
  if (!output.has("picture") || !output.boolean("fields")) return {};
  const Parameters& p = output.object("picture");
  const std::filesystem::path picture = folder / "picture.png";
  const auto beside = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "seam-picture";
  std::vector<std::string> call{beside.string(), (folder / (p.text("field") + ".pvd")).string(), picture.string(),
                                "--array", p.text("quantity"), "--width", std::to_string(p.integer("width")),
                                "--title", scene.root.text("title")};
  if (p.has("component")) call.insert(call.end(), {"--component", p.text("component")});
  if (p.number("deformed") != 0)
    call.insert(call.end(), {"--deform", "displacement", "--scale", fmt::format("{}", p.number("deformed"))});
  return run_program(call) ? picture : std::filesystem::path();
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
  outcome.results = simulation.run(options);
  if (!run.stop_after) outcome.checks = evaluate_checks(scene.root.list("checks"), outcome.results);
  outcome.timings = simulation.timings();
  outcome.unknowns = simulation.unknowns();
  const nlohmann::json summary = simulation.summary(outcome.checks);
  outcome.peak_memory = summary["peak_memory_bytes"];
  if (communicator.rank() == 0) {
    std::ofstream(outcome.folder / "summary.json") << summary.dump(1) << '\n';
    if (run.pictures) outcome.picture = make_picture(scene, outcome.folder);
  }
  return outcome;
}

MpiSession::MpiSession() {
  // One thread per rank: BLAS threads would fight over the cores.
  setenv("OPENBLAS_NUM_THREADS", "1", 0);
  MPI_Init(nullptr, nullptr);
}

MpiSession::~MpiSession() {
  // After an exception the other ranks may be waiting for this one: do not wait for them in turn.
  if (std::uncaught_exceptions() == 0) MPI_Finalize();
}

bool MpiSession::is_root() const { return Communicator().rank() == 0; }

}  // namespace seam::cli
