// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "seam/linear/block_inverse.hpp"
#include "seam/linear/selection.hpp"

namespace seam {

/// Solves the fields of a system one after the other, each with the residual that the ones before have left:
/// forward block Gauss-Seidel.
class BlockGaussSeidel final : public TpetraOperator {
 public:
  /// Makes the inverse of a field's equations, not built yet.
  using Maker = std::function<std::unique_ptr<BlockInverse>(const EquationBlock&)>;
  /// Collective. @param system a view of `a`
  BlockGaussSeidel(const Teuchos::RCP<TpetraMatrix>& system, const Matrix& a,
                   const std::vector<EquationBlock>& blocks, const Maker& make);
  /// From now on residuals are those of another matrix with the same unknowns, or there is none for now; the
  /// fields' inverses stay.
  void follow(const Teuchos::RCP<TpetraMatrix>& system) { system_ = system; }
  [[nodiscard]] Teuchos::RCP<const TpetraMap> getDomainMap() const override { return map_; }
  [[nodiscard]] Teuchos::RCP<const TpetraMap> getRangeMap() const override { return map_; }
  void apply(const TpetraVector& x, TpetraVector& y, Teuchos::ETransp, double alpha,
             double beta) const override;

 private:
  struct Part {
    int first, count;  ///< local rows
    std::unique_ptr<BlockInverse> inverse;
  };
  Teuchos::RCP<TpetraMatrix> system_;
  Teuchos::RCP<const TpetraMap> map_;
  std::vector<Part> parts_;
};

}  // namespace seam
