// SPDX-License-Identifier: BSD-3-Clause
#include "seam/assembly/evaluator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "seam/assembly/binding.hpp"
#include "seam/assembly/limits.hpp"
#include "seam/assembly/steady_part.hpp"
#include "seam/base/plugin_fault.hpp"
#include "seam/field/field.hpp"

namespace seam {
namespace {

/// The first point of a batch at which a term fails by itself.
int failing_point(const Term& term, const PointBatch& batch) {
  const Signature& signature = term.signature(batch.dimension);
  const int inputs = signature.input_size(batch.dimension),
            outputs = signature.output_size(batch.dimension) + signature.values;
  std::vector<double> result(static_cast<std::size_t>(outputs));
  for (int q = 0; q < batch.count; ++q) {
    PointBatch one = batch;
    one.count = 1;
    one.moves = 0;
    const auto skip = [q](const double*& list, int width) {
      if (list) list += static_cast<std::ptrdiff_t>(q) * width;
    };
    for (const double** list : {&one.position, &one.normal, &one.partner_position})
      skip(*list, batch.dimension);
    for (const double** list :
         {&one.cell_size, &one.trace_size, &one.gap, &one.constant[0], &one.constant[1]})
      skip(*list, 1);
    skip(one.inputs, inputs);
    try {
      term.evaluate(one, result.data(), nullptr);
    } catch (...) {
      return q;
    }
  }
  return 0;  // it fails where it is differentiated only, or by what it remembers
}

}  // namespace

ElementEvaluator::~ElementEvaluator() = default;

bool BoundTerm::holds(const Element& element) const {
  return std::ranges::all_of(regions, [&](const Region& r) {
    const ElementSide& side = element.sides[r.side];
    return side.field->region(side.global_cell) == r.region;
  });
}

const double* ElementEvaluator::Operators::of(Shape shape) const {
  switch (shape) {
    case Shape::value:
      return value;
    case Shape::gradient:
      return gradient.data();
    case Shape::normal_derivative:
      return normal.data();
    case Shape::second_normal_derivative:
      return second_normal.data();
  }
  return nullptr;
}

ElementEvaluator::ElementEvaluator(const IntegrationDomain& domain, const std::vector<BoundTerm>& terms,
                                   Role role)
    : domain_(&domain), role_(role) {
  dim_ = domain.fields().front()->mesh().dimension();
  for (const BoundTerm& bound : terms) check_binding(bound, domain);
  find_side_blocks(domain, terms);
  operators_.resize(side_blocks_.size());
  for (const BoundTerm& bound : terms) {
    const Signature& s = bound.term->signature(dim_);
    Compiled compiled{bound, &s, {}, s.input_size(dim_), s.output_size(dim_) + s.values, s.column_size(dim_)};
    if (compiled.columns > most_columns)
      throw PluginFault(bound.where, fmt::format("{} reads {} numbers at a point; {} at most are possible",
                                                 describe(bound, domain), compiled.columns, most_columns));
    for (std::size_t k = 0; k < s.components.size(); ++k) {
      const Operand& operand = bound.operands[k];
      const Field::ComponentRange place = domain.fields().at(operand.side)->place(operand.unknown);
      const auto side_block = std::find_if(side_blocks_.begin(), side_blocks_.end(), [&](const SideBlock& p) {
        return p.side == operand.side && p.block == place.block;
      });
      compiled.operands.push_back(
          {static_cast<int>(side_block - side_blocks_.begin()), place.offset, place.components});
    }
    for (const auto* slots : {&s.inputs, &s.outputs})
      for (const Slot& slot : *slots) {
        Operators& operators = operators_[compiled.operands[slot.operand].side_block];
        operators.needs_gradient |= slot.shape == Shape::gradient || slot.shape == Shape::normal_derivative;
        operators.needs_normal |= slot.shape == Shape::normal_derivative;
        operators.needs_second_normal |= slot.shape == Shape::second_normal_derivative;
        if (!movers_.empty() && operators.needs_normal)
          throw PluginFault(bound.where,
                            describe(bound, domain) +
                                " reads normal derivatives: use gradient and normal where points move");
        level_used_[static_cast<int>(slot.level)] = true;
      }
    terms_.push_back(std::move(compiled));
  }
}

void ElementEvaluator::find_side_blocks(const IntegrationDomain& domain,
                                        const std::vector<BoundTerm>& terms) {
  const std::vector<Field*> fields = domain.fields();
  for (const BoundTerm& bound : terms)
    for (const Operand& operand : bound.operands) add_side_block(*fields.at(operand.side), operand);
  if (role_ != Role::integrate_at_rest)
    for (const Operand& mover : domain.movers()) {
      Field& body = *fields.at(mover.side);
      movers_.push_back({add_side_block(body, mover), body.place(mover.unknown).offset});
    }
  moves_ = static_cast<int>(movers_.size()) * dim_ * dim_;
  if (moves_ > most_moves)
    throw PluginFault(
        terms.empty() ? Location() : terms.front().where,
        fmt::format("the points of {}{} move with {} facets; {} at most are possible", domain.description(),
                    plugin_of(domain), movers_.size(), most_moves / (dim_ * dim_)));
  for (SideBlock& side_block : side_blocks_) {
    side_block.offset = size_;
    size_ += side_block.stride * side_block.components;
  }
}

/// The part of an operand's block, which is added if it is new.
int ElementEvaluator::add_side_block(Field& field, const Operand& operand) {
  const int b = field.place(operand.unknown).block;
  const auto known = std::find_if(side_blocks_.begin(), side_blocks_.end(),
                                  [&](const SideBlock& p) { return p.side == operand.side && p.block == b; });
  if (known != side_blocks_.end()) return static_cast<int>(known - side_blocks_.begin());
  Block& block = field.blocks()[b];
  const int nodes = block.space->nodes_per_cell();
  side_blocks_.push_back({operand.side, b, &block, nodes, (nodes + 3) / 4 * 4, block.size, 0});
  return static_cast<int>(side_blocks_.size()) - 1;
}

void ElementEvaluator::compute(int index, const TimePoint& at, bool with_tangent) {
  domain_->fill(index, element_);
  residual_.assign(size_, 0.0);
  magnitude_.assign(size_, 0.0);
  if (with_tangent) matrix_.assign(static_cast<std::size_t>(size_) * size_, 0.0);
  moves_now_ = with_tangent && moves_ > 0 && !at.initial_rates && !at.frozen;
  if (role_ == Role::sweep && !moves_now_) return;
  compute_operators();
  gather();
  if (moves_now_ && role_ == Role::integrate) {
    compute_reference_motion();
    compute_partner_motion();
  }
  for (const Compiled& term : terms_) {
    if (!term.bound.holds(element_)) continue;
    compute_inputs(term);
    if (role_ == Role::sweep) {
      evaluate(term, at, false);
      add_sweep(term);
      continue;
    }
    if (moves_now_ && term.signature->follows_motion) compute_input_change(term);
    evaluate(term, at, with_tangent);
    add_residual(term);
    if (with_tangent && term.columns > 0) add_tangent(term);
    if (moves_now_ && term.signature->follows_motion) add_motion_tangent(term);
  }
  if (with_tangent && role_ != Role::sweep) add_change_to_magnitude();
}

void ElementEvaluator::add_change_to_magnitude() {
  change_.assign(size_, 0.0);
  for (const SideBlock& side_block : side_blocks_) {
    const int* nodes = element_.sides[side_block.side].nodes[side_block.block];
    for (int a = 0; a < side_block.nodes; ++a)
      for (int c = 0; c < side_block.components; ++c) {
        const std::size_t i = static_cast<std::size_t>(nodes[a]) * side_block.components + c;
        change_[side_block.offset + c * side_block.stride + a] =
            std::abs(side_block.states->now.value[i] - side_block.states->old.value[i]) +
            steady_part * std::abs(side_block.states->now.value[i]);
      }
  }
  add_absolute_product(size_, matrix_.data(), change_.data(), magnitude_.data());
}

const std::vector<double>& ElementEvaluator::compute_values(int index, const TimePoint& at) {
  domain_->fill(index, element_);
  point_residual_.clear();
  const auto term = std::ranges::find_if(terms_, [&](const Compiled& t) { return t.bound.holds(element_); });
  if (term == terms_.end()) return point_residual_;
  compute_operators();
  gather();
  compute_inputs(*term);
  evaluate(*term, at, false);
  return point_residual_;
}

void ElementEvaluator::compute_operators() {
  const int points = element_.points;
  for (std::size_t p = 0; p < side_blocks_.size(); ++p) {
    const SideBlock& side_block = side_blocks_[p];
    const ElementSide& side = element_.sides[side_block.side];
    const ShapeTable& table = side.functions(side_block.block, side_block.states->space->order());
    Operators& operators = operators_[p];
    operators.value = table.value.data();
    if (operators.needs_gradient) {
      const int n = table.stride;
      operators.gradient.assign(static_cast<std::size_t>(points) * dim_ * n, 0.0);
      for (int q = 0; q < points; ++q)
        for (int i = 0; i < dim_; ++i) {
          double* row = &operators.gradient[(static_cast<std::size_t>(q) * dim_ + i) * n];
          for (int j = 0; j < table.dimension; ++j) {
            const double factor = side.inverse_jacobian[(static_cast<std::size_t>(q) * dim_ + j) * dim_ + i];
            const double* reference = table.gradient_at(q) + static_cast<std::ptrdiff_t>(j) * n;
            for (int a = 0; a < n; ++a) row[a] += factor * reference[a];
          }
        }
    }
    if (operators.needs_normal || operators.needs_second_normal)
      compute_normal_operators(static_cast<int>(p));
    if (moves_now_ && role_ == Role::integrate && operators.needs_gradient)
      compute_gradient_change(static_cast<int>(p));
  }
}

void ElementEvaluator::compute_normal_operators(int p) {
  const ElementSide& side = element_.sides[side_blocks_[p].side];
  const ShapeTable& table = side.functions(side_blocks_[p].block, side_blocks_[p].states->space->order());
  Operators& operators = operators_[p];
  const int n = table.stride;
  operators.normal.assign(static_cast<std::size_t>(element_.points) * n, 0.0);
  operators.second_normal.assign(operators.needs_second_normal ? operators.normal.size() : 0, 0.0);
  for (int q = 0; q < element_.points; ++q) {
    const double* normal = &element_.normal[static_cast<std::size_t>(q) * dim_];
    double direction[3] = {0, 0, 0};  // the normal in reference coordinates
    for (int j = 0; j < dim_; ++j)
      for (int i = 0; i < dim_; ++i)
        direction[j] +=
            side.inverse_jacobian[(static_cast<std::size_t>(q) * dim_ + j) * dim_ + i] * normal[i];
    for (int a = 0; a < n; ++a)
      for (int j = 0; j < dim_; ++j) {
        operators.normal[static_cast<std::size_t>(q) * n + a] +=
            direction[j] * table.gradient_at(q)[j * n + a];
        // Exact on affine cells; on curved ones the map's own curvature, of higher order, is left out.
        for (int k = 0; k < dim_ && operators.needs_second_normal; ++k)
          operators.second_normal[static_cast<std::size_t>(q) * n + a] +=
              direction[j] * direction[k] * table.hessian_at(q)[(j * dim_ + k) * n + a];
      }
  }
}

/// Copies the nodal values of the element, component-major.
void ElementEvaluator::gather() {
  for (int level = 0; level < 5; ++level) {
    if (!level_used_[level]) continue;
    local_[level].assign(size_, 0.0);
    for (const SideBlock& side_block : side_blocks_) {
      const NodalState& now = side_block.states->now;
      const NodalState& old = side_block.states->old;
      const std::vector<double>* from[5] = {&now.value, &now.rate, &now.second_rate, &old.value, &old.rate};
      const int* nodes = element_.sides[side_block.side].nodes[side_block.block];
      double* to = &local_[level][side_block.offset];
      for (int a = 0; a < side_block.nodes; ++a)
        for (int c = 0; c < side_block.components; ++c)
          to[c * side_block.stride + a] =
              (*from[level])[static_cast<std::size_t>(nodes[a]) * side_block.components + c];
    }
  }
}

void ElementEvaluator::compute_inputs(const Compiled& term) {
  inputs_.resize(static_cast<std::size_t>(element_.points) * term.inputs);
  int at = 0;
  for (const Slot& slot : term.signature->inputs) {
    const BoundOperand& operand = term.operands[slot.operand];
    const SideBlock& side_block = side_blocks_[operand.side_block];
    const int r = rows(slot.shape, dim_), n = side_block.stride;
    const double* shape = operators_[operand.side_block].of(slot.shape);
    const double* values = &local_[static_cast<int>(slot.level)][side_block.offset + operand.offset * n];
    for (int q = 0; q < element_.points; ++q)
      for (int c = 0; c < operand.components; ++c)
        for (int i = 0; i < r; ++i) {
          const double* row = shape + (static_cast<std::ptrdiff_t>(q) * r + i) * n;
          double sum = 0;
          for (int a = 0; a < n; ++a) sum += row[a] * values[c * n + a];
          inputs_[static_cast<std::size_t>(q) * term.inputs + at + c * r + i] = sum;
        }
    at += operand.components * r;
  }
}

void ElementEvaluator::evaluate(const Compiled& term, const TimePoint& at, bool with_tangent) {
  double factors[most_operands][3];
  for (std::size_t k = 0; k < term.operands.size(); ++k) {
    const BoundOperand& operand = term.operands[k];
    const int order = side_blocks_[operand.side_block].states->time_order[operand.offset];
    factors[k][0] = at.initial_rates && order > 0 ? 0.0 : at.value_factor;
    factors[k][1] = at.initial_rates ? (order == 1 ? 1.0 : 0.0) : at.rate_factor;
    factors[k][2] = at.initial_rates ? (order == 2 ? 1.0 : 0.0) : at.second_rate_factor;
  }
  PointBatch batch;
  batch.dimension = dim_;
  batch.count = element_.points;
  batch.position = element_.sides[0].position.data();
  batch.normal = element_.normal.empty() ? nullptr : element_.normal.data();
  batch.cell_size = element_.cell_size.data();
  batch.trace_size = element_.trace_size.data();
  if (element_.sides.size() > 1) batch.partner_position = element_.sides[1].position.data();
  for (std::size_t k = 0; k < term.bound.constants.size(); ++k)
    if (term.bound.constants[k] >= 0) batch.constant[k] = element_.constants[term.bound.constants[k]].data();
  if (!element_.gap.empty()) batch.gap = element_.gap.data();
  batch.inputs = inputs_.data();
  batch.time = at.time;
  batch.step = at.step;
  batch.theta = at.theta;
  batch.level_factor = factors;
  if (moves_now_ && with_tangent && term.signature->follows_motion) {
    batch.moves = moves_;
    if (!element_.motion->gap.empty()) batch.gap_change = element_.motion->gap.data();
    batch.position_change = element_.motion->position.data();
    batch.normal_change = element_.motion->normal.data();
    if (batch.partner_position) batch.partner_change = partner_motion_.data();
    batch.input_change = input_change_.data();
  }
  const int columns = term.columns + batch.moves;
  point_residual_.resize(static_cast<std::size_t>(element_.points) * term.outputs);
  point_tangent_.resize(point_residual_.size() * columns);
  try {
    term.bound.term->evaluate(batch, point_residual_.data(),
                              with_tangent && columns > 0 ? point_tangent_.data() : nullptr);
  } catch (const StepRefused&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) {
    const std::string text = text_of_exception();
    throw PluginFault(term.bound.where, fmt::format("{} failed {}: {}", describe(term.bound, *domain_),
                                                    place_of(failing_point(*term.bound.term, batch)), text));
  }
}

void ElementEvaluator::add_residual(const Compiled& term) {
  int at = 0;
  for (const Slot& slot : term.signature->outputs) {
    const BoundOperand& operand = term.operands[slot.operand];
    const SideBlock& side_block = side_blocks_[operand.side_block];
    const int r = rows(slot.shape, dim_), n = side_block.stride;
    const double* shape = operators_[operand.side_block].of(slot.shape);
    for (int c = 0; c < operand.components; ++c) {
      double* target = &residual_[side_block.offset + (operand.offset + c) * n];
      double* scale = &magnitude_[side_block.offset + (operand.offset + c) * n];
      for (int q = 0; q < element_.points; ++q)
        for (int i = 0; i < r; ++i) {
          const double coefficient =
              element_.weight[q] *
              point_residual_[static_cast<std::size_t>(q) * term.outputs + at + c * r + i];
          const double* row = shape + (static_cast<std::ptrdiff_t>(q) * r + i) * n;
          for (int a = 0; a < n; ++a) {
            target[a] += coefficient * row[a];
            scale[a] += std::abs(coefficient * row[a]);
          }
        }
    }
    at += operand.components * r;
  }
}

void ElementEvaluator::add_tangent(const Compiled& term) {
  const auto operators_of = [&](const std::vector<Slot>& slots, std::vector<SlotOperator>& result) {
    result.clear();
    for (const Slot& slot : slots) {
      const BoundOperand& operand = term.operands[slot.operand];
      const SideBlock& side_block = side_blocks_[operand.side_block];
      result.push_back({operators_[operand.side_block].of(slot.shape), rows(slot.shape, dim_),
                        side_block.stride, operand.components,
                        side_block.offset + operand.offset * side_block.stride});
    }
  };
  operators_of(term.signature->outputs, work_.outputs);
  operators_of(term.signature->columns, work_.columns);
  int first = size_, end = 0;
  for (const SlotOperator& column : work_.columns) {
    first = std::min(first, column.offset);
    end = std::max(end, column.offset + column.components * column.stride);
  }
  work_.points = element_.points;
  work_.weight = element_.weight.data();
  work_.tangent = point_tangent_.data();
  work_.tangent_columns = term.columns + (moves_now_ && term.signature->follows_motion ? moves_ : 0);
  work_.first_column = first;
  work_.width = end - first;
  work_.matrix = matrix_.data();
  work_.matrix_stride = size_;
  contract(work_, scratch_);
}

}  // namespace seam
