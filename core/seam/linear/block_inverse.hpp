// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "seam/linear/equation_block.hpp"
#include "seam/linear/matrix.hpp"

namespace seam {

class Registry;

/// What approximates the inverse of the equations of one field within the preconditioner of an iterative
/// solver. A type of kind "block_inverse".
class BlockInverse {
 public:
  virtual ~BlockInverse() = default;
  /// Prepares for a matrix. Collective.
  /// @param matrix the equations of the field alone, numbered from 0 over the ranks. It may be kept, as
  /// copies share its memory; where the field is alone in the system values of later matrices come to stand
  /// there.
  /// @param equations what they are; rows are those of `matrix`
  /// @throws Error for what it cannot be an inverse of
  virtual void build(const Matrix& matrix, const EquationBlock& equations) = 0;
  /// x = about A^-1 b, the same linear map for all b: the solver is no flexible one. Collective.
  /// @param b, x [row of this rank]
  virtual void apply(std::span<const double> b, std::span<double> x) const = 0;
};

/// Registers "ilu", "multigrid" and "schur".
void register_block_inverses(Registry& registry);

}  // namespace seam
