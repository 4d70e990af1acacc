// SPDX-License-Identifier: BSD-3-Clause
#include "seam/conformance/constraints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "seam/conformance/tangent.hpp"
#include "seam/field/field.hpp"

namespace seam {
namespace {

using Resolved = Ties::Resolved;

/// The blocks of all fields, as UnknownPlace counts them.
std::vector<Block*> blocks_of(Problem& problem) {
  std::vector<Block*> blocks;
  for (FieldEntry& entry : problem.fields())
    for (Block& block : entry.field->blocks()) blocks.push_back(&block);
  return blocks;
}

/// A number for each unknown of each block.
class PerUnknown {
 public:
  explicit PerUnknown(const std::vector<Block*>& blocks) : blocks_(blocks) {
    for (const Block* block : blocks) of_block.emplace_back(block->now.value.size(), 0.0);
  }
  [[nodiscard]] double operator()(const UnknownPlace& place) const {
    return of_block[place.block][index(place)];
  }
  [[nodiscard]] double& at(const UnknownPlace& place) { return of_block[place.block][index(place)]; }
  std::vector<std::vector<double>> of_block;

 private:
  [[nodiscard]] std::size_t index(const UnknownPlace& place) const {
    const Block& block = *blocks_[place.block];
    return static_cast<std::size_t>(block.space->local_node(place.node)) * block.size + place.component;
  }
  std::vector<Block*> blocks_;
};

/// What a tie gives its unknown, and what it hands on to each of the others.
struct Given {
  double value = 0;
  std::map<UnknownPlace::Key, double> handed;
};

Given given(const Resolved& tie, const PerUnknown& values) {
  Given result{tie.constant, {}};
  for (const TiedTo& to : tie.to) {
    if (!to.unknown.is_clock()) result.value += to.coefficient * values(to.unknown);
    result.handed[to.unknown.key()] += to.handed;
  }
  return result;
}

/// The same, as the coefficients say that they change.
Given change(const Resolved& tie, const PerUnknown& direction) {
  Given result;
  for (const TiedTo& to : tie.to) {
    if (!to.unknown.is_clock()) result.value += to.coefficient * direction(to.unknown);
    result.handed.emplace(to.unknown.key(), 0.0);
  }
  for (const Resolved::Change& c : tie.changes)
    if (!c.with.is_clock()) result.handed[c.row.key()] += c.derivative * direction(c.with);
  return result;
}

/// The same, as rates say: of motions that take a time.
Given motion(const Resolved& tie, const PerUnknown& motions, double time) {
  const auto of = [&](const UnknownPlace& place) { return place.is_clock() ? time : motions(place); };
  Given result;
  for (const TiedTo& to : tie.to) {
    result.value += to.handed * of(to.unknown);
    result.handed.emplace(to.unknown.key(), 0.0);
  }
  for (const Resolved::Change& c : tie.changes) result.handed[c.row.key()] += c.by_motion * of(c.with);
  return result;
}

/// Largest differences over all ties, beside the largest numbers.
struct Errors {
  double value = 0, handed = 0, values = 1e-300, shares = 1e-300;
};

/// A direction to go in, of the sizes that unknowns have; what is tied is left at 0.
PerUnknown random_direction(Problem& problem, const std::vector<Block*>& blocks) {
  PerUnknown direction(blocks);
  std::mt19937 generator(20261);
  std::uniform_real_distribution<double> part(-1, 1);
  const std::vector<double> scales = unknown_scales(problem);
  std::size_t number = 0, block = 0;
  for (const FieldEntry& entry : problem.fields()) {
    for (const Unknown& unknown : entry.field->unknowns()) {
      const Field::ComponentRange place = entry.field->place(unknown.name);
      const auto size = static_cast<std::size_t>(entry.field->blocks()[place.block].size);
      std::vector<double>& of_block = direction.of_block[block + place.block];
      for (std::size_t i = 0; i < of_block.size(); ++i)
        if (const auto c = static_cast<int>(i % size);
            c >= place.offset && c < place.offset + place.components)
          of_block[i] = scales[number] * part(generator);
      ++number;
    }
    block += entry.field->blocks().size();
  }
  return direction;
}

/// Ties on both sides of the present states, along a direction that takes a time.
struct Sides {
  std::vector<Given> found[2];
  bool same = true;  ///< whether others are tied there
};

Sides go(Problem& problem, const TimePoint& at, const std::vector<Resolved>& here,
         const PerUnknown& direction, double time, double step) {
  const StateStore::Snapshot before = problem.state().snapshot(at.time);
  const std::vector<Block*> blocks = blocks_of(problem);
  Sides sides;
  for (const int side : {0, 1}) {
    problem.state().restore(before);
    const double part = side == 0 ? -step : step;
    PerUnknown values(blocks);
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (std::size_t i = 0; i < blocks[b]->now.value.size(); ++i)
        values.of_block[b][i] = blocks[b]->now.value[i] += part * direction.of_block[b][i];
    problem.update_rates(at);
    TimePoint there = at;
    there.time += part * time;
    const std::vector<Resolved> ties = problem.ties(there);
    const auto key = [](const Resolved& tie) { return tie.unknown.key(); };
    sides.same = sides.same && std::ranges::equal(ties, here, {}, key, key);
    for (const Resolved& tie : ties) sides.found[side].push_back(given(tie, values));
  }
  problem.state().restore(before);
  return sides;
}

Errors compare(const Sides& sides, const std::vector<Given>& expected, double step) {
  Errors errors;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const Given &low = sides.found[0][k], &high = sides.found[1][k];
    const double difference = (high.value - low.value) / (2 * step);
    errors.value = std::max(errors.value, std::abs(difference - expected[k].value));
    errors.values = std::max({errors.values, std::abs(difference), std::abs(expected[k].value)});
    for (const auto& [key, derivative] : expected[k].handed) {
      const double below = low.handed.contains(key) ? low.handed.at(key) : 0,
                   above = high.handed.contains(key) ? high.handed.at(key) : 0;
      const double share = (above - below) / (2 * step);
      errors.handed = std::max(errors.handed, std::abs(share - derivative));
      errors.shares = std::max({errors.shares, std::abs(share), std::abs(derivative), std::abs(below)});
    }
  }
  return errors;
}

/// Differences over two sides are right to second order: a quarter with half the step, unless all is
/// rounding.
/// @param error with the step, and with half of it, relative
ConformanceCheck judge(const std::string& what, const std::array<double, 2>& error, std::size_t ties) {
  constexpr double most = 1e-6, rounding = 1e-9, least_ratio = 3;
  const bool falls = error[1] <= rounding || error[0] >= least_ratio * error[1];
  return conformance_check(
      "ties of unknowns: " + what, error[1] <= most && falls,
      fmt::format("{:.1e} relative over {} ties, at most {:.0e}{}", error[1], ties, most,
                  error[1] <= rounding
                      ? ""
                      : fmt::format("; {:.1f} times as much with twice the step, at least {:.0f}",
                                    error[0] / error[1], least_ratio)));
}

}  // namespace

std::vector<ConformanceCheck> check_constraints(Problem& problem, const TimePoint& at) {
  constexpr double steps[] = {1e-3, 5e-4};
  const StateStore::Snapshot before = problem.state().snapshot(at.time);
  PerUnknown direction = random_direction(problem, blocks_of(problem));
  std::vector<ConformanceCheck> checks;
  // As values change, and as things move: from the start of a step, where turns of bodies in space are what
  // their angles change by.
  for (const bool moves : {false, true}) {
    if (moves) problem.state().advance();
    const double time = moves ? (at.step > 0 ? at.step : 1) : 0;
    const std::vector<Resolved> here = problem.ties(at);
    if (here.empty()) return {};
    std::vector<Given> expected;
    for (const Resolved& tie : here) direction.at(tie.unknown) = 0;  // it follows
    for (const Resolved& tie : here)
      direction.at(tie.unknown) = (moves ? motion(tie, direction, time) : change(tie, direction)).value;
    for (const Resolved& tie : here)
      expected.push_back(moves ? motion(tie, direction, time) : change(tie, direction));
    std::array<double, 2> value{}, handed{};
    bool same = true;
    for (std::size_t k = 0; k < 2; ++k) {
      const Sides sides = go(problem, at, here, direction, time, steps[k]);
      same = sides.same;
      if (!same) break;
      const Errors errors = compare(sides, expected, steps[k]);
      value[k] = errors.value / errors.values;
      handed[k] = errors.handed / errors.shares;
    }
    if (!same) {
      checks.push_back({"ties of unknowns", ConformanceCheck::Outcome::skipped,
                        "others are tied beside the state that the scene has"});
      break;
    }
    checks.push_back(
        judge(moves ? "values change as their rates say" : "values change as the coefficients say", value,
              here.size()));
    checks.push_back(
        judge(moves ? "what is handed on changes as motions say" : "what is handed on changes as said",
              handed, here.size()));
  }
  problem.state().restore(before);
  return checks;
}

}  // namespace seam
