// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "seam/assembly/assembler.hpp"
#include "seam/assembly/evaluator.hpp"
#include "seam/assembly/time_point.hpp"
#include "seam/assembly/together.hpp"
#include "seam/field/field.hpp"

/// Inertia of what is tied by coefficients d that change. With its momentum p = m v, where v is what follows
/// from the rates of the others, their equations get
///
///   d/dt (sum_i d_ik p_i) - sum_i (rate of d_ik) p_i    in the place of    sum_i d_ik m a_i,
///
/// as in minimal coordinates, with d/dt by the time scheme, in axes that stay (Ties::set_axes). So with theta
/// = 1/2 momentum is kept and energy does not grow. With other schemes it would grow without bound; these
/// take forces instead, d_ik m times the rate by the scheme of v, whose work has the sign that damps
/// (decision 55).
namespace seam {
namespace {

/// A number that tells ties apart, small enough for sums of many to be exact.
double number_of(const UnknownPlace::Key& key) {
  const auto [block, node, component] = key;
  return static_cast<double>(1 + (block * 7919LL + node * 104729LL + component * 31LL) % 1048573);
}

}  // namespace

/// @pre the element's nodes have been found
void Assembler::assemble_momentum(Group& group, int index, const TimePoint& at, bool with_tangent) {
  ElementEvaluator& element = *group.evaluator;
  element.compute(index, by_rates(at, 0, 1), true);
  const int* node = element_nodes_.data();
  for (const auto& rows : element.side_blocks())
    for (int a = 0; a < rows.nodes; ++a, ++node) {
      if (*node < 0 || !node_has_relations_[*node]) continue;
      for (int i = 0; i < rows.components; ++i) {
        const int relation = relation_[graph_.node(*node).first + i];
        if (relation < 0 || ties_[relation].changes.empty() || is_given(ties_[relation])) continue;
        const std::size_t row = static_cast<std::size_t>(rows.offset) + i * rows.stride + a;
        hand_on_momentum(element, ties_[relation], &element.matrix()[row * element.size()],
                         with_tangent ? at.rate_factor : 0);
      }
    }
}

/// @param mass [column of the element]
/// @param rate_factor 0 to leave the tangent as it is
void Assembler::hand_on_momentum(const ElementEvaluator& element, const Tie& tie, const double* mass,
                                 double rate_factor) {
  double momentum = 0, force = 0;  // m v, m a
  for (const auto& columns : element.side_blocks()) {
    const int* nodes = element.element().sides[columns.side].nodes[columns.block];
    const NodalState& now = columns.states->now;
    for (int b = 0; b < columns.nodes; ++b)
      for (int j = 0; j < columns.components; ++j) {
        const double entry = mass[columns.offset + j * columns.stride + b];
        const std::size_t state = static_cast<std::size_t>(nodes[b]) * columns.components + j;
        momentum += entry * now.rate[state];
        force += entry * now.second_rate[state];
      }
  }
  for (const Tie::To& to : tie.to) {
    double rate = 0;  // of the coefficient
    for (const Tie::Change& change : tie.changes)
      if (change.row.unknown == to.to.unknown) rate += change.by_motion * rate_of(change.with);
    const double by_second_rates = to.handed * force + rate * momentum;
    local_momentum_[to.to.unknown] += to.handed * momentum;
    local_momentum_rate_[to.to.unknown] += by_second_rates;
    local_residual_[to.to.unknown] -= by_second_rates;
    local_magnitude_[to.to.unknown] += std::abs(rate * momentum);
    if (rate_factor == 0) continue;
    const double factor = -rate_factor * (rate + turned_part(tie, to));
    const int* node = element_nodes_.data();
    for (const auto& columns : element.side_blocks())
      for (int b = 0; b < columns.nodes; ++b, ++node)
        for (int j = 0; j < columns.components && *node >= 0; ++j) {
          const double entry = factor * mass[columns.offset + j * columns.stride + b];
          const int column = graph_.node(*node).first + j;
          if (entry != 0 && relation_[column] < 0) add_to_row(to.to.unknown, entry, column);
          for (std::size_t t = 0;
               entry != 0 && relation_[column] >= 0 && t < ties_[relation_[column]].to.size(); ++t) {
            const Tie::To& further = ties_[relation_[column]].to[t];
            add_to_row(to.to.unknown, further.handed * entry, further.to.unknown);
          }
        }
  }
  for (const Tie::Change& change : tie.changes)
    if (rate_factor != 0 && change.row.unknown >= 0 && change.with.unknown >= 0)
      add_to_row(change.row.unknown, -change.derivative * force, change.with.unknown);
}

/// How what a tie hands on to an unknown goes on in axes that stay because the unknown's axes turn.
double Assembler::turned_part(const Tie& tie, const Tie::To& to) const {
  const int k = turn_of_[to.to.unknown];
  if (k < 0) return 0;
  const auto part = [&](int m) {
    const auto found = std::ranges::find(tie.to, to.to.unknown - k + m,
                                         [](const Tie::To& other) { return other.to.unknown; });
    return found == tie.to.end() ? 0.0 : found->handed;
  };
  const auto rate = [&](int m) { return blocks_[to.to.block].block->now.rate[to.to.state - k + m]; };
  const int l = (k + 1) % 3, m = (k + 2) % 3;
  return rate(l) * part(m) - rate(m) * part(l);
}

/// Sets each three numbers of unknowns that turn about axes which turn themselves.
/// @param change (axes, rates of turning, numbers of `from`) -> those of `to`, which may be the same
template <class Change>
void Assembler::change_at_axes(const std::vector<double>& from, std::vector<double>& to,
                               const Change& change) const {
  for (const Ties::Axes& axes : axes_) {
    const LocalUnknown first = find(axes.first);
    if (first.unknown < 0 || first.unknown >= matrix_.rows) continue;
    if (turn_of_[first.unknown] < 0) continue;
    Vec<3, double> rates, numbers;
    for (int k = 0; k < 3; ++k) {
      rates[k] = blocks_[first.block].block->now.rate[first.state + k];
      numbers[k] = from[first.unknown + k];
    }
    const Vec<3, double> changed = change(axes.turn, rates, numbers);
    for (int k = 0; k < 3; ++k) to[first.unknown + k] = changed[k];
  }
}

void Assembler::in_axes_that_stay(std::vector<double>& local) const {
  change_at_axes(local, local, [](const Mat<3, 3, double>& turn, const auto&, const Vec<3, double>& numbers) {
    return turn * numbers;
  });
}

void Assembler::in_axes_that_turn(std::vector<double>& local) const {
  change_at_axes(local, local, [](const Mat<3, 3, double>& turn, const auto&, const Vec<3, double>& numbers) {
    return transpose(turn) * numbers;
  });
}

/// The rates that momenta have because their axes turn; 0 where these stay.
std::vector<double> Assembler::turned_on(const std::vector<double>& momentum) const {
  std::vector<double> result(momentum.size(), 0.0);
  change_at_axes(momentum, result, [](const auto&, const Vec<3, double>& w, const Vec<3, double>& p) {
    return Vec<3, double>{{w[1] * p[2] - w[2] * p[1], w[2] * p[0] - w[0] * p[2], w[0] * p[1] - w[1] * p[0]}};
  });
  return result;
}

void Assembler::begin_momentum(const TimePoint& at) {
  if (!has_turning_ties_) return;
  local_momentum_.assign(local_residual_.size(), 0.0);
  local_momentum_rate_.assign(local_residual_.size(), 0.0);
  std::vector<double> whose(local_residual_.size(), 0.0);
  // By elements, as momenta: what is tied beside these need not be known to the rank that it is tied to.
  const auto tell_whose = [&](int node) {
    if (node < 0 || !node_has_relations_[node]) return;
    const int first = graph_.node(node).first;
    for (int u = first; u < first + graph_.node(node).size; ++u) {
      if (relation_[u] < 0) continue;
      const Tie& tie = ties_[relation_[u]];
      if (tie.changes.empty() || is_given(tie)) continue;
      for (const Tie::To& to : tie.to) whose[to.to.unknown] += number_of(tie.key);
    }
  };
  together(communicator_, [&] {
    for (Group& group : groups_)
      for (int e = 0; group.evaluator->has_inertia() && e < group.domain->size(); ++e) {
        find_element_nodes(group, e);
        if (!element_turns()) continue;
        assemble_momentum(group, e, at, false);
        std::ranges::for_each(element_nodes_, tell_whose);
      }
  });
  for (auto* vector : {&local_momentum_, &local_momentum_rate_, &whose}) graph_.collect_vector(*vector);
  const std::vector<double> turned = turned_on(local_momentum_);
  for (std::size_t u = 0; u < turned.size(); ++u) local_momentum_rate_[u] += turned[u];
  for (auto* vector : {&local_momentum_, &local_momentum_rate_}) in_axes_that_stay(*vector);
  momentum_at_start_.assign(blocks_.size(), {});
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    Block& block = *blocks_[b].block;
    if (block.momentum_of == nullptr) continue;
    momentum_at_start_[b].assign(block.now.value.size(), 0.0);
    for (int node = 0; node < block.space->owned_nodes(); ++node)
      for (int c = 0; c < block.size && blocks_[b].node_index[node] >= 0; ++c) {
        const int row = graph_.node(blocks_[b].node_index[node]).first + c;
        const std::size_t state = static_cast<std::size_t>(node) * block.size + c;
        momentum_at_start_[b][state] = local_momentum_[row];
        // Who takes momentum of others than before begins with what their second rates say.
        if ((*block.momentum_of)[state] == whose[row]) continue;
        (*block.momentum_of)[state] = whose[row];
        (*block.now.momentum_rate)[state] = (*block.old.momentum_rate)[state] = local_momentum_rate_[row];
      }
  }
}

void Assembler::forget_momentum() {
  for (const NumberedBlock& b : blocks_)
    if (b.block->momentum_of != nullptr) std::ranges::fill(*b.block->momentum_of, 0.0);
}

/// Adds the rates of what has been handed on.
void Assembler::balance_momentum(const TimePoint& at) {
  if (!has_turning_ties_ || at.step == 0 || !at.inertia_as_momentum) return;
  graph_.collect_vector(local_momentum_);
  const std::vector<double> turned = turned_on(local_momentum_);
  in_axes_that_stay(local_momentum_);
  std::fill(local_momentum_rate_.begin(), local_momentum_rate_.end(), 0.0);
  const double keep = (1 - at.theta) / at.theta;
  for (std::size_t b = 0; b < momentum_at_start_.size(); ++b) {
    Block& block = *blocks_[b].block;
    if (momentum_at_start_[b].empty()) continue;
    for (int node = 0; node < block.space->owned_nodes(); ++node)
      for (int c = 0; c < block.size && blocks_[b].node_index[node] >= 0; ++c) {
        const int row = graph_.node(blocks_[b].node_index[node]).first + c;
        const std::size_t state = static_cast<std::size_t>(node) * block.size + c;
        const double gained = local_momentum_[row] - momentum_at_start_[b][state];
        double& rate = local_momentum_rate_[row];
        rate = at.rate_factor * gained - keep * (*block.old.momentum_rate)[state];
        (*block.now.momentum_rate)[state] = rate;
      }
  }
  in_axes_that_turn(local_momentum_rate_);
  for (int r = 0; r < matrix_.rows; ++r) {
    local_residual_[r] += local_momentum_rate_[r] - turned[r];
    local_magnitude_[r] += std::abs(local_momentum_rate_[r]) + std::abs(turned[r]);
  }
}

}  // namespace seam
