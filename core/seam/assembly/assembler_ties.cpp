// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "seam/assembly/assembler.hpp"
#include "seam/assembly/evaluator.hpp"
#include "seam/assembly/together.hpp"
#include "seam/field/field.hpp"

namespace seam {
namespace {

/// Whether the same unknowns are tied to the same ones.
bool same_relations(const std::vector<Ties::Resolved>& a, const std::vector<Ties::Resolved>& b) {
  return std::ranges::equal(a, b, [](const Ties::Resolved& s, const Ties::Resolved& t) {
    return s.unknown.key() == t.unknown.key() &&
           std::ranges::equal(
               s.to, t.to,
               [](const TiedTo& u, const TiedTo& v) { return u.unknown.key() == v.unknown.key(); }) &&
           std::ranges::equal(s.changes, t.changes, [](const auto& u, const auto& v) {
             return u.row.key() == v.row.key() && u.with.key() == v.with.key();
           });
  });
}

Error inactive(const Ties::Resolved& tie, const UnknownPlace& to) {
  const double *x = tie.unknown.position, *y = to.position;
  return Error(
      fmt::format("the unknown at ({:.6g}, {:.6g}, {:.6g}) is tied to one at ({:.6g}, {:.6g}, {:.6g}) that "
                  "is not part of "
                  "the system, since bodies cover all cells around it",
                  x[0], x[1], x[2], y[0], y[1], y[2]));
}

}  // namespace

bool Assembler::tie(std::vector<Ties::Resolved> ties, const std::vector<Ties::Axes>& axes) {
  axes_ = axes;
  const bool same = same_relations(ties, resolved_);
  resolved_ = std::move(ties);
  if (communicator_.any(!same)) return true;
  // Coefficients may have changed.
  std::size_t k = 0;
  for (Tie& tie : ties_) {
    while (resolved_[k].unknown.key() != tie.key) ++k;
    const Ties::Resolved& from = resolved_[k];
    tie.constant = from.constant;
    std::size_t m = 0;
    for (const TiedTo& to : from.to) {
      if (to.unknown.is_clock()) {
        tie.by_itself = to.handed;
        continue;
      }
      tie.to[m].coefficient = to.coefficient;
      tie.to[m++].handed = to.handed;
    }
    number_changes(from, tie);
  }
  return false;
}

/// The state of an unknown, and its local number; -1 where it is not active.
Assembler::LocalUnknown Assembler::find(const UnknownPlace& place) const {
  if (place.is_clock()) return {-1, 0, -1};
  const NumberedBlock& b = blocks_[place.block];
  const int node = b.block->space->local_node(place.node);
  const int index = node >= 0 && node < static_cast<int>(b.node_index.size()) ? b.node_index[node] : -1;
  return {place.block, static_cast<std::size_t>(node) * b.block->size + place.component,
          index < 0 ? -1 : first_of_node_[index] + place.component};
}

void Assembler::number_changes(const Ties::Resolved& from, Tie& tie) const {
  tie.changes.clear();
  for (const Ties::Resolved::Change& change : from.changes) {
    for (const UnknownPlace& place : {change.row, change.with})
      if (!place.is_clock() && find(place).unknown < 0) throw inactive(from, place);
    tie.changes.push_back({find(change.row), find(change.with), change.derivative, change.by_motion});
  }
}

/// @throws Error on all ranks where an unknown of the system is tied to one that is none
void Assembler::number_ties() {
  ties_.clear();
  together(communicator_, [&] {
    for (const Ties::Resolved& from : resolved_) {
      Tie tie{from.unknown.key(), find(from.unknown), from.constant, 0, 0, {}, {}};
      if (tie.tied.unknown < 0) continue;
      for (const TiedTo& to : from.to) {
        if (to.unknown.is_clock()) {
          tie.by_itself = to.handed;
          continue;
        }
        tie.to.push_back({find(to.unknown), to.coefficient, to.handed});
        if (tie.to.back().to.unknown < 0) throw inactive(from, to.unknown);
      }
      number_changes(from, tie);
      ties_.push_back(std::move(tie));
    }
  });
  has_ties_ = communicator_.any(!ties_.empty());
  has_turning_ties_ =
      communicator_.any(std::ranges::any_of(ties_, [](const Tie& tie) { return !tie.changes.empty(); }));
  has_given_ties_ =
      communicator_.any(std::ranges::any_of(ties_, [&](const Tie& tie) { return is_given(tie); }));
  turn_of_.assign(relation_.size(), -1);
  if (!has_ties_) return;
  std::vector<std::vector<double>> scale;
  for (const NumberedBlock& b : blocks_) scale.push_back(scales(b));
  for (std::size_t k = 0; k < ties_.size(); ++k) {
    const LocalUnknown& tied = ties_[k].tied;
    ties_[k].scale = scale[tied.block][tied.state % blocks_[tied.block].block->size];
    relation_[ties_[k].tied.unknown] = static_cast<int>(k);
    node_has_relations_[node_of_[ties_[k].tied.unknown]] = 1;
  }
  for (const Ties::Axes& axes : axes_) {
    const int first = find(axes.first).unknown;
    // What is left of turns that are tied to each other, as on a hinge, has no axes of its own.
    const auto is_tied = [&](int k) { return relation_[first + k] >= 0; };
    if (first >= 0 && !is_tied(0) && !is_tied(1) && !is_tied(2))
      for (int k = 0; k < 3; ++k) turn_of_[first + k] = k;
  }
}

/// Nodes that an element's contributions go to because of ties of its own ones.
void Assembler::add_tied_nodes(NodeGraph::Elements& elements) const {
  const std::size_t end = elements.node.size();
  for (std::size_t k = elements.start.back(); k < end; ++k) {
    const int node = elements.node[k];
    if (!node_has_relations_[node]) continue;
    for (int u = first_of_node_[node]; u < static_cast<int>(node_of_.size()) && node_of_[u] == node; ++u) {
      if (relation_[u] < 0) continue;
      const Tie& tie = ties_[relation_[u]];
      for (const Tie::To& to : tie.to) elements.node.push_back(node_of_[to.to.unknown]);
      for (const Tie::Change& change : tie.changes)
        for (const LocalUnknown& of : {change.row, change.with})
          if (of.unknown >= 0) elements.node.push_back(node_of_[of.unknown]);
    }
  }
  if (elements.node.size() == end) return;
  const auto first = elements.node.begin() + static_cast<std::ptrdiff_t>(elements.start.back());
  std::sort(first, elements.node.end());
  elements.node.erase(std::unique(first, elements.node.end()), elements.node.end());
}

double Assembler::value_of(const LocalUnknown& unknown) const {
  return blocks_[unknown.block].block->now.value[unknown.state];
}

double Assembler::tied_value(const Tie& tie) const {
  double value = tie.constant;
  for (const Tie::To& to : tie.to) value += to.coefficient * value_of(to.to);
  return value;
}

/// What a tied unknown's changes are measured by: what its value is made of, or a size that it has by nature.
double Assembler::size_of(const Tie& tie) const {
  double size = std::max(tie.scale, std::abs(tie.constant));
  for (const Tie::To& to : tie.to) size = std::max(size, std::abs(to.coefficient * value_of(to.to)));
  return size;
}

/// How far a tied unknown is from its value; 0 where it is rounding that keeps it away.
double Assembler::way_of(const Tie& tie) const {
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  const double way = tied_value(tie) - value_of(tie.tied);
  return std::abs(way) <= rounding * size_of(tie) ? 0.0 : way;
}

/// Whether an unknown has a rate of this order.
bool Assembler::has_rate(const LocalUnknown& unknown, int order) const {
  const Block& block = *blocks_[unknown.block].block;
  return block.time_order[unknown.state % block.size] >= order;
}

bool Assembler::ties_pending() const {
  // Relations with coefficients that depend on the state are met as far as Newton's method takes them.
  constexpr double enough = 1e-10;
  return std::ranges::any_of(
      ties_, [&](const Tie& tie) { return std::abs(pending_[tie.tied.unknown]) > enough * size_of(tie); });
}

std::vector<double> Assembler::ways_of_ties() const {
  std::vector<double> ways;
  for (const Tie& tie : ties_) ways.push_back(way_of(tie));
  return ways;
}

/// Lets tied unknowns follow what they are tied to, all but a rest of the way.
void Assembler::settle_ties(const std::vector<double>& remaining) {
  for (std::size_t k = 0; k < ties_.size(); ++k)
    if (ties_[k].tied.unknown < matrix_.rows)
      blocks_[ties_[k].tied.block].block->now.value[ties_[k].tied.state] =
          tied_value(ties_[k]) - remaining[k];
  for (NumberedBlock& b : blocks_) b.block->space->halo().update(b.block->now.value, b.block->size);
}

bool Assembler::follow_ties(const std::vector<double>& remaining) {
  constexpr double rounding = 1e-13;
  bool far = false;
  for (std::size_t k = 0; k < ties_.size(); ++k)
    far |= ties_[k].tied.unknown < matrix_.rows &&
           std::abs(way_of(ties_[k]) - remaining[k]) > rounding * size_of(ties_[k]);
  if (!communicator_.any(far)) return false;
  settle_ties(remaining);
  return true;
}

void Assembler::settle() {
  if (has_ties_) settle_ties(std::vector<double>(ties_.size(), 0.0));
}

double Assembler::rate_of(const LocalUnknown& unknown) const {
  return unknown.block < 0 ? 1.0 : blocks_[unknown.block].block->now.rate[unknown.state];
}

void Assembler::settle_rates() {
  if (!has_ties_) return;
  for (const Tie& tie : ties_) {
    if (tie.tied.unknown >= matrix_.rows || !has_rate(tie.tied, 1)) continue;
    double rate = tie.by_itself;
    for (const Tie::To& to : tie.to) rate += to.handed * rate_of(to.to);
    blocks_[tie.tied.block].block->now.rate[tie.tied.state] = rate;
  }
  for (NumberedBlock& b : blocks_) b.block->space->halo().update(b.block->now.rate, b.block->size);
}

/// Whether all that a tie follows is prescribed, or the clock.
bool Assembler::is_given(const Tie& tie) const {
  return std::ranges::all_of(tie.to,
                             [&](const Tie::To& to) { return relation_[to.to.unknown] == is_prescribed; });
}

void Assembler::settle_second_rate(const Tie& tie) {
  if (tie.tied.unknown >= matrix_.rows || !has_rate(tie.tied, 2)) return;
  double rate = 0;
  for (const Tie::To& to : tie.to)
    rate += to.handed * blocks_[to.to.block].block->now.second_rate[to.to.state];
  for (const Tie::Change& change : tie.changes)
    rate += change.by_motion * rate_of(change.row) * rate_of(change.with);
  blocks_[tie.tied.block].block->now.second_rate[tie.tied.state] = rate;
}

void Assembler::settle_second_rates() {
  if (!has_ties_) return;
  for (const Tie& tie : ties_) settle_second_rate(tie);
  for (NumberedBlock& b : blocks_) b.block->space->halo().update(b.block->now.second_rate, b.block->size);
}

void Assembler::settle_given_second_rates() {
  if (!has_given_ties_) return;
  for (const Tie& tie : ties_)
    if (is_given(tie)) settle_second_rate(tie);
  for (NumberedBlock& b : blocks_) b.block->space->halo().update(b.block->now.second_rate, b.block->size);
}

std::vector<double> Assembler::with_tied(std::vector<double> increment) const {
  if (!has_ties_) return increment;
  std::vector<std::vector<double>> changes;  // [block][unknown of a local node]
  for (const NumberedBlock& b : blocks_) {
    const Space& space = *b.block->space;
    std::vector<double>& of_block =
        changes.emplace_back(static_cast<std::size_t>(space.nodes()) * b.block->size, 0.0);
    for (int node = 0; node < space.owned_nodes(); ++node)
      for (int c = 0; c < b.block->size && b.node_index[node] >= 0; ++c)
        of_block[static_cast<std::size_t>(node) * b.block->size + c] =
            increment[graph_.node(b.node_index[node]).first + c];
    space.halo().update(of_block, b.block->size);
  }
  for (const Tie& tie : ties_) {
    if (tie.tied.unknown >= matrix_.rows) continue;
    increment[tie.tied.unknown] = 0;
    const bool moves = has_rate(tie.tied, 1);
    for (const Tie::To& to : tie.to)
      increment[tie.tied.unknown] += (moves ? to.handed : to.coefficient) * changes[to.to.block][to.to.state];
  }
  return increment;
}

/// Adds an entry of a row that is not tied: to its column, or to those of what the column's unknown is tied
/// to.
void Assembler::add_to_row(int row, double entry, int column) {
  if (relation_[row] == is_prescribed) return;
  const auto add = [&](int unknown, double value) {
    if (relation_[unknown] == is_prescribed)
      local_lift_[row] += value * pending_[unknown];
    else
      related_.add(row, unknown, value);
  };
  const int relation = relation_[column];
  if (relation < 0) {
    add(column, entry);
    return;
  }
  local_lift_[row] += entry * pending_[column];
  for (const Tie::To& to : ties_[relation].to) add(to.to.unknown, to.coefficient * entry);
}

/// Takes what relations have made of the element's matrix to the matrix.
void Assembler::add_related_sums() {
  related_.take([this](int row, int column, double sum) { value_at(row, column) += sum; });
}

/// Whether coefficients of one of the element's nodes change with the state.
bool Assembler::element_turns() const {
  if (!has_turning_ties_) return false;
  return std::ranges::any_of(element_nodes_, [&](int node) {
    if (node < 0 || !node_has_relations_[node]) return false;
    const int first = graph_.node(node).first;
    for (int u = first; u < first + graph_.node(node).size; ++u)
      if (relation_[u] >= 0 && !ties_[relation_[u]].changes.empty()) return true;
    return false;
  });
}

/// Rows that a column of the element's matrix goes to, and its entries there.
template <class Use>
void Assembler::for_each_row(const ElementEvaluator& element, const double* column, const Use& use) const {
  const int* node = element_nodes_.data();
  for (const auto& rows : element.side_blocks())
    for (int a = 0; a < rows.nodes; ++a, ++node) {
      if (*node < 0) continue;
      for (int i = 0; i < rows.components; ++i) {
        const double entry =
            column[(static_cast<std::size_t>(rows.offset) + static_cast<std::size_t>(i) * rows.stride + a) *
                   element.size()];
        const int row = graph_.node(*node).first + i;
        if (relation_[row] < 0)
          use(row, entry);
        else
          for (const Tie::To& to : ties_[relation_[row]].to) use(to.to.unknown, to.handed * entry);
      }
    }
}

/// The element's matrix by rates, at columns that are tied. The rate of what is tied is a sum of coefficients
/// times rates: it changes with what the coefficients change with, and not with values as its own value does.
void Assembler::scatter_rate_matrix(const ElementEvaluator& element, double rate_factor) {
  const int* column_node = element_nodes_.data();
  for (const auto& columns : element.side_blocks())
    for (int b = 0; b < columns.nodes; ++b, ++column_node) {
      if (*column_node < 0 || !node_has_relations_[*column_node]) continue;
      for (int j = 0; j < columns.components; ++j) {
        const int unknown = graph_.node(*column_node).first + j, relation = relation_[unknown];
        if (relation < 0 || ties_[relation].changes.empty()) continue;
        const double* column = &element.matrix()[static_cast<std::size_t>(columns.offset) +
                                                 static_cast<std::size_t>(j) * columns.stride + b];
        const double way = -rate_factor * pending_[unknown];
        for_each_row(element, column, [&](int row, double entry) { local_lift_[row] += way * entry; });
        const auto add = [&](double factor, int with) {
          if (factor != 0 && with >= 0)
            for_each_row(element, column,
                         [&](int row, double entry) { add_to_row(row, factor * entry, with); });
        };
        for (const Tie::To& to : ties_[relation].to)
          add(rate_factor * (to.handed - to.coefficient), to.to.unknown);
        for (const Tie::Change& change : ties_[relation].changes)
          add(change.derivative * rate_of(change.row), change.with.unknown);
      }
    }
}

/// Hands a tied unknown's part of the balance on to what it is tied to.
void Assembler::hand_on(const Tie& tie, double residual, double magnitude, bool with_tangent) {
  for (const Tie::To& to : tie.to) {
    local_residual_[to.to.unknown] += to.handed * residual;
    local_magnitude_[to.to.unknown] += std::abs(to.handed) * magnitude;
  }
  // Its part changes with the state where the coefficients do.
  for (const Tie::Change& change : tie.changes)
    if (with_tangent && change.row.unknown >= 0 && change.with.unknown >= 0)
      add_to_row(change.row.unknown, change.derivative * residual, change.with.unknown);
}

}  // namespace seam
