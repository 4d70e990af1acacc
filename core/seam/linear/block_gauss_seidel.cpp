// SPDX-License-Identifier: BSD-3-Clause
#include "seam/linear/block_gauss_seidel.hpp"

#include <numeric>

namespace seam {
namespace {

/// The same equations with rows counted from the first of them.
EquationBlock counted_from_zero(EquationBlock equations) {
  for (EquationUnknown& unknown : equations.unknowns)
    for (int& row : unknown.rows) row -= equations.first;
  equations.first = 0;
  return equations;
}

}  // namespace

BlockGaussSeidel::BlockGaussSeidel(const Teuchos::RCP<TpetraMatrix>& system, const Matrix& a,
                                   const std::vector<EquationBlock>& blocks, const Maker& make)
    : system_(system), map_(system->getDomainMap()) {
  for (const EquationBlock& block : blocks) {
    Part& part = parts_.emplace_back(Part{block.first, block.count, make(block)});
    std::vector<int> rows(block.count);
    std::iota(rows.begin(), rows.end(), block.first);
    part.inverse->build(blocks.size() == 1 ? a : Selection(*system, std::move(rows)).matrix(a),
                        counted_from_zero(block));
  }
}

void BlockGaussSeidel::apply(const TpetraVector& x, TpetraVector& y, Teuchos::ETransp, double alpha,
                             double beta) const {
  TpetraVector solution(map_, 1), residual(map_, 1);
  for (std::size_t v = 0; v < x.getNumVectors(); ++v) {
    const TpetraVector right_side(*x.getVector(v), Teuchos::Copy);
    Tpetra::deep_copy(residual, right_side);
    solution.putScalar(0);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const Part& part = parts_[p];
      if (p > 0) {
        Tpetra::deep_copy(residual, right_side);
        system_->apply(solution, residual, Teuchos::NO_TRANS, -1.0, 1.0);
      }
      const auto in = residual.getData(0).view(part.first, part.count);
      const auto out = solution.getDataNonConst(0).view(part.first, part.count);
      part.inverse->apply({in.getRawPtr(), static_cast<std::size_t>(part.count)},
                          {out.getRawPtr(), static_cast<std::size_t>(part.count)});
    }
    y.getVectorNonConst(v)->update(alpha, *solution.getVector(0), beta);
  }
}

}  // namespace seam
