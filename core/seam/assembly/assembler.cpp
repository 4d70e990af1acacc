// SPDX-License-Identifier: BSD-3-Clause
#include "seam/assembly/assembler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "seam/assembly/element.hpp"
#include "seam/assembly/evaluator.hpp"
#include "seam/assembly/time_point.hpp"
#include "seam/assembly/together.hpp"
#include "seam/base/stopwatch.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/mesh.hpp"

namespace seam {

Assembler::~Assembler() = default;

Assembler::Assembler(std::vector<Field*> fields, const Communicator& communicator)
    : fields_(std::move(fields)), communicator_(communicator) {
  for (Field* field : fields_)
    for (Block& block : field->blocks()) blocks_.push_back({field, &block, {}});
  matrix_.communicator = communicator;
}

void Assembler::add(const std::shared_ptr<const IntegrationDomain>& domain,
                    const std::vector<BoundTerm>& terms, ElementEvaluator::Role role) {
  Group group{domain, std::make_unique<ElementEvaluator>(*domain, terms, role), {}};
  for (const auto& side_block : group.evaluator->side_blocks())
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      if (blocks_[b].block == side_block.states) group.block_of_side_block.push_back(static_cast<int>(b));
  groups_.push_back(std::move(group));
}

void Assembler::rebuild() {
  const Stopwatch watch;
  number_unknowns();
  pattern_seconds_ += watch.seconds();
}

void Assembler::number_unknowns() {
  std::vector<NodeGraph::Node> nodes;
  relation_.clear();
  node_has_relations_.clear();
  int unknowns = 0, owned_nodes = 0, owned_unknowns = 0;
  const auto append = [&](NumberedBlock& b, int node) {
    b.node_index[node] = static_cast<int>(nodes.size());
    nodes.push_back({b.block->size, b.block->space->owner(node), unknowns, 0});
    unknowns += b.block->size;
    char any = 0;
    for (int c = 0; c < b.block->size; ++c) {
      const char held = b.block->prescribed[static_cast<std::size_t>(node) * b.block->size + c];
      relation_.push_back(held ? is_prescribed : is_free);
      any |= held;
    }
    node_has_relations_.push_back(any);
  };
  for (const bool ghosts : {false, true}) {
    for (NumberedBlock& b : blocks_) {
      const int owned = b.block->space->owned_nodes();
      if (!ghosts) b.node_index.assign(b.block->space->nodes(), -1);
      for (int node = ghosts ? owned : 0; node < (ghosts ? b.block->space->nodes() : owned); ++node)
        if (b.block->active[node]) append(b, node);
    }
    if (!ghosts) {
      owned_nodes = static_cast<int>(nodes.size());
      owned_unknowns = unknowns;
    }
  }
  matrix_.first_row = communicator_.sum_before(owned_unknowns);
  matrix_.global_rows = communicator_.sum(static_cast<long long>(owned_unknowns));
  for (NumberedBlock& b : blocks_) {
    std::vector<long long> equation(b.node_index.size(), -1);
    for (std::size_t i = 0; i < equation.size(); ++i)
      if (b.node_index[i] >= 0) equation[i] = matrix_.first_row + nodes[b.node_index[i]].first;
    b.block->space->halo().update(equation, 1);
    for (std::size_t i = 0; i < equation.size(); ++i)
      if (b.node_index[i] >= 0) nodes[b.node_index[i]].equation = equation[i];
  }
  name_unknowns();
  pending_.assign(unknowns, 0.0);
  node_of_.clear();
  first_of_node_.clear();
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    first_of_node_.push_back(nodes[n].first);
    node_of_.insert(node_of_.end(), nodes[n].size, static_cast<int>(n));
  }
  number_ties();
  NodeGraph::Elements elements;
  collect_elements(elements);
  graph_.build(communicator_, std::move(nodes), owned_nodes, elements, matrix_);
  number_laws();
  local_residual_.assign(unknowns, 0.0);
  local_magnitude_.assign(unknowns, 0.0);
  local_lift_.assign(unknowns, 0.0);
}

void Assembler::collect_elements(NodeGraph::Elements& elements) const {
  for (const Group& group : groups_) {
    const auto& parts = group.evaluator->side_blocks();
    for (int e = 0; e < group.domain->size(); ++e) {
      for (std::size_t p = 0; p < parts.size(); ++p) {
        const int* nodes = group.domain->nodes(e, parts[p].side, parts[p].block);
        for (int a = 0; a < parts[p].nodes; ++a)
          if (const int n = blocks_[group.block_of_side_block[p]].node_index[nodes[a]]; n >= 0)
            elements.node.push_back(n);
      }
      if (!ties_.empty()) add_tied_nodes(elements);
      elements.start.push_back(elements.node.size());
    }
  }
}

void Assembler::assemble(const TimePoint& at, bool with_tangent) {
  const Stopwatch watch;
  std::fill(local_residual_.begin(), local_residual_.end(), 0.0);
  std::fill(local_magnitude_.begin(), local_magnitude_.end(), 0.0);
  std::fill(local_lift_.begin(), local_lift_.end(), 0.0);
  local_momentum_.assign(has_turning_ties_ ? local_residual_.size() : 0, 0.0);
  local_momentum_rate_.assign(local_momentum_.size(), 0.0);
  if (with_tangent) std::fill(matrix_.value.begin(), matrix_.value.end(), 0.0);
  find_pending();
  related_.reset(local_residual_.size());
  together(communicator_, [&] {
    for (Group& group : groups_) assemble_group(group, at, with_tangent);
  });
  balance_momentum(at);
  graph_.collect_vector(local_residual_);
  graph_.collect_vector(local_magnitude_);
  take_out_kept();
  if (with_tangent) {
    graph_.collect_matrix(matrix_);
    graph_.collect_vector(local_lift_);
  }
  hold_unreached(with_tangent);
  apply_laws(with_tangent);
  hold_related(with_tangent);
  is_finite_ = !communicator_.any(!all_finite(with_tangent));
  assembly_seconds_ += watch.seconds();
}

bool Assembler::all_finite(bool with_tangent) const {
  // Times zero what is finite adds nothing: one sum instead of a question for each number.
  double sum = 0;
  for (int r = 0; r < matrix_.rows; ++r)
    sum += 0.0 * full_residual_[r] + 0.0 * magnitude_[r] + 0.0 * right_side_[r];
  for (std::size_t k = 0; with_tangent && k < matrix_.entries(); ++k) sum += 0.0 * matrix_.value[k];
  return sum == 0;
}

std::string Assembler::describe_not_finite(const TimePoint& at) {
  std::string found;
  for (Group& group : groups_)
    for (int e = 0; e < group.domain->size() && found.empty(); ++e)
      found = group.evaluator->describe_not_finite(e, at);
  // That of the lowest rank that has one.
  std::vector<char> text(found.begin(), found.end());
  if (!text.empty()) text.push_back('\n');
  text = communicator_.gather_all(text);
  const auto end = std::find(text.begin(), text.end(), '\n');
  if (text.empty()) return " sums of finite numbers, which are too large";
  return {text.begin(), end};
}

template <class Term>
std::vector<double> Assembler::sum_rows(const PerUnknown& vector, const Term& term) const {
  std::vector<double> number(pending_.size(), 0.0);  // per local unknown
  for (const NumberedBlock& b : blocks_)
    for (std::size_t node = 0; node < b.node_index.size(); ++node) {
      if (b.node_index[node] < 0) continue;
      const int first = graph_.node(b.node_index[node]).first;
      for (int c = 0; c < b.block->size; ++c)
        number[first + c] = vector(*b.field, *b.block, static_cast<int>(node), c);
    }
  std::vector<double> result(matrix_.rows, 0.0);
  for (int r = 0; r < matrix_.rows; ++r)
    for (std::size_t k = matrix_.row_start[r]; k < matrix_.row_start[r + 1]; ++k)
      if (const auto column = static_cast<std::size_t>(matrix_.column[k]); column < number.size())
        result[r] += term(matrix_.value[k], number[column]);
  return result;
}

std::vector<double> Assembler::absolute_product(const PerUnknown& size) const {
  return sum_rows(size, [](double entry, double number) { return std::abs(entry * number); });
}

std::vector<double> Assembler::largest_by_kind(const std::vector<double>& of_rows) const {
  std::vector<double> largest;
  for (const NumberedBlock& b : blocks_) {
    const std::size_t kind = largest.size();
    largest.resize(kind + b.block->size, 0.0);
    for (int node = 0; node < b.block->space->owned_nodes(); ++node)
      for (int c = 0; c < b.block->size && b.node_index[node] >= 0; ++c)
        largest[kind + c] =
            std::max(largest[kind + c], std::abs(of_rows[graph_.node(b.node_index[node]).first + c]));
  }
  communicator_.max(largest);
  return largest;
}

/// Sizes that the components of a block have by their nature, see Unknown. Collective.
std::vector<double> Assembler::scales(const NumberedBlock& b) const {
  const Mesh& mesh = b.field->mesh();
  double cell = 0;
  for (int c = 0; c < mesh.owned_cells(); ++c) cell = std::max(cell, mesh.diameter(c));
  cell = communicator_.max(cell);
  std::vector<double> result(b.block->size, 0.0);
  for (const Unknown& unknown : b.field->unknowns()) {
    const Field::ComponentRange place = b.field->place(unknown.name);
    if (&b.field->blocks()[place.block] != b.block) continue;
    const double scale = unknown.role == UnknownRole::motion ? std::max(unknown.scale, cell) : unknown.scale;
    std::fill_n(result.begin() + place.offset, place.components, scale);
  }
  return result;
}

std::vector<double> Assembler::rounding() const {
  constexpr double spacing = std::numeric_limits<double>::epsilon();
  std::map<const Block*, std::vector<double>> added;  // to the size of each component of a block
  for (const NumberedBlock& b : blocks_) added[b.block] = scales(b);
  // Roundings are as often up as down: their squares add up.
  std::vector<double> squares = sum_rows(
      [&](const Field&, const Block& block, int node, int c) {
        const std::size_t i = static_cast<std::size_t>(node) * block.size + c;
        // What has gone leaves the rounding of what it was, as a pressure of contact.
        return spacing *
               (std::max(std::abs(block.now.value[i]), std::abs(block.old.value[i])) + added.at(&block)[c]);
      },
      [](double entry, double size) { return entry * size * entry * size; });
  // What is held or tied has no equation but its own identity, in which nothing is rounded.
  for (int r = 0; r < matrix_.rows; ++r) squares[r] = relation_[r] == is_free ? std::sqrt(squares[r]) : 0;
  return squares;
}

TimePoint by_rates(TimePoint at, double rate_factor, double second_rate_factor) {
  at.value_factor = 0;
  at.rate_factor = rate_factor;
  at.second_rate_factor = second_rate_factor;
  at.frozen = true;
  return at;
}

void Assembler::find_element_nodes(const Group& group, int element) {
  element_nodes_.clear();
  const auto& parts = group.evaluator->side_blocks();
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const int* nodes = group.domain->nodes(element, parts[p].side, parts[p].block);
    for (int a = 0; a < parts[p].nodes; ++a)
      element_nodes_.push_back(blocks_[group.block_of_side_block[p]].node_index[nodes[a]]);
  }
}

void Assembler::assemble_group(Group& group, const TimePoint& at, bool with_tangent) {
  ElementEvaluator& element = *group.evaluator;
  for (int e = 0; e < group.domain->size(); ++e) {
    element.compute(e, at, with_tangent);
    find_element_nodes(group, e);
    // What is handed on does not change with second rates.
    scatter_vector(element, with_tangent && !at.initial_rates);
    if (with_tangent) scatter_matrix(element);
    if (at.step > 0 && element_turns()) {
      if (at.inertia_as_momentum && element.has_inertia()) assemble_momentum(group, e, at, with_tangent);
      if (with_tangent) {
        element.compute(e, by_rates(at, 1, at.rate_factor), true);
        scatter_rate_matrix(element, at.rate_factor);
      }
    }
    add_related_sums();
  }
}

void Assembler::scatter_vector(const ElementEvaluator& element, bool with_tangent) {
  const int* node = element_nodes_.data();
  for (const auto& side_block : element.side_blocks())
    for (int a = 0; a < side_block.nodes; ++a, ++node) {
      if (*node < 0) continue;
      const int first = graph_.node(*node).first;
      for (int c = 0; c < side_block.components; ++c) {
        const double residual = element.residual()[side_block.offset + c * side_block.stride + a];
        const double magnitude = element.magnitude()[side_block.offset + c * side_block.stride + a];
        local_residual_[first + c] += residual;
        local_magnitude_[first + c] += magnitude;
        if (const int tie = relation_[first + c]; tie >= 0)
          hand_on(ties_[tie], residual, magnitude, with_tangent);
      }
    }
}

void Assembler::scatter_matrix(const ElementEvaluator& element) {
  const int size = element.size();
  const int* row_node = element_nodes_.data();
  for (const auto& rows : element.side_blocks())
    for (int a = 0; a < rows.nodes; ++a, ++row_node) {
      if (*row_node < 0) continue;
      const int* column_node = element_nodes_.data();
      for (const auto& columns : element.side_blocks())
        for (int b = 0; b < columns.nodes; ++b, ++column_node) {
          if (*column_node < 0) continue;
          const double* from =
              &element.matrix()[static_cast<std::size_t>(rows.offset + a) * size + columns.offset + b];
          const NodeBlock block{from, static_cast<std::ptrdiff_t>(rows.stride) * size, columns.stride,
                                rows.components, columns.components};
          if (node_has_relations_[*row_node] || node_has_relations_[*column_node])
            add_related_block(*row_node, *column_node, block);
          else
            add_free_block(*row_node, *column_node, block);
        }
    }
}

void Assembler::add_free_block(int row_node, int column_node, const NodeBlock& block) {
  const NodeGraph::BlockEntries at = graph_.place(row_node, column_node);
  double* to = matrix_.value.data + at.first;
  for (int i = 0; i < block.rows; ++i, to += at.row_length)
    for (int j = 0; j < block.columns; ++j)
      to[j] += block.from[i * block.row_stride + j * block.column_stride];
}

/// Rows of prescribed unknowns are left out; their columns act on the way they have still to go. Those of
/// tied ones go to the rows and columns of what they are tied to.
void Assembler::add_related_block(int row_node, int column_node, const NodeBlock& block) {
  const int first_row = graph_.node(row_node).first, first_column = graph_.node(column_node).first;
  for (int i = 0; i < block.rows; ++i)
    for (int j = 0; j < block.columns; ++j) {
      const double value = block.from[i * block.row_stride + j * block.column_stride];
      const int relation = relation_[first_row + i];
      if (relation < 0)
        add_to_row(first_row + i, value, first_column + j);
      else
        for (const Tie::To& to : ties_[relation].to)
          add_to_row(to.to.unknown, to.handed * value, first_column + j);
    }
}

/// Prescribed and tied unknowns keep their value: identity rows, and their residual is the force that holds
/// them.
void Assembler::hold_related(bool with_tangent) {
  full_residual_.assign(local_residual_.begin(), local_residual_.begin() + matrix_.rows);
  magnitude_.assign(local_magnitude_.begin(), local_magnitude_.begin() + matrix_.rows);
  residual_ = full_residual_;
  right_side_.resize(matrix_.rows);
  for (int r = 0; r < matrix_.rows; ++r) {
    if (relation_[r] == is_free) {
      right_side_[r] = -(residual_[r] + local_lift_[r]);
      continue;
    }
    residual_[r] = right_side_[r] = 0;
    for (std::size_t k = matrix_.row_start[r]; with_tangent && k < matrix_.row_start[r + 1]; ++k)
      if (matrix_.column[k] == r) matrix_.value[k] = 1.0;
  }
}

void Assembler::add_increment(const std::vector<double>& increment, double factor) {
  std::vector<double> remaining = ways_of_ties();
  for (double& way : remaining) way *= 1 - factor;
  for (NumberedBlock& b : blocks_) {
    for (int node = 0; node < b.block->space->owned_nodes(); ++node) {
      if (b.node_index[node] < 0) continue;
      const int first = graph_.node(b.node_index[node]).first;
      for (int c = 0; c < b.block->size; ++c) {
        const std::size_t i = static_cast<std::size_t>(node) * b.block->size + c;
        const bool prescribed = relation_[first + c] == is_prescribed;
        const double way =
            prescribed ? b.block->prescribed_value[i] - b.block->now.value[i] : increment[first + c];
        // The last part of the way ends exactly at the value.
        b.block->now.value[i] =
            prescribed && factor == 1.0 ? b.block->prescribed_value[i] : b.block->now.value[i] + factor * way;
      }
    }
    b.block->space->halo().update(b.block->now.value, b.block->size);
  }
  for (Field* field : fields_) field->show_left_out();
  if (has_ties_) settle_ties(remaining);
}

/// Calls back with [block][unknown of a local node] and the row of each unknown of this rank.
template <class Use>
void Assembler::for_each_own(const Use& use) const {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Block& block = *blocks_[b].block;
    for (int node = 0; node < block.space->owned_nodes(); ++node)
      for (int c = 0; c < block.size && blocks_[b].node_index[node] >= 0; ++c)
        use(b, static_cast<std::size_t>(node) * block.size + c,
            graph_.node(blocks_[b].node_index[node]).first + c);
  }
}

void Assembler::keep_residual() {
  kept_residual_.clear();
  for (const NumberedBlock& b : blocks_) kept_residual_.emplace_back(b.block->now.value.size(), 0.0);
  for_each_own(
      [&](std::size_t b, std::size_t state, int row) { kept_residual_[b][state] = local_residual_[row]; });
  meet_laws_as_they_are();
}

void Assembler::take_out_kept() {
  if (left_out_ == 0) return;
  for_each_own([&](std::size_t b, std::size_t state, int row) {
    if (state >= kept_residual_[b].size()) return;  // it has come alive since
    const double part = left_out_ * kept_residual_[b][state];
    local_residual_[row] -= part;
    local_magnitude_[row] += std::abs(part);
  });
}

void Assembler::find_pending() {
  for (const NumberedBlock& b : blocks_)
    for (std::size_t node = 0; node < b.node_index.size(); ++node) {
      if (b.node_index[node] < 0 || !node_has_relations_[b.node_index[node]]) continue;
      const int first = graph_.node(b.node_index[node]).first;
      for (int c = 0; c < b.block->size; ++c) {
        const std::size_t i = node * b.block->size + c;
        pending_[first + c] = relation_[first + c] == is_prescribed
                                  ? b.block->prescribed_value[i] - b.block->now.value[i]
                                  : 0.0;
      }
    }
  for (const Tie& tie : ties_) pending_[tie.tied.unknown] = way_of(tie);
}

bool Assembler::prescribed_pending() const {
  bool any = ties_pending();
  for (std::size_t u = 0; u < pending_.size() && !any; ++u)
    any = relation_[u] == is_prescribed && pending_[u] != 0.0;
  return communicator_.any(any);
}

int Assembler::row(const Field& field, int block, int node, int component) const {
  for (const NumberedBlock& b : blocks_)
    if (b.block == &field.blocks()[block])
      return b.node_index[node] < 0 ? -1 : graph_.node(b.node_index[node]).first + component;
  return -1;
}

void Assembler::name_unknowns() {
  matrix_.unknown.clear();
  long long before = 0;  // all unknowns that the blocks in front could ever have
  for (const NumberedBlock& b : blocks_) {
    const Space& space = *b.block->space;
    for (int node = 0; node < space.owned_nodes(); ++node)
      for (int c = 0; c < b.block->size && b.node_index[node] >= 0; ++c)
        matrix_.unknown.push_back(before + static_cast<long long>(space.global_node(node)) * b.block->size +
                                  c);
    before += static_cast<long long>(space.global_bound()) * b.block->size;
  }
}

std::vector<EquationBlock> Assembler::equation_blocks() const {
  std::vector<EquationBlock> result;
  for (const Field* field : fields_) {
    EquationBlock block;
    block.field = field->name();
    block.dimension = field->mesh().dimension();
    for (const Unknown& unknown : field->unknowns()) {
      if (unknown.given) continue;
      const Field::ComponentRange place = field->place(unknown.name);
      const Space& space = *field->blocks()[place.block].space;
      EquationUnknown equations{
          unknown.name, unknown.components, unknown.role, unknown.near_nullspace, unknown.scale, {}, {}};
      for (int node = 0; node < space.owned_nodes(); ++node) {
        const int first = row(*field, place.block, node, place.offset);
        if (first < 0) continue;
        for (int c = 0; c < place.components; ++c) equations.rows.push_back(first + c);
        const double* x = space.position(node);
        equations.coordinates.insert(equations.coordinates.end(), x, x + block.dimension);
      }
      block.count += static_cast<int>(equations.rows.size());
      block.unknowns.push_back(std::move(equations));
    }
    block.first = result.empty() ? 0 : result.back().first + result.back().count;
    if (!block.unknowns.empty()) result.push_back(std::move(block));
  }
  return result;
}

}  // namespace seam
