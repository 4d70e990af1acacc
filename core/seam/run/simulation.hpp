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
#include "seam/linear/linear_solver.hpp"
#include "seam/run/checks.hpp"
#include "seam/run/cost_estimate.hpp"
#include "seam/run/cut_output.hpp"
#include "seam/run/field_output.hpp"
#include "seam/run/interface_output.hpp"
#include "seam/run/live_files.hpp"
#include "seam/run/probes.hpp"
#include "seam/run/restart.hpp"
#include "seam/run/stepper.hpp"
#include "seam/run/time_step.hpp"
#include "seam/scene/scene.hpp"

namespace seam {

class ErrorList;

struct RunOptions {
  /// Where results go; none: to `folder`, which is opened for this run alone, as `resume` says.
  ResultsFolder* results = nullptr;
  std::filesystem::path folder;    ///< for results; created; what an earlier run wrote there is replaced
  bool resume = false;             ///< continue from the newest restart point in the folder, if there is one
  bool quiet = false;              ///< no progress line
  bool announce = false;           ///< say where a run that is resumed starts
  std::optional<long> stop_after;  ///< steps to take in this run
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

/// A scene brought to life: built, stepped through time, recorded.
class Simulation {
 public:
  /// Builds meshes, fields and couplings. Collective.
  /// @throws Error with places in the scene
  Simulation(const Scene& scene, const Registry& registry, const Communicator& communicator);

  /// All that a run does before its first step, without a trace on disk: sets up the state at the start,
  /// records it once, and finds whatever the scene names. Collective.
  /// @throws Error with places in the scene
  void prepare();
  /// After prepare().
  /// @throws Error naming the fields that can change without resistance. Collective.
  void require_held();
  /// What a step will cost. After require_held(). Collective.
  [[nodiscard]] CostEstimate estimate() { return estimate_cost(problem_, *linear_, assembly_seconds_); }
  /// Adds what only the built problem shows to warnings(). Collective.
  void find_conflicts();
  /// Of what is legal but hardly meant.
  [[nodiscard]] const Diagnostics& warnings() const { return warnings_; }
  /// What has been recorded so far.
  [[nodiscard]] const Results& results() const { return state_.results; }

  /// Runs to the end, or until a signal that a SignalWatch has caught or the time limit interrupts it: then
  /// the state is on disk, with a restart point. Collective.
  /// @throws Error when a step fails for good; then the state is that before the step
  const Results& run(const RunOptions& options);

  /// After run() threw on all ranks: puts the last good state on disk, its fields and a restart point,
  /// whatever the scene says about intervals, and keeps the reason for summary(). Collective.
  void record_failure(const std::string& reason);
  /// Whether there is a state: before run() has set one up there is nothing to be saved.
  [[nodiscard]] bool has_state() const { return !state_.results.time.empty(); }
  /// What run() was interrupted by, if it was.
  [[nodiscard]] const std::optional<Interruption>& interruption() const { return interruption_; }
  /// "finished", "stopped" (as the options say), "interrupted" or "failed".
  [[nodiscard]] std::string status() const;

  [[nodiscard]] Problem& problem() { return problem_; }
  [[nodiscard]] const Timings& timings() const { return timings_; }
  [[nodiscard]] long step_number() const { return state_.step_number; }
  /// Of the last good state.
  [[nodiscard]] double time() const { return state_.time; }
  /// Length of the last step that was taken, s; 0 when there is none.
  [[nodiscard]] double last_step() const;
  /// To take single steps from the last good state without a record of them.
  [[nodiscard]] TimeStep& time_step() { return *step_; }
  [[nodiscard]] long long unknowns();
  /// The machine-readable record of the run: residual histories, times, memory, versions, checks.
  [[nodiscard]] nlohmann::json summary(const std::vector<CheckResult>& checks);

 private:
  class Setup;
  void build_fields(const Registry& registry);
  [[nodiscard]] std::vector<double> cell_costs(const std::string& mesh) const;
  void add_field(const std::string& name, const Parameters& parameters,
                 const std::shared_ptr<const Mesh>& mesh, const Registry& registry);
  void build_couplings(const Registry& registry);
  void start(const RunOptions& options);
  void check_output(ErrorList& errors);
  [[nodiscard]] std::filesystem::path choose_restart();
  void announce_start(bool resumed) const;
  void open_outputs(double resume_time);
  bool attend(const RunOptions& options);
  void note_step(double length);
  void note_end();
  void keep_state();
  bool try_step(double until);
  void append_row(const TimePoint& at);
  void write_outputs(const TimePoint& at);
  void write_fields(const TimePoint& at);
  [[nodiscard]] bool restart_due() const;
  void save_restart();
  void finish_timings();
  /// Errors of the present state, by name. Collective.
  std::map<std::string, double> measure_errors();
  void finish_results();
  void show_progress(const RunOptions& options, double seconds) const;

  const Scene& scene_;
  Communicator communicator_;
  std::map<std::string, std::shared_ptr<const MeshData>> meshes_;
  std::vector<std::pair<std::string, std::unique_ptr<Interface>>> interfaces_;
  Problem problem_;
  std::unique_ptr<LinearSolver> linear_;
  Stepper stepper_;
  std::unique_ptr<TimeStep> step_;
  RunState state_;
  std::vector<Probe> probes_;
  std::unique_ptr<FieldOutput> fields_;
  std::unique_ptr<CutOutput> cut_;
  std::unique_ptr<InterfaceOutput> points_;
  std::unique_ptr<ResultsFolder> own_folder_;  ///< when none was given
  ResultsFolder* folder_ = nullptr;
  std::optional<SeriesFile> series_;
  std::optional<EventFile> events_;
  std::vector<NewtonReport> reports_;  ///< of all steps, those that were rewound among them
  Stopwatch run_watch_, restart_watch_;
  bool names_checked_ = false;
  double assembly_seconds_ = 0;  ///< of the first system with its tangent
  Timings timings_;
  TimePoint last_point_;   ///< of the last good state
  long last_fields_ = -1;  ///< step number of the fields written last
  long last_restart_ = -1;
  Diagnostics warnings_;
  std::string resolved_checksum_;  ///< on rank 0; files as they were at the start
  std::string failure_;            ///< why the run ended early, "" if it did not
  std::optional<Interruption> interruption_;
};

/// Reads and distributes the meshes a scene names. Exposed for `seam check`.
std::map<std::string, std::shared_ptr<const MeshData>> load_meshes(const Scene& scene);
/// The names they carry, for check_mesh_names.
std::map<std::string, MeshNames> mesh_names(
    const std::map<std::string, std::shared_ptr<const MeshData>>& meshes);

}  // namespace seam
