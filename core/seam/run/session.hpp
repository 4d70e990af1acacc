// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "seam/linear/linear_solver.hpp"
#include "seam/record/observables.hpp"
#include "seam/record/restart.hpp"
#include "seam/run/cost_estimate.hpp"
#include "seam/run/scene_builder.hpp"
#include "seam/run/stepper.hpp"
#include "seam/run/time_step.hpp"

namespace seam {

/// A scene brought to life: built, with a state that is taken from step to step by whoever drives it. Nothing
/// of it is on disk. What a step that fails leaves is what was there before it. All calls are collective.
class Session {
 public:
  /// Builds meshes, fields and couplings.
  /// @throws Error with places in the scene
  Session(const Scene& scene, const Registry& registry, const Communicator& communicator);

  /// Sets up the state at the start, observes it once, and finds whatever the scene names.
  /// @throws Error with places in the scene
  void prepare();
  /// Takes the state of a restart point instead. @throws Error when it is damaged or of another scene
  void continue_from(const std::filesystem::path& restart_point);
  /// After prepare().
  /// @throws Error naming the fields that can change without resistance
  void require_held();
  /// What a step will cost. After require_held().
  [[nodiscard]] CostEstimate estimate() { return estimate_cost(problem(), *linear_, assembly_seconds_); }
  /// Adds what only the built problem shows to warnings().
  void find_conflicts();
  /// Of what is legal but hardly meant.
  [[nodiscard]] const Diagnostics& warnings() const { return warnings_; }

  /// Tries a step to this time.
  /// @return whether it was taken; report() says how it went
  /// @throws Error where a shorter one would be no better: NothingHolds where the scene is to blame
  bool step(double until);
  /// Whether nothing is left to do.
  [[nodiscard]] bool finished() const { return stepper_.finished(state_.time); }
  /// Adds what is known at the end only to the results.
  void finish_results();

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] Problem& problem() { return *built_.problem; }
  [[nodiscard]] const Stepper& stepper() const { return stepper_; }
  /// The last good state.
  [[nodiscard]] const RunState& state() const { return state_; }
  /// Of the last good state.
  [[nodiscard]] const TimePoint& at() const { return at_; }
  /// What has been recorded so far.
  [[nodiscard]] const Results& results() const { return state_.results; }
  /// Plans the length of the step to try next, s. @param refusals on the way to the last good state
  void plan(double step, const Refusals& refusals = {}) {
    state_.step = step;
    state_.refusals = refusals;
  }
  /// Length of the last step that was taken, s; 0 when there is none.
  [[nodiscard]] double last_step() const;
  /// Of all steps tried in this process, those that were rewound among them.
  [[nodiscard]] const std::vector<NewtonReport>& reports() const { return reports_; }
  /// Relative error in time of the last step; 0 where it is not estimated.
  [[nodiscard]] double time_error() const { return step_->error(); }
  /// To take single steps from the last good state without a record of them.
  [[nodiscard]] TimeStep& time_step() { return *step_; }
  [[nodiscard]] long long unknowns();
  /// Spent in building, in linear solves and in observing, s.
  [[nodiscard]] double setup_seconds() const { return setup_seconds_; }
  [[nodiscard]] double linear_seconds() const { return linear_seconds_; }
  /// See LinearSolver.
  [[nodiscard]] std::string linear_choice() const { return linear_->choice(); }
  [[nodiscard]] double observing_seconds() const { return observing_seconds_; }

 private:
  template <class Begin>
  NewtonReport solve(bool is_start, const Begin& begin);
  bool iterate(double until);
  void raise_load(double until, NewtonReport& report);
  void require_first_iteration(const FreeModes& free);
  [[nodiscard]] Results observe(const TimePoint& at);
  const Scene& scene_;
  Stepper stepper_;
  BuiltScene built_;
  std::unique_ptr<LinearSolver> linear_;
  std::unique_ptr<TimeStep> step_;
  std::unique_ptr<Observables> observables_;
  RunState state_;
  TimePoint at_;
  std::vector<NewtonReport> reports_;
  Diagnostics warnings_;
  double assembly_seconds_ = 0;  ///< of the first system with its tangent
  double setup_seconds_ = 0, linear_seconds_ = 0, observing_seconds_ = 0;
};

}  // namespace seam
