// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/time_step.hpp"

#include <utility>

#include "seam/field/field.hpp"
#include "seam/run/time_error.hpp"

namespace seam {
namespace {

StateArray<double>& add_largest(Problem& problem) {
  std::size_t unknowns = 0;
  for (const FieldEntry& entry : problem.fields()) unknowns += entry.field->unknowns().size();
  return problem.state().add<double>(
      {"largest of each unknown", the_run(problem.communicator()), static_cast<int>(unknowns)});
}

}  // namespace

TimeStep::TimeStep(Problem& problem, LinearSolver& solver, const NewtonOptions& options,
                   const Stepper& stepper)
    : problem_(problem),
      solver_(solver),
      newton_(problem, solver, options),
      stepper_(stepper),
      largest_(add_largest(problem)) {
  if (stepper.two_steps()) problem.keep_mean_rates();
  fresh_rates_ = !stepper.is_static() && problem.needs_fresh_rates(stepper.theta());
}

void TimeStep::start() {
  if (!stepper_.is_static() && problem_.needs_initial_rates(stepper_.theta()))
    newton_.solve_initial_rates(stepper_.start());
}

TimePoint TimeStep::point_of(double from, double until, double previous) const {
  const double step = stepper_.is_static() ? 0 : until - from;
  double theta = stepper_.theta();
  if (stepper_.two_steps())
    theta = two_step_theta(step, previous);
  else if (previous == 0 && problem_.constrains_rates())
    theta = 1;
  return time_point(until, step, theta);
}

void TimeStep::begin(double from, double until, double previous) {
  before_ = problem_.state().snapshot(from);
  error_ = 0;
  at_ = point_of(from, until, previous);
  if (fresh_rates_) newton_.solve_initial_rates(from);
  problem_.begin_step(at_, from);
  newton_.begin(at_);
}

bool TimeStep::iterate() {
  if (newton_.iterate()) return true;
  if (newton_.report().converged) problem_.check_levels();
  if (newton_.report().converged && stepper_.adaptive() && !stepper_.is_static())
    error_ = time_error(problem_, at_.step, largest_.now());
  return false;
}

void TimeStep::begin_share(LoadShare& load, double share) {
  load.set(share);
  newton_.begin(at_);
}

void TimeStep::accept() { before_ = {}; }

void TimeStep::rewind() {
  problem_.state().restore(before_);
  solver_.forget();
}

}  // namespace seam
