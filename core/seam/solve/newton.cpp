// SPDX-License-Identifier: BSD-3-Clause
#include "seam/solve/newton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "seam/base/stopwatch.hpp"

namespace seam {
namespace {

constexpr double rounding = 1e-13;  ///< relative residual that cannot be lowered
/// Part of a value that counts as its change in the step: in a steady state increments are noise.
constexpr double steady_part = 1e-6;
/// Iterations in which unknowns may come and go; then they may only come, lest a step cycle between two sets
/// of them (thesis 6.3.2).
constexpr int free_iterations = 3;

/// What is left to add after an increment that was so much smaller than the one before it: the rest of a
/// geometric series, which overestimates Newton's method where that converges.
double remainder(double increment, double before) {
  const double contraction = before > 0 ? increment / before : 1;
  return contraction < 0.5 ? increment * contraction / (1 - contraction) : increment;
}

}  // namespace

/// Sizes of the residual and of the last increment, each for the unknown where it is largest.
Newton::Size Newton::measure(const std::vector<double>& increment, double factor) const {
  Size size;
  Assembler& assembler = problem_.assembler();
  for (const FieldEntry& entry : problem_.fields())
    for (const Unknown& unknown : entry.field->unknowns()) {
      const Field::Place place = entry.field->place(unknown.name);
      const Block& block = entry.field->blocks()[place.block];
      std::vector<double> sums(4, 0.0);  // squares of residual, magnitude, increment, change in the step
      for (int node = 0; node < block.space->owned_nodes(); ++node) {
        const int row = assembler.row(*entry.field, place.block, node, place.offset);
        if (row < 0) continue;
        for (int c = 0; c < place.components; ++c) {
          const std::size_t i = static_cast<std::size_t>(node) * block.size + place.offset + c;
          sums[0] += std::pow(assembler.residual()[row + c], 2);
          sums[1] += std::pow(assembler.magnitude()[row + c], 2);
          if (!increment.empty()) sums[2] += std::pow(factor * increment[row + c], 2);
          const double change = std::abs(block.now.value[i] - block.old.value[i]);
          sums[3] += std::pow(change + steady_part * std::abs(block.now.value[i]), 2);
        }
      }
      problem_.communicator().sum(sums);
      const std::string name = entry.name + "." + unknown.name;
      if (!std::isfinite(sums[0])) return {sums[0], name, size.increment};
      // Without any contribution the unknown's equations hold.
      const double relative = sums[1] > 0 ? std::sqrt(sums[0] / sums[1]) : 0.0;
      if (size.worst.empty() || relative > size.residual) size = {relative, name, size.increment};
      // At the rounding error of its equations an unknown's increments are noise.
      if (relative > rounding && sums[3] > 0)
        size.increment = std::max(size.increment, std::sqrt(sums[2] / sums[3]));
    }
  return size;
}

bool Newton::cycles(const std::vector<NewtonIteration>& history) const {
  const std::size_t patience = freezes_ == 0 ? 3 : 1;  // iterations without progress against those two before
  if (history.size() < freed_ + (freezes_ == 0 ? free_iterations : 0) + patience + 3) return false;
  for (std::size_t k = history.size() - patience; k < history.size(); ++k)
    if (history[k].space_changed || history[k].residual < 0.8 * history[k - 2].residual) return false;
  return true;
}

void Newton::freeze(TimePoint& at, bool frozen, std::size_t iteration) {
  at.frozen = frozen_ = frozen;
  if (frozen) {
    ++freezes_;
    since_freezing_ = 0;
  } else {
    freed_ = iteration;
  }
}

double Newton::distance(const std::vector<double>& increment, double factor) const {
  double most = 0;
  for (const FieldEntry& entry : problem_.fields())
    for (const Unknown& unknown : entry.field->unknowns()) {
      if (unknown.unit != "m") continue;
      const Field::Place place = entry.field->place(unknown.name);
      const Block& block = entry.field->blocks()[place.block];
      for (int node = 0; node < block.space->owned_nodes(); ++node)
        for (int c = 0; c < place.components; ++c)
          if (const int row = problem_.assembler().row(*entry.field, place.block, node, place.offset + c);
              row >= 0)
            most = std::max(most, std::abs(factor * increment[row]));
    }
  return problem_.communicator().max(most);
}

NewtonReport Newton::solve(const TimePoint& step) {
  NewtonReport report;
  TimePoint at = step;
  frozen_ = false;
  freezes_ = 0;
  freed_ = 0;
  double far = std::numeric_limits<double>::infinity();  // m, for bodies on a frozen cut
  std::vector<double> increment;
  Size size;
  bool starts = true;  // at states without an increment that led there
  for (int iteration = 0;; ++iteration) {
    NewtonIteration& entry = report.history.emplace_back();
    if (starts) {
      entry.space_changed = problem_.update_spaces(at) == SpaceChange::unknowns;
      problem_.assembler().assemble(at, true);
      increment.clear();
      starts = false;
    } else if (!take(at, increment, size, entry)) {
      report.reason =
          fmt::format("no part of the increment of iteration {} leads to an admissible state", iteration);
      return report;
    }
    if (frozen_ && !increment.empty()) since_freezing_ += distance(increment, entry.damping);
    // After a renumbering the increment's rows mean nothing any more.
    if (entry.space_changed) increment.clear();
    const Size last = size;
    size = measure(increment, entry.damping);
    entry.residual = size.residual;
    entry.worst = size.worst;
    entry.increment = size.increment;
    if (!std::isfinite(size.residual)) {
      report.reason = fmt::format("the residual of {} is not finite at the start of the step", size.worst);
      return report;
    }
    // A residual that was small and does not fall any more is at rounding error: so are the increments.
    const bool at_rounding =
        size.residual <= rounding || (iteration > 0 && last.residual <= options_.tolerance &&
                                      !entry.space_changed && size.residual > 0.5 * last.residual);
    const bool settled =
        at_rounding || remainder(size.increment, last.increment) <= options_.increment_tolerance;
    if (size.residual <= options_.tolerance && settled && !entry.space_changed &&
        !problem_.assembler().prescribed_pending()) {
      if (frozen_ && freezes_ == 1 && iteration < options_.maximum_iterations) {
        freeze(at, false, report.history.size());
        starts = true;
        continue;
      }
      report.converged = !frozen_ || since_freezing_ <= far;
      report.frozen = frozen_;
      if (!report.converged)
        report.reason = fmt::format(
            "iterations cycle, and without an update of the cut bodies go on by {:.2g} m, more than {:.2g} m",
            since_freezing_, far);
      return report;
    }
    if (iteration == options_.maximum_iterations) {
      report.reason =
          fmt::format("not converged after {} iterations: relative residual {:.2e} of {}, tolerance {:.0e}",
                      iteration, size.residual, size.worst, options_.tolerance);
      return report;
    }
    if (iteration >= free_iterations) problem_.hold_spaces();
    if (!frozen_ && problem_.is_cut() && cycles(report.history)) {
      far = 0.01 * problem_.smallest_cut_cell();
      freeze(at, true, report.history.size());
      problem_.assembler().assemble(at, true);
    }
    SolveReport linear;
    solve_linear(increment, linear);
    entry.linear_iterations = linear.iterations;
    entry.linear_residual = linear.relative_residual;
    report.linear_seconds += linear.setup_seconds + linear.solve_seconds;
  }
}

/// Adds the increment, or a part of it, lets spaces follow and assembles there. False when no part is
/// admissible.
bool Newton::take(const TimePoint& at, const std::vector<double>& increment, const Size& size_before,
                  NewtonIteration& entry) {
  constexpr double blow_up = 1e4;
  const Problem::Snapshot before = problem_.snapshot();
  for (entry.damping = 1; entry.damping > 1e-3; entry.damping /= 2) {
    problem_.assembler().add_increment(increment, entry.damping);
    problem_.update_rates(at);
    if (follow(at, entry)) {
      problem_.assembler().assemble(at, true);
      const double size = measure({}, 0).residual;
      const bool much_larger =
          size_before.residual > 0 && size > blow_up * size_before.residual && size > 1e-3;
      if (std::isfinite(size) && !(options_.damping && much_larger && entry.damping > 0.1)) return true;
    }
    if (!options_.damping) return false;
    problem_.restore(before);
    if (!frozen_) problem_.update_spaces(at);  // and with them the numbering that the increment has
  }
  return false;
}

/// Lets spaces follow the state. False when bodies moved too far for that; a part of the way may do.
bool Newton::follow(const TimePoint& at, NewtonIteration& entry) {
  if (frozen_) return true;
  try {
    entry.space_changed = problem_.update_spaces(at) == SpaceChange::unknowns;
    return true;
  } catch (const StepRefused&) {
    if (!options_.damping) throw;
    return false;
  }
}

void Newton::solve_linear(std::vector<double>& increment, SolveReport& report) {
  Assembler& assembler = problem_.assembler();
  try {
    report =
        solver_.solve(assembler.matrix(), assembler.equation_blocks(), assembler.right_side(), increment);
  } catch (const SingularMatrix& singular) {
    const std::string who = describe_unsupported(problem_, singular.equations);
    if (who.empty()) throw;
    throw SingularMatrix(std::string(singular.what()) + "\n" + who, singular.equations);
  }
}

void Newton::solve_initial_rates(double time) {
  TimePoint at = time_point(time, 0, 1);
  at.initial_rates = true;
  problem_.update_spaces(at);
  problem_.assembler().assemble(at, true);
  std::vector<double> increment;
  SolveReport report;
  solve_linear(increment, report);
  problem_.add_initial_rates(increment);
}

}  // namespace seam
