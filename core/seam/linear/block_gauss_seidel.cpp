// SPDX-License-Identifier: BSD-3-Clause
#include <numeric>

#include "seam/linear/preconditioner.hpp"

namespace seam {
BlockGaussSeidel::BlockGaussSeidel(const Teuchos::RCP<TpetraMatrix>& system, const Matrix& a,
                                   const std::vector<EquationBlock>& blocks, const FieldInverses& use)
    : system_(system), map_(system->getDomainMap()) {
  // Smaller matrices (a rigid body's motion) are left to the factorisation.
  constexpr std::size_t small = 800;
  for (const EquationBlock& block : blocks) {
    std::vector<int> rows(block.count);
    std::iota(rows.begin(), rows.end(), block.first);
    const Selection selection(*system, std::move(rows));
    const std::size_t size = selection.map()->getGlobalNumElements();
    const bool large = size > small;
    const bool pure = block.unknowns_per_node == block.dimension || block.unknowns_per_node == 1;
    Teuchos::RCP<TpetraOperator> inverse;
    if (use.schur && large && block.constraints() > 0) {
      inverse = make_simple(system, a, block, use);
    } else if (large && use.multigrid && pure) {
      const auto matrix = blocks.size() == 1 ? system : selection.submatrix(a, selection);
      inverse = make_multigrid(matrix, block);
    } else {
      inverse = make_incomplete_lu(selection.own_submatrix(a), selection.map(), use.fill);
    }
    inverses_.push_back({selection, inverse});
  }
}

void BlockGaussSeidel::apply(const TpetraVector& x, TpetraVector& y, Teuchos::ETransp, double alpha,
                             double beta) const {
  TpetraVector solution(getDomainMap(), x.getNumVectors()), residual(x, Teuchos::Copy);
  for (std::size_t p = 0; p < inverses_.size(); ++p) {
    const BlockInverse& part = inverses_[p];
    if (p > 0) {
      Tpetra::deep_copy(residual, x);
      system_->apply(solution, residual, Teuchos::NO_TRANS, -1.0, 1.0);
    }
    const TpetraVector in = part.selection.gather(residual);
    TpetraVector out(part.selection.map(), x.getNumVectors());
    part.inverse->apply(in, out);
    part.selection.scatter(out, solution);
  }
  y.update(alpha, solution, beta);
}

}  // namespace seam
