// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "seam/base/diagnostics.hpp"
#include "seam/run/simulation.hpp"

namespace seam::cli {

/// How a scene is to be run.
struct SceneRun {
  std::string scene;
  std::vector<std::string> set;
  std::filesystem::path folder;       ///< empty: as the scene says, else results/<scene>
  bool ignore_scenes_folder = false;  ///< results/<scene>, whatever the scene says
  FolderUse use;
  double time_limit = std::numeric_limits<double>::infinity();  ///< s
  bool quiet = false;
  bool pictures = true;
  std::optional<long> stop_after;
  std::optional<double> stop_at;
};

/// What came of it.
struct SceneOutcome {
  std::string title;
  Results results;
  std::vector<CheckResult> checks;
  std::filesystem::path folder;
  bool had_finished = false;      ///< the run to be resumed had come to its end: nothing was done
  bool lacks_picture = false;     ///< one that the scene asks for could not be made
  std::filesystem::path picture;  ///< empty when none was made
  Timings timings;
  long long unknowns = 0;
  double peak_memory = 0;     ///< bytes, over all ranks
  std::string linear_choice;  ///< which linear solver was chosen, and why; empty: the scene says which
  long steps = 0;
  double time = 0;                           ///< of the last state, s
  std::optional<Interruption> interruption;  ///< when the run did not reach its end; then nothing is checked
  [[nodiscard]] bool passed() const;
  /// Of the command that ran this scene alone.
  [[nodiscard]] int exit_code() const;
};

/// A scene whose solution failed.
class RunFailure : public Error {
 public:
  /// @param code of the command: `failed` where the scene itself is well, `plugin_failure` where a plugin is
  /// to blame, `broken_input` where the first step shows that the scene is
  RunFailure(const std::string& message, ExitCode code) : Error(message), code_(code) {}
  [[nodiscard]] ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// Loads, runs, checks and records a scene; writes summary.json. Collective.
/// @throws Error when the scene is broken; RunFailure when its solution fails: then summary.json holds the
/// reason, and the last good state is in the folder.
SceneOutcome run_scene(const SceneRun& run);

/// Says on standard error how to go on with a run that was interrupted.
void report_interruption(const SceneOutcome& outcome);

/// Declares the options that `run` and `verify` have in common.
void add_common(CommandLine& line, SceneRun& run);

}  // namespace seam::cli
