// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/run/stepper.hpp"
#include "seam/solve/load_share.hpp"
#include "seam/solve/newton.hpp"

namespace seam {

/// Takes a problem from one time to the next: a step is begun, iterated, and then accepted or rewound. What
/// is rewound leaves no trace: the step taken again is the same to the bit where linear systems are solved
/// directly and anew, and to the linear solver's tolerance where factors or preconditioners are kept, since
/// these are dropped.
class TimeStep {
 public:
  TimeStep(Problem& problem, LinearSolver& solver, const NewtonOptions& options, const Stepper& stepper);

  /// Solves for the rates that the states at the start of the run imply, where the scheme needs them.
  void start();
  /// Begins a step from the problem's present states.
  /// @param from, until s
  /// @param previous length of the step before, s; 0 when there is none
  void begin(double from, double until, double previous);
  /// Takes an iteration of Newton's method.
  /// @return true while there is something left to do; then report() says how it went
  /// @throws StepRefused, SingularMatrix; the step is to be rewound then, too
  /// @throws Error where what has converged is no solution, see Problem::check_levels()
  bool iterate();
  [[nodiscard]] const NewtonReport& report() const { return newton_.report(); }
  /// Relative error in time of a step that has converged; 0 where it is not estimated.
  [[nodiscard]] double error() const { return error_; }
  [[nodiscard]] const TimePoint& at() const { return at_; }
  /// Takes a static step that has just been begun with a part of what acts, see LoadShare.
  void begin_share(LoadShare& load, double share);
  /// The states at the end of the step are the present ones from now on.
  void accept();
  /// Everything is as it was before begin().
  void rewind();

 private:
  [[nodiscard]] TimePoint point_of(double from, double until, double previous) const;
  Problem& problem_;
  LinearSolver& solver_;
  Newton newton_;
  const Stepper& stepper_;
  bool fresh_rates_ = false;  ///< rates follow from the balance at the start of each step
  TimePoint at_;
  double error_ = 0;
  StateArray<double>& largest_;  ///< sizes of the states so far that errors are relative to, see time_error()
  StateStore::Snapshot before_;
};

}  // namespace seam
