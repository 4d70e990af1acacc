// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/linear/krylov_solver.hpp"
#include "seam/linear/selection.hpp"

namespace seam {

/// A multigrid preconditioner of one block (MueLu, smoothed aggregation).
Teuchos::RCP<TpetraOperator> make_multigrid(const Teuchos::RCP<TpetraMatrix>& matrix,
                                            const EquationBlock& block);

/// An incomplete LU factorisation of each rank's own part (Ifpack2). The matrix is not kept.
/// @param own this rank's part, as a matrix of this rank alone
/// @param rows of the result, over all ranks
/// @param fill levels of fill-in
Teuchos::RCP<TpetraOperator> make_incomplete_lu(const Teuchos::RCP<TpetraMatrix>& own,
                                                const Teuchos::RCP<const TpetraMap>& rows, int fill);

/// The approximate block factorisation SIMPLE of a block in which the last unknowns of each node have an
/// equation that constrains the others, as the pressure of an incompressible flow. Multigrid for the Schur
/// complement; an incomplete factorisation for a velocity, and where a displacement comes before it, as in a
/// porous body, multigrid for that, one after the other.
Teuchos::RCP<TpetraOperator> make_simple(const Teuchos::RCP<TpetraMatrix>& system, const Matrix& a,
                                         const EquationBlock& block, const FieldInverses& use);

/// Solves the blocks of a system one after the other, each with the residual that the ones before have left:
/// forward block Gauss-Seidel. Blocks of one unknown a node, or of a displacement, are left to multigrid,
/// others to an incomplete factorisation.
class BlockGaussSeidel final : public TpetraOperator {
 public:
  /// @param system a view of `a`
  BlockGaussSeidel(const Teuchos::RCP<TpetraMatrix>& system, const Matrix& a,
                   const std::vector<EquationBlock>& blocks, const FieldInverses& use);
  /// From now on residuals are those of another matrix with the same unknowns, or there is none for now; the
  /// blocks' inverses stay.
  void follow(const Teuchos::RCP<TpetraMatrix>& system) { system_ = system; }
  [[nodiscard]] Teuchos::RCP<const TpetraMap> getDomainMap() const override { return map_; }
  [[nodiscard]] Teuchos::RCP<const TpetraMap> getRangeMap() const override { return map_; }
  void apply(const TpetraVector& x, TpetraVector& y, Teuchos::ETransp, double alpha,
             double beta) const override;

 private:
  struct BlockInverse {
    Selection selection;
    Teuchos::RCP<TpetraOperator> inverse;
  };
  Teuchos::RCP<TpetraMatrix> system_;
  Teuchos::RCP<const TpetraMap> map_;
  std::vector<BlockInverse> inverses_;
};

}  // namespace seam
