// SPDX-License-Identifier: BSD-3-Clause
#include "seam/solve/newton.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "seam/assembly/assembler.hpp"
#include "seam/assembly/steady_part.hpp"
#include "seam/base/stopwatch.hpp"
#include "seam/field/field.hpp"
#include "seam/solve/unsettled.hpp"

namespace seam {
namespace {

constexpr double rounding_error = 1e-13;  ///< relative residual that cannot be lowered
/// In rounding errors of the residual: forces below that are none. A strain of 1e-10 has larger ones.
constexpr double nothing_acts = 1e6;
/// Relative residual that may be one of rounding where others act, and where it has not fallen for several
/// iterations.
constexpr double hardly_more = 1e-10, stuck_at_most = 1e-6;
constexpr int several = 3;
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
Newton::Size Newton::measure(const std::vector<double>& increment, double factor,
                             const std::vector<double>& rounding) const {
  Size size;
  size.at_rounding = true;
  Assembler& assembler = problem_.assembler();
  if (!assembler.is_finite()) {
    size.residual = std::numeric_limits<double>::quiet_NaN();
    return size;
  }
  for (const FieldEntry& entry : problem_.fields())
    for (const Unknown& unknown : entry.field->unknowns()) {
      const Field::ComponentRange place = entry.field->place(unknown.name);
      const Block& block = entry.field->blocks()[place.block];
      // Squares of residual, magnitude, increment, change in the step, rounding.
      std::vector<double> sums(5, 0.0);
      for (int node = 0; node < block.space->owned_nodes(); ++node) {
        const int row = assembler.row(*entry.field, place.block, node, place.offset);
        if (row < 0) continue;
        for (int c = 0; c < place.components; ++c) {
          const std::size_t i = static_cast<std::size_t>(node) * block.size + place.offset + c;
          sums[0] += std::pow(assembler.residual()[row + c], 2);
          sums[1] += std::pow(assembler.magnitude()[row + c], 2);
          if (!increment.empty()) sums[2] += std::pow(factor * increment[row + c], 2);
          const double change = std::abs(block.now.value[i] - block.old.value[i]);
          const double least = steady_part * std::max(std::abs(block.now.value[i]), unknown.scale);
          sums[3] += std::pow(change + least, 2);
          if (!rounding.empty()) sums[4] += std::pow(rounding[row + c], 2);
        }
      }
      problem_.communicator().sum(sums);
      // Where something acts, its forces are the scale; but iterations get no further than rounding.
      const double residual = std::sqrt(sums[0]), rounded = std::sqrt(sums[4]), forces = std::sqrt(sums[1]);
      const bool may_be_rounding =
          forces < nothing_acts * rounded ||
          (!starts_ && residual < (stuck_ >= several ? stuck_at_most : hardly_more) * forces);
      const double noise = may_be_rounding ? rounded : 0,
                   scale = std::max(forces, noise / options_.tolerance);
      // Without any contribution the unknown's equations hold.
      const double relative = scale > 0 ? residual / scale : 0.0;
      if (size.worst.empty() || relative > size.residual) {
        size.residual = relative;
        size.worst = entry.name + "." + unknown.name;
      }
      // At the rounding error of its equations an unknown's increments are noise.
      if (relative <= rounding_error || (noise > 0 && residual <= noise)) continue;
      size.at_rounding = false;
      if (sums[3] > 0) size.increment = std::max(size.increment, std::sqrt(sums[2] / sums[3]));
    }
  return size;
}

/// Measures the present state. What nothing acts on does not move, and has a residual of rounding errors that
/// no force beside it makes look small: these errors are estimated.
Newton::Size Newton::measure_with_rounding(const NewtonIteration& entry) {
  Size size = measure(increment_, entry.damping);
  const bool stays = starts_ || size.residual > 0.5 * size_.residual;
  stuck_ = stays && !starts_ ? stuck_ + 1 : 0;
  if (!std::isfinite(size.residual) || size.residual <= options_.tolerance || !stays) return size;
  return measure(increment_, entry.damping, problem_.assembler().rounding());
}

bool Newton::cycles() const {
  const std::vector<NewtonIteration>& history = report_.history;
  const std::size_t patience = freezes_ == 0 ? 3 : 1;  // iterations without progress against those two before
  if (history.size() < freed_ + (freezes_ == 0 ? free_iterations : 0) + patience + 3) return false;
  for (std::size_t k = history.size() - patience; k < history.size(); ++k)
    if (history[k].space_changed || history[k].residual < 0.8 * history[k - 2].residual) return false;
  return true;
}

void Newton::freeze(bool frozen) {
  at_.frozen = frozen_ = frozen;
  if (frozen) {
    ++freezes_;
    frozen_at_ = motions();
  } else {
    freed_ = report_.history.size();
  }
}

/// What moves bodies, of this rank's own nodes, whether it follows from others or not.
std::vector<double> Newton::motions() const {
  std::vector<double> result;
  for (const FieldEntry& entry : problem_.fields())
    for (const Unknown& unknown : entry.field->unknowns()) {
      if (unknown.role != UnknownRole::motion) continue;
      const Field::ComponentRange place = entry.field->place(unknown.name);
      const Block& block = entry.field->blocks()[place.block];
      for (int node = 0; node < block.space->owned_nodes(); ++node)
        for (int c = 0; c < place.components; ++c)
          result.push_back(block.now.value[static_cast<std::size_t>(node) * block.size + place.offset + c]);
    }
  return result;
}

/// How far anything has moved, m. Collective.
double Newton::way_since_freezing() const {
  const std::vector<double> now = motions();
  double longest = 0;
  for (std::size_t i = 0; i < now.size(); ++i) longest = std::max(longest, std::abs(now[i] - frozen_at_[i]));
  return problem_.communicator().max(longest);
}

void NewtonReport::add(const NewtonReport& share) {
  converged = share.converged;
  frozen = share.frozen;
  history.insert(history.end(), share.history.begin(), share.history.end());
  linear_seconds += share.linear_seconds;
  ++shares;
}

void Newton::begin(const TimePoint& step) {
  at_ = step;
  report_ = {};
  increment_.clear();
  size_ = {};
  iteration_ = 0;
  starts_ = true;
  stuck_ = 0;
  shortened_ = 0;
  frozen_ = false;
  freezes_ = 0;
  freed_ = 0;
  refused_.clear();
  far_ = std::numeric_limits<double>::infinity();
}

NewtonReport Newton::solve(const TimePoint& step) {
  begin(step);
  while (iterate()) continue;
  return report_;
}

/// What bodies did that increments were shortened for: it tells more than numbers of the iteration.
std::string Newton::refusal() const {
  return refused_.empty() ? "" : "; what increments were shortened for, last: " + refused_;
}

bool Newton::fail(std::string reason) {
  report_.reason = std::move(reason);
  return false;
}

bool Newton::iterate() {
  NewtonIteration& entry = report_.history.emplace_back();
  const bool starts = starts_;
  if (starts) {
    entry.space_changed = problem_.update_spaces(at_) == SpaceChange::unknowns;
    problem_.assembler().assemble(at_, true);
    increment_.clear();
  } else if (!take(entry)) {
    return fail(fmt::format("no part of the increment of iteration {} leads to an admissible state{}{}",
                            iteration_, not_finite_, refusal()));
  }
  // After a renumbering the increment's rows mean nothing any more.
  if (entry.space_changed) increment_.clear();
  const Size last = size_;
  size_ = measure_with_rounding(entry);
  starts_ = false;
  entry.residual = size_.residual;
  entry.worst = size_.worst;
  entry.increment = size_.increment;
  if (!std::isfinite(size_.residual))
    return fail("something is not finite at the start of the step:" +
                problem_.assembler().describe_not_finite(at_));
  if (converged(entry, last)) return finish();
  if (iteration_ == options_.maximum_iterations) {
    // Where all but a relation is met, numbers of what is met would tell nothing.
    const std::string pending = size_.residual <= options_.tolerance &&
                                        size_.increment <= options_.increment_tolerance &&
                                        problem_.assembler().prescribed_pending()
                                    ? describe_pending(problem_, at_)
                                    : "";
    if (!pending.empty())
      return fail(
          fmt::format("not converged after {} iterations: forces are in balance, but {}; what it is "
                      "tied to may be out of its reach{}",
                      iteration_, pending, refusal()));
    return fail(fmt::format(
        "not converged after {} iterations: relative residual {:.2e} of {}{} (tolerance {:.0e}), relative "
        "increment {:.2e} (tolerance {:.0e}){}",
        iteration_, size_.residual, size_.worst, describe_largest_residual(problem_, size_.worst),
        options_.tolerance, size_.increment, options_.increment_tolerance, refusal()));
  }
  if (iteration_ >= free_iterations) problem_.hold_spaces();
  if (!frozen_ && problem_.is_cut() && cycles()) {
    far_ = 0.01 * problem_.smallest_cut_cell();
    freeze(true);
    problem_.assembler().assemble(at_, true);
  }
  SolveReport linear;
  solve_linear(increment_, linear);
  require_sense(increment_);
  entry.linear_iterations = linear.iterations;
  entry.linear_residual = linear.relative_residual;
  report_.linear_seconds += linear.setup_seconds + linear.solve_seconds;
  ++iteration_;
  return true;
}

bool Newton::converged(const NewtonIteration& entry, const Size& last) const {
  // A residual that was small and does not fall any more is at rounding error: so are the increments.
  const bool stalls = iteration_ > 0 && last.residual <= options_.tolerance && !entry.space_changed &&
                      size_.residual > 0.5 * last.residual;
  const bool settled = size_.at_rounding || stalls ||
                       remainder(size_.increment, last.increment) <= options_.increment_tolerance;
  return size_.residual <= options_.tolerance && settled && !entry.space_changed &&
         !problem_.assembler().prescribed_pending();
}

/// What has converged counts if the cut has followed it, or need not. @return true to go on
bool Newton::finish() {
  if (frozen_ && freezes_ == 1 && iteration_ < options_.maximum_iterations) {
    freeze(false);
    starts_ = true;
    ++iteration_;
    return true;
  }
  const double way = frozen_ ? way_since_freezing() : 0;
  report_.converged = !frozen_ || way <= far_;
  report_.frozen = frozen_;
  if (report_.converged) return false;
  return fail(fmt::format(
      "iterations cycle, and without an update of the cut bodies go on by {:.2g} m, more than {:.2g} m", way,
      far_));
}

/// Adds the increment, or a part of it, lets spaces follow and assembles there. False when no part is
/// admissible.
bool Newton::take(NewtonIteration& entry) {
  constexpr double blow_up = 1e4;
  constexpr double least = 1e-3;
  // After so many increments in a row that were shortened for a residual that would grow, one is taken whole:
  // where contact begins, and other laws take another branch, it grows once and is gone.
  constexpr int patience = 2;
  const StateStore::Snapshot before = problem_.iterate(at_);
  not_finite_.clear();
  for (entry.damping = 1; entry.damping > least; entry.damping /= 2) {
    if (follow(entry)) {
      problem_.assembler().assemble(at_, true);
      const double size = measure({}, 0).residual;
      // What was at rest has a residual of rounding errors: nothing to compare with. Nor is what has gone, as
      // a pressure of contact, beside nothing.
      const bool much_larger =
          !size_.at_rounding && size > blow_up * size_.residual && size > 1e-3 &&
          measure({}, 0, problem_.assembler().rounding()).residual > blow_up * size_.residual;
      const bool shortens = options_.damping && much_larger && entry.damping > 0.1 && shortened_ < patience;
      if (std::isfinite(size) && !shortens) {
        shortened_ = entry.damping < 1 ? shortened_ + 1 : 0;
        return true;
      }
      if (!std::isfinite(size) && (!options_.damping || entry.damping / 2 <= least))
        not_finite_ = ": there" + problem_.assembler().describe_not_finite(at_);
    }
    if (!options_.damping) return false;
    problem_.state().restore(before);
    // And with them the numbering that the increment has.
    if (frozen_)
      problem_.update_relations(at_);
    else
      problem_.update_spaces(at_);
  }
  return false;
}

/// Adds a part of the increment and lets spaces follow. False when bodies moved too far for that; a smaller
/// part of the way may do.
bool Newton::follow(NewtonIteration& entry) {
  try {
    problem_.add_increment(increment_, entry.damping, at_);
    problem_.update_rates(at_);
    entry.space_changed =
        frozen_ ? problem_.update_relations(at_) : problem_.update_spaces(at_) == SpaceChange::unknowns;
    return true;
  } catch (const StepRefused& refused) {
    if (!options_.damping) throw;
    refused_ = refused.what();
    return false;
  }
}

void Newton::solve_linear(std::vector<double>& increment, SolveReport& report) {
  Assembler& assembler = problem_.assembler();
  // A solver finds what has no resistance by luck: where rounding leaves some, it returns any such change.
  if (const long long pattern = assembler.matrix().pattern_version; pattern != held_) {
    // What is held at first loses only levels: where fluid is closed in.
    const std::string free = describe_free_modes(problem_, no_resistance, held_ >= 0).text;
    if (!free.empty()) throw NothingHolds("the matrix is singular\n" + free, {});
    held_ = pattern;
  }
  try {
    report =
        solver_.solve(assembler.matrix(), assembler.equation_blocks(), assembler.right_side(), increment);
  } catch (const SingularMatrix& singular) {
    const std::string who = describe_unsupported(problem_, singular.equations);
    if (who.empty()) throw;
    throw NothingHolds(std::string(singular.what()) + "\n" + who, singular.equations);
  }
}

/// What rounding alone resists is no singular matrix to a solver. Next to a change so large all that is left
/// to add is small, so that iterations would seem to have converged. Collective.
/// @throws SingularMatrix naming the unknown that changes the most
void Newton::require_sense(const std::vector<double>& increment) const {
  constexpr double most = 1e6;  // sizes of the unknown
  struct Change {
    int entry, unknown;
    double sizes, change, at[3];
  };
  std::vector<Change> largest;
  for (std::size_t e = 0; e < problem_.fields().size(); ++e) {
    const FieldEntry& entry = problem_.fields()[e];
    for (std::size_t u = 0; u < entry.field->unknowns().size(); ++u) {
      const Unknown& unknown = entry.field->unknowns()[u];
      // With time what moves freely may go any way; it turns about itself far less often.
      if (unknown.scale == 0 || (unknown.role == UnknownRole::motion && at_.step > 0)) continue;
      const Field::ComponentRange place = entry.field->place(unknown.name);
      const Block& block = entry.field->blocks()[place.block];
      for (int node = 0; node < block.space->owned_nodes(); ++node)
        for (int c = place.offset; c < place.offset + place.components; ++c) {
          const int row = problem_.assembler().row(*entry.field, place.block, node, place.offset);
          if (row < 0 || block.prescribed[static_cast<std::size_t>(node) * block.size + c]) continue;
          const double change = increment[row + c - place.offset], sizes = std::abs(change) / unknown.scale;
          if (!(sizes > most) || (!largest.empty() && sizes <= largest.front().sizes)) continue;
          largest.assign(1, {static_cast<int>(e), static_cast<int>(u), sizes, change, {}});
          std::copy_n(block.space->position(node), entry.mesh->dimension(), largest.front().at);
        }
    }
  }
  largest = problem_.communicator().gather_all(largest);
  if (largest.empty()) return;
  const Change& worst = *std::ranges::max_element(largest, {}, &Change::sizes);
  const FieldEntry& entry = problem_.fields()[worst.entry];
  const Unknown& unknown = entry.field->unknowns()[worst.unknown];
  throw SingularMatrix(
      fmt::format(
          "{}: error: the matrix is singular but for rounding: in iteration {} the {} of field '{}' at "
          "({:.6g}) would change by {:.2g} {}, and more than {:.0e} {} is no solution; next to nothing "
          "resists it where it is, as where a body is balanced or its weight has no lever to act "
          "by; let something hold it, or begin nearer to where it comes to rest",
          entry.where.text(), iteration_ + 1, unknown.name, entry.name,
          fmt::join(worst.at, worst.at + entry.mesh->dimension(), ", "), worst.change, unknown.unit,
          most * unknown.scale, unknown.unit),
      {});
}

void Newton::solve_initial_rates(double time) {
  TimePoint at = time_point(time, 0, 1);
  at.initial_rates = true;
  problem_.update_spaces(at);
  problem_.assembler().assemble(at, true);
  if (!problem_.assembler().is_finite())
    throw Error("something is not finite at the start:" + problem_.assembler().describe_not_finite(at));
  std::vector<double> increment;
  SolveReport report;
  solve_linear(increment, report);
  problem_.add_initial_rates(increment);
}

}  // namespace seam
