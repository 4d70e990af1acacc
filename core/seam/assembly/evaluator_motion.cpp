// SPDX-License-Identifier: BSD-3-Clause
// How integrals over a surface that moves with a body change with the body's nodes.
#include "seam/assembly/evaluator.hpp"
#include "seam/assembly/limits.hpp"
#include "seam/field/field.hpp"

namespace seam {

/// Derivatives of the physical gradient G = D J^-1 (D: reference gradient, J: the map's Jacobian):
/// dG = (dD - G dJ) J^-1.
void ElementEvaluator::compute_gradient_change(int p) {
  const ElementSide& side = element_.sides[side_blocks_[p].side];
  const ShapeTable& table = side.functions(side_blocks_[p].block, side_blocks_[p].states->space->order());
  const ShapeTable& map = *side.table[side.field->mesh().order() - 1];
  Operators& operators = operators_[p];
  const int n = table.stride;
  operators.gradient_change.assign(static_cast<std::size_t>(element_.points) * dim_ * dim_ * n, 0.0);
  for (int q = 0; q < element_.points; ++q)
    for (int j = 0; j < dim_; ++j) {
      double jacobian_change[3][3] = {};  // d(dx_i / dxi_k) / dxi_j
      for (int i = 0; i < dim_; ++i)
        for (int k = 0; k < dim_; ++k)
          for (int a = 0; a < map.nodes; ++a)
            jacobian_change[i][k] +=
                map.hessian_at(q)[(k * dim_ + j) * map.stride + a] * side.geometry[a * dim_ + i];
      double* to = &operators.gradient_change[(static_cast<std::size_t>(q) * dim_ + j) * dim_ * n];
      for (int k = 0; k < dim_; ++k) {
        const double* second = table.hessian_at(q) + static_cast<std::ptrdiff_t>(k * dim_ + j) * n;
        for (int i = 0; i < dim_; ++i) {
          const double inverse = side.inverse_jacobian[(static_cast<std::size_t>(q) * dim_ + k) * dim_ + i];
          for (int a = 0; a < n; ++a) to[i * n + a] += inverse * second[a];
          for (int l = 0; l < dim_; ++l) {
            const double* gradient = &operators.gradient[(static_cast<std::size_t>(q) * dim_ + l) * n];
            const double factor = inverse * jacobian_change[l][k];
            for (int a = 0; a < n; ++a) to[i * n + a] -= factor * gradient[a];
          }
        }
      }
    }
}

/// How fast the points pass through the reference coordinates of each side. The mover's side moves along: its
/// points slide only as far as the other side makes them.
void ElementEvaluator::compute_reference_motion() {
  const int moves = moves_;
  reference_motion_.resize(element_.sides.size());
  for (std::size_t s = 0; s < element_.sides.size(); ++s) {
    std::vector<double>& motion = reference_motion_[s];
    if (!element_.motion->reference.at(s).empty()) {
      motion = element_.motion->reference[s];
      continue;
    }
    const std::vector<double>& inverse = element_.sides[s].inverse_jacobian;
    motion.assign(static_cast<std::size_t>(element_.points) * dim_ * moves, 0.0);
    for (int q = 0; q < element_.points; ++q)
      for (int j = 0; j < dim_; ++j)
        for (int i = 0; i < dim_; ++i)
          for (int m = 0; m < moves; ++m)
            motion[(static_cast<std::size_t>(q) * dim_ + j) * moves + m] +=
                inverse[(static_cast<std::size_t>(q) * dim_ + j) * dim_ + i] *
                element_.motion->position[(static_cast<std::size_t>(q) * dim_ + i) * moves + m];
  }
}

/// How the points pass through the reference configuration of side 1's mesh.
void ElementEvaluator::compute_partner_motion() {
  if (element_.sides.size() < 2) return;
  const int moves = moves_;
  const ElementSide& side = element_.sides[1];
  const ShapeTable& map = *side.table[side.field->mesh().order() - 1];
  partner_motion_.assign(static_cast<std::size_t>(element_.points) * dim_ * moves, 0.0);
  for (int q = 0; q < element_.points; ++q)
    for (int i = 0; i < dim_; ++i)
      for (int j = 0; j < dim_; ++j) {
        double slope = 0;  // dx_i / dxi_j
        for (int a = 0; a < map.nodes; ++a)
          slope += map.gradient_at(q)[j * map.stride + a] * side.geometry[a * dim_ + i];
        for (int m = 0; m < moves; ++m)
          partner_motion_[(static_cast<std::size_t>(q) * dim_ + i) * moves + m] +=
              slope * reference_motion_[1][(static_cast<std::size_t>(q) * dim_ + j) * moves + m];
      }
}

const double* ElementEvaluator::shape_change(const Slot& slot, int p, int q, int j, int i) const {
  const SideBlock& side_block = side_blocks_[p];
  if (slot.shape == Shape::value) {
    const ShapeTable& table =
        element_.sides[side_block.side].functions(side_block.block, side_block.states->space->order());
    return table.gradient_at(q) + static_cast<std::ptrdiff_t>(j) * side_block.stride;
  }
  return &operators_[p]
              .gradient_change[((static_cast<std::size_t>(q) * dim_ + j) * dim_ + i) * side_block.stride];
}

void ElementEvaluator::compute_input_change(const Compiled& term) {
  const int moves = moves_;
  input_change_.assign(static_cast<std::size_t>(element_.points) * term.inputs * moves, 0.0);
  int at = 0;
  for (const Slot& slot : term.signature->inputs) {
    const BoundOperand& operand = term.operands[slot.operand];
    const SideBlock& side_block = side_blocks_[operand.side_block];
    const int r = rows(slot.shape, dim_), n = side_block.stride;
    const double* values = &local_[static_cast<int>(slot.level)][side_block.offset + operand.offset * n];
    const std::vector<double>& motion = reference_motion_[side_block.side];
    for (int q = 0; q < element_.points; ++q)
      for (int c = 0; c < operand.components; ++c)
        for (int i = 0; i < r; ++i) {
          double* to = &input_change_[(static_cast<std::size_t>(q) * term.inputs + at + c * r + i) * moves];
          for (int j = 0; j < dim_; ++j) {
            const double* change = shape_change(slot, operand.side_block, q, j, i);
            double slope = 0;
            for (int a = 0; a < n; ++a) slope += change[a] * values[c * n + a];
            for (int m = 0; m < moves; ++m)
              to[m] += slope * motion[(static_cast<std::size_t>(q) * dim_ + j) * moves + m];
          }
        }
    at += operand.components * r;
  }
}

/// Adds `count` rows of derivatives with respect to the moves of point q. @param rows [row][move]
void ElementEvaluator::scatter_moves(int q, int row, int count, const double* rows) {
  const int* node = &element_.motion->node[static_cast<std::size_t>(q) * movers_.size() * dim_];
  for (const Mover& mover : movers_) {
    const SideBlock& body = side_blocks_[mover.side_block];
    for (int k = 0; k < dim_; ++k, ++node)
      for (int c = 0; c < dim_; ++c, ++rows) {
        const int column = body.offset + (mover.offset + c) * body.stride + *node;
        for (int a = 0; a < count; ++a)
          matrix_[static_cast<std::size_t>(row + a) * size_ + column] += rows[a * moves_];
      }
  }
}

/// For all test functions of a term at all points: lets `add` fill the derivatives with respect to the
/// point's moves, [node][move], direction by direction of the test function, and adds them to the matrix.
template <class Add>
void ElementEvaluator::add_moves(const Compiled& term, const Add& add) {
  int at = 0;
  for (const Slot& slot : term.signature->outputs) {
    const BoundOperand& operand = term.operands[slot.operand];
    const SideBlock& side_block = side_blocks_[operand.side_block];
    const int directions = rows(slot.shape, dim_), n = side_block.stride;
    const double* shape = operators_[operand.side_block].of(slot.shape);
    for (std::size_t q = 0; q < static_cast<std::size_t>(element_.points); ++q)
      for (int c = 0; c < operand.components; ++c) {
        moved_.assign(static_cast<std::size_t>(n) * moves_, 0.0);
        for (int i = 0; i < directions; ++i)
          add(TestRow{&slot, operand.side_block, q, i, q * term.outputs + at + c * directions + i,
                      shape + static_cast<std::ptrdiff_t>(q * directions + i) * n, n});
        scatter_moves(static_cast<int>(q), side_block.offset + (operand.offset + c) * n, n, moved_.data());
      }
    at += operand.components * directions;
  }
}

/// moved += shape change^T
void ElementEvaluator::add_outer(const TestRow& row, const double* shape, const double* change) {
  const int moves = moves_;
  for (int a = 0; a < row.nodes; ++a)
    for (int m = 0; m < moves; ++m) moved_[static_cast<std::size_t>(a) * moves + m] += change[m] * shape[a];
}

/// d(weight r N) = (weight dr + r dweight) N + weight r dN.
void ElementEvaluator::add_motion_tangent(const Compiled& term) {
  const int moves = moves_, columns = term.columns + moves;
  add_moves(term, [&](const TestRow& row) {
    const std::size_t q = row.point;
    const double weight = element_.weight[q], force = weight * point_residual_[row.output];
    double change[most_moves];
    for (int m = 0; m < moves; ++m)
      change[m] = weight * point_tangent_[row.output * columns + term.columns + m] +
                  force * element_.motion->relative_weight[q * moves + m];
    add_outer(row, row.shape, change);
    if (force == 0) return;
    for (int j = 0; j < dim_; ++j) {
      const double* speed = &reference_motion_[side_blocks_[row.side_block].side][(q * dim_ + j) * moves];
      for (int m = 0; m < moves; ++m) change[m] = force * speed[m];
      add_outer(row, shape_change(*row.slot, row.side_block, static_cast<int>(q), j, row.direction), change);
    }
  });
}

/// An integral over a volume changes by its integrand on the moving surface times the surface's normal
/// motion.
void ElementEvaluator::add_sweep(const Compiled& term) {
  const int moves = moves_;
  add_moves(term, [&](const TestRow& row) {
    const double force = element_.weight[row.point] * point_residual_[row.output];
    if (force == 0) return;
    double change[most_moves] = {};
    for (int i = 0; i < dim_; ++i)
      for (int m = 0; m < moves; ++m)
        change[m] += force * element_.normal[row.point * dim_ + i] *
                     element_.motion->position[(row.point * dim_ + i) * moves + m];
    add_outer(row, row.shape, change);
  });
}

}  // namespace seam
