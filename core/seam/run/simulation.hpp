// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "seam/base/stopwatch.hpp"
#include "seam/output/results_folder.hpp"
#include "seam/record/checks.hpp"
#include "seam/record/recorders.hpp"
#include "seam/run/session.hpp"

namespace seam {

struct RunOptions {
  /// Where results go; none: to `folder`, which is opened for this run alone, as `resume` says.
  ResultsFolder* results = nullptr;
  std::filesystem::path folder;    ///< for results; created; what an earlier run wrote there is replaced
  bool resume = false;             ///< continue from the newest restart point in the folder, if there is one
  bool quiet = false;              ///< no progress line
  bool announce = false;           ///< say where a run that is resumed starts
  std::optional<long> stop_after;  ///< steps to take in this run
  std::optional<double> stop_at;   ///< time from which on no further step is begun, s
  /// No step is begun after so many seconds since the simulation was begun to be built.
  double time_limit = std::numeric_limits<double>::infinity();
};

/// Why a run was ended before its end, though nothing was wrong.
struct Interruption {
  int signal = 0;      ///< that was caught; 0: the time limit
  std::string reason;  ///< in words
};

/// Where the time of a run went, s.
struct Timings {
  double setup = 0, cut = 0, pattern = 0, assembly = 0, linear = 0, output = 0, total = 0;
};

/// A run of a scene: a session that is driven to the end of its time, with recorders that write it down.
class Simulation {
 public:
  /// Collective. @throws Error with places in the scene
  Simulation(const Scene& scene, const Registry& registry, const Communicator& communicator);

  /// Runs to the end, or until a signal that a SignalWatch has caught or the time limit interrupts it: then
  /// the state is on disk, with a restart point. Collective.
  /// @throws Error when a step fails for good; then the state is that before the step
  const Results& run(const RunOptions& options);

  /// After run() threw on all ranks: puts the last good state on disk, its fields and a restart point,
  /// whatever the scene says about intervals, and keeps the reason for summary(). Collective.
  void record_failure(const std::string& reason);
  /// Whether there is a state: before run() has set one up there is nothing to be saved.
  [[nodiscard]] bool has_state() const { return !session_.results().time.empty(); }
  /// What run() was interrupted by, if it was.
  [[nodiscard]] const std::optional<Interruption>& interruption() const { return interruption_; }
  /// "finished", "stopped" (as the options say), "interrupted" or "failed".
  [[nodiscard]] std::string status() const;

  [[nodiscard]] Session& session() { return session_; }
  [[nodiscard]] Problem& problem() { return session_.problem(); }
  [[nodiscard]] const Timings& timings() const { return timings_; }
  /// The machine-readable record of the run: residual histories, times, memory, versions, checks.
  [[nodiscard]] nlohmann::json summary(const std::vector<CheckResult>& checks);

 private:
  void start(const RunOptions& options);
  [[nodiscard]] std::filesystem::path choose_restart();
  void announce_start(bool resumed) const;
  void add_recorders(const RunOptions& options, double resume_time);
  [[nodiscard]] Standing standing() const;
  /// Tells all recorders. @param call of each
  template <class Call>
  void tell(Call&& call);
  bool attend(const RunOptions& options);
  [[nodiscard]] double advance(double step, Refusals& refusals);
  void end();
  void finish_timings();

  const Scene& scene_;
  Communicator communicator_;
  std::string resolved_checksum_;  ///< on rank 0; files as they were at the start
  Session session_;
  std::unique_ptr<ResultsFolder> own_folder_;  ///< when none was given
  ResultsFolder* folder_ = nullptr;
  std::vector<std::unique_ptr<Recorder>> recorders_;
  RestartRecorder* restart_ = nullptr;  ///< one of them
  Stopwatch run_watch_;
  double recording_seconds_ = 0;
  Timings timings_;
  std::string failure_;  ///< why the run ended early, "" if it did not
  std::optional<Interruption> interruption_;
};

}  // namespace seam
