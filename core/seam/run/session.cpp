// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "seam/assembly/assembler.hpp"
#include "seam/base/stopwatch.hpp"
#include "seam/record/derived.hpp"
#include "seam/run/constraint_doubts.hpp"
#include "seam/run/contact_doubts.hpp"
#include "seam/run/scene_doubts.hpp"

namespace seam {
namespace {

/// Of this process: beside others it is what the work takes, not the clock.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

Session::Session(const Scene& scene, const Registry& registry, const Communicator& communicator)
    : scene_(scene), stepper_(scene), warnings_(scene.warnings) {
  const Stopwatch watch;
  built_ = build_scene(scene, registry, communicator, stepper_.start());
  const Parameters& solver = scene.root.object("solver");
  const Parameters& newton = solver.object("newton");
  problem().finish(stepper_.start(), newton.boolean("shape_derivatives"));
  linear_ = registry.create<LinearSolver>("linear_solver", solver.object("linear"));
  step_ = std::make_unique<TimeStep>(
      problem(), *linear_,
      NewtonOptions{newton.number("tolerance"), newton.number("increment_tolerance"),
                    static_cast<int>(newton.integer("maximum_iterations")), newton.boolean("damping")},
      stepper_);
  observables_ = std::make_unique<Observables>(scene, problem());
  setup_seconds_ = watch.seconds();
}

void Session::prepare() {
  state_.time = stepper_.start();
  state_.step = stepper_.initial();
  problem().initialise(stepper_.start(), !stepper_.is_static());
  at_ = time_point(stepper_.start(), 0, stepper_.theta());
  problem().update_spaces(at_);
  step_->start();
  problem().assembler().assemble(at_, false);
  state_.results.append(observe(at_));
  static_cast<void>(observables_->errors(state_.time));
}

void Session::continue_from(const std::filesystem::path& restart_point) {
  state_ = read_restart(restart_point, problem());
  at_ = time_point(state_.time, 0, stepper_.theta());
  problem().update_spaces(at_);
}

void Session::require_held() {
  const double step = stepper_.is_static() ? 0 : stepper_.initial();
  const double before = processor_seconds();
  problem().assembler().assemble(time_point(stepper_.start(), step, stepper_.theta()), true);
  assembly_seconds_ = processor_seconds() - before;
  const FreeModes free = describe_free_modes(problem(), no_resistance);
  // A body that is balanced shows in how far it would turn. What has no natural size is not looked at so, and
  // an iteration costs more than all the rest of a check.
  const bool may_balance =
      stepper_.is_static() && std::ranges::any_of(problem().fields(), [](const FieldEntry& entry) {
        return std::ranges::any_of(entry.field->unknowns(), [](const Unknown& u) { return u.scale > 0; });
      });
  if (!free.text.empty() || may_balance) require_first_iteration(free);
  problem().check_levels();
}

/// Loads that are not there yet at the start may hold what turns about a hinge, and a body on which nothing
/// acts need not be held: a run begins with the loads at the end of its first step.
/// @param free what changes without resistance at the start @throws Error with that where a run ends there
void Session::require_first_iteration(const FreeModes& free) {
  try {
    step_->begin(state_.time, stepper_.target(state_.time, state_.step), 0);
    const bool stands = !step_->iterate() && step_->report().converged;
    step_->rewind();
    problem().update_spaces(at_);
    if (!stands || free.text.empty()) return;
    if (free.of_bodies) {
      warnings_.warning(scene_.root.where("fields"),
                        "nothing acts in the first step on what is not held, so that it goes through: " +
                            free.text.substr(0, free.text.find_last_not_of('\n') + 1));
      return;
    }
  } catch (const StepRefused&) {
    // Where bodies would move too far; told below.
    if (free.text.empty()) {
      step_->rewind();
      problem().update_spaces(at_);
      return;  // a run tries shorter steps
    }
  } catch (const SingularMatrix&) {
    if (free.text.empty()) throw;
    // The same is told below, as it is at the start.
  }
  throw Error(scene_.root.where("fields"), free.text);
}

void Session::find_conflicts() {
  const std::vector<Diagnostic> at_start = problem().find_conflicts(stepper_.start());
  std::vector<Diagnostic> conflicts = at_start;
  for (Diagnostic& later : problem().find_conflicts(stepper_.end()))
    if (std::ranges::none_of(at_start,
                             [&](const Diagnostic& d) { return d.where.text() == later.where.text(); }))
      conflicts.push_back(std::move(later));
  const SceneAtStart scene{scene_,           built_,         state_.results,
                           stepper_.start(), stepper_.end(), stepper_.initial()};
  for (const auto& find : {scene_doubts, constraint_doubts, contact_doubts})
    for (Diagnostic& doubt : find(scene)) conflicts.push_back(std::move(doubt));
  for (Diagnostic& conflict : conflicts)
    warnings_.warning(std::move(conflict.where), std::move(conflict.message));
}

double Session::last_step() const {
  const std::vector<double>& times = state_.results.time;
  return times.size() > 1 ? times.back() - times[times.size() - 2] : 0;
}

Results Session::observe(const TimePoint& at) {
  const Stopwatch watch;
  Results row = observables_->row(at);
  observing_seconds_ += watch.seconds();
  return row;
}

/// Newton's method, on what `begin` begins. What is refused is reported as what does not converge.
/// @param is_start whether its first matrix is that of the state which the scene starts from
template <class Begin>
NewtonReport Session::solve(bool is_start, const Begin& begin) {
  std::string refused;
  try {
    begin();
    while (step_->iterate()) continue;
  } catch (const StepRefused& refusal) {
    refused = refusal.what();
  } catch (const SingularMatrix& singular) {
    refused = singular.what();
    // Where the run starts it is the scene that leaves something unheld. What has been held so far is lost on
    // a state that iterations went astray to, as where a body snaps through.
    if (is_start && step_->report().iterations() == 0) {
      if (dynamic_cast<const NothingHolds*>(&singular) == nullptr) throw;
      const Diagnostic place{Diagnostic::Severity::error, scene_.root.where("fields"), singular.what()};
      throw NothingHolds(place.text(), singular.equations);
    }
  }
  NewtonReport report = step_->report();
  linear_seconds_ += report.linear_seconds;
  if (refused.empty()) return report;
  report.converged = false;
  report.reason = refused;
  return report;
}

/// To the end of a step. @return whether it converged, and accurately enough
bool Session::iterate(double until) {
  reports_.push_back(solve(state_.step_number == 0, [&] { step_->begin(state_.time, until, last_step()); }));
  NewtonReport& report = reports_.back();
  // No shorter step would have less to bear.
  if (!report.converged && stepper_.is_static() && !stepper_.depends_on_time()) raise_load(until, report);
  if (report.converged && stepper_.too_inaccurate(step_->error(), until - state_.time)) {
    report.converged = false;
    report.reason = fmt::format("its error in time is {:.1e}", step_->error());
  }
  return report.converged;
}

/// Reaches a static state by shares of what acts, each as much more as Newton's method takes.
/// @param report of the attempt with all of it at once; what is done here is added
void Session::raise_load(double until, NewtonReport& report) {
  constexpr double least = 1.0 / 1024;
  constexpr int few_iterations = 6;
  step_->rewind();
  step_->begin(state_.time, until, last_step());
  LoadShare load(problem(), step_->at());
  double share = 0;
  for (double more = 0.5; share < 1 && more >= least;) {
    const StateStore::Snapshot reached = problem().state().snapshot(state_.time);
    const double next = std::min(1.0, share + more);
    const NewtonReport part = solve(false, [&] { step_->begin_share(load, next); });
    report.add(part);
    if (part.converged) {
      share = next;
      if (part.iterations() <= few_iterations) more *= 2;
    } else {
      problem().state().restore(reached);
      linear_->forget();
      more /= 2;
    }
  }
  report.converged = share == 1;
  if (!report.converged)
    report.reason += fmt::format("; nor raised little by little, beyond {:.3g} % of what acts", 100 * share);
}

bool Session::step(double until) {
  try {
    if (!iterate(until)) {
      step_->rewind();
      ++state_.rejected_steps;
      return false;
    }
    // A row that cannot be had undoes the step, too: what is recorded is a table.
    state_.results.append(observe(step_->at()));
  } catch (...) {
    step_->rewind();
    throw;
  }
  step_->accept();
  at_ = step_->at();
  state_.time = until;
  ++state_.step_number;
  state_.iterations.push_back(reports_.back().iterations());
  return true;
}

void Session::finish_results() {
  for (const auto& [name, error] : observables_->errors(state_.time)) state_.results.once[name] = error;
  finish_statistics(scene_, state_.results);
  int most_linear = 0, frozen = 0;
  for (const NewtonReport& report : reports_) {
    if (report.frozen && report.converged) ++frozen;
    for (const NewtonIteration& iteration : report.history)
      most_linear = std::max(most_linear, iteration.linear_iterations);
  }
  std::vector<int> iterations = state_.iterations;
  std::sort(iterations.begin(), iterations.end());
  std::map<std::string, double>& once = state_.results.once;
  once["newton.iterations.median"] = iterations.empty() ? 0 : iterations[iterations.size() / 2];
  once["newton.iterations.most"] = iterations.empty() ? 0 : iterations.back();
  once["steps.taken"] = static_cast<double>(state_.iterations.size());
  once["steps.rejected"] = static_cast<double>(state_.rejected_steps);
  once["newton.frozen_steps"] = frozen;
  once["linear.iterations.most"] = most_linear;
  once["unknowns"] = static_cast<double>(unknowns());
}

long long Session::unknowns() { return problem().assembler().matrix().global_rows; }

}  // namespace seam
