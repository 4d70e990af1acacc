// SPDX-License-Identifier: BSD-3-Clause
#include "seam/conformance/constraints.hpp"

#include <fmt/format.h>

#include <algorithm>
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
    result.value += to.coefficient * values(to.unknown);
    result.handed[to.unknown.key()] += to.handed;
  }
  return result;
}

/// The same, as the coefficients say that they change.
Given change(const Resolved& tie, const PerUnknown& direction) {
  Given result;
  for (const TiedTo& to : tie.to) {
    result.value += to.coefficient * direction(to.unknown);
    result.handed.emplace(to.unknown.key(), 0.0);
  }
  for (const Resolved::Change& c : tie.changes)
    result.handed[c.row.key()] += c.derivative * direction(c.with);
  return result;
}

/// Largest differences over all ties, beside the largest numbers.
struct Errors {
  double value = 0, handed = 0, values = 1e-300, shares = 1e-300;
};

}  // namespace

std::vector<ConformanceCheck> check_constraints(Problem& problem, const TimePoint& at) {
  constexpr double tolerance = 1e-6, step = 1e-4;
  const std::vector<Resolved> here = problem.ties(at);
  if (here.empty()) return {};
  const StateStore::Snapshot before = problem.state().snapshot(at.time);
  const std::vector<Block*> blocks = blocks_of(problem);
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
  // What is tied follows.
  for (const Resolved& tie : here) {
    double& of_tied = direction.at(tie.unknown);
    of_tied = 0;
    for (const TiedTo& to : tie.to) of_tied += to.coefficient * direction(to.unknown);
  }
  std::vector<Resolved> ties[2];
  std::vector<Given> found[2];
  for (const int side : {0, 1}) {
    problem.state().restore(before);
    PerUnknown values(blocks);
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (std::size_t i = 0; i < blocks[b]->now.value.size(); ++i)
        values.of_block[b][i] = blocks[b]->now.value[i] +=
            (side == 0 ? -step : step) * direction.of_block[b][i];
    problem.update_rates(at);
    ties[side] = problem.ties(at);
    for (const Resolved& tie : ties[side]) found[side].push_back(given(tie, values));
  }
  problem.state().restore(before);
  const std::string name = "ties of unknowns";
  const auto same = [](const Resolved& a, const Resolved& b) { return a.unknown.key() == b.unknown.key(); };
  if (!std::ranges::equal(ties[0], ties[1], same) || !std::ranges::equal(ties[0], here, same))
    return {
        {name, ConformanceCheck::Outcome::skipped, "others are tied beside the state that the scene has"}};
  Errors errors;
  for (std::size_t k = 0; k < here.size(); ++k) {
    const Given expected = change(here[k], direction);
    const double difference = (found[1][k].value - found[0][k].value) / (2 * step);
    errors.value = std::max(errors.value, std::abs(difference - expected.value));
    errors.values = std::max({errors.values, std::abs(difference), std::abs(expected.value)});
    for (const auto& [key, derivative] : expected.handed) {
      const double share = (found[1][k].handed[key] - found[0][k].handed[key]) / (2 * step);
      errors.handed = std::max(errors.handed, std::abs(share - derivative));
      errors.shares =
          std::max({errors.shares, std::abs(share), std::abs(derivative), std::abs(found[0][k].handed[key])});
    }
  }
  const auto check = [&](const std::string& what, double error, double size) {
    return conformance_check(
        name + ": " + what, error <= tolerance * size,
        fmt::format("{:.1e} relative over {} ties, at most {:.0e}", error / size, here.size(), tolerance));
  };
  return {check("values change as the coefficients say", errors.value, errors.values),
          check("what is handed on changes as said", errors.handed, errors.shares)};
}

}  // namespace seam
