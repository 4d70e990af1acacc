// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "command.hpp"
#include "seam/run/simulation.hpp"

namespace seam::cli {

/// How a scene is to be run.
struct SceneRun {
  std::string scene;
  std::vector<std::string> set;
  std::filesystem::path folder;   ///< empty: as the scene says, else results/<scene>
  bool resume = false;
  bool quiet = false;
  bool pictures = true;
  std::optional<long> stop_after;
};

/// What came of it.
struct SceneOutcome {
  std::string title;
  Results results;
  std::vector<CheckResult> checks;
  std::filesystem::path folder;
  std::filesystem::path picture;   ///< empty when none was made
  Timings timings;
  long long unknowns = 0;
  double peak_memory = 0;          ///< bytes, over all ranks
  [[nodiscard]] bool passed() const;
};

/// Loads, runs, checks and records a scene; writes summary.json. Collective.
SceneOutcome run_scene(const SceneRun& run);

/// Starts MPI for the rest of the process.
class MpiSession {
 public:
  MpiSession();
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  [[nodiscard]] bool is_root() const;
};

}  // namespace seam::cli
