// SPDX-License-Identifier: BSD-3-Clause
#include <TpetraExt_MatrixMatrix.hpp>
#include <algorithm>

#include "seam/linear/preconditioner.hpp"

namespace seam {
namespace {

/// The approximate factorisation SIMPLE of [F G; D C], with H = -diag(F)^-1 G and S = C + D H:
/// u = F^-1 f, p = S^-1 (g - D u), u += H p.
class Simple final : public TpetraOperator {
 public:
  Simple(const Teuchos::RCP<TpetraMatrix>& system, const Matrix& a, const EquationBlock& block, int fill)
      : first_(block.first),
        free_(*system, rows(block, false)),
        constrained_(*system, rows(block, true)),
        map_(Teuchos::rcp(new TpetraMap(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), block.count,
                                        0, system->getComm()))) {
    Tpetra::Vector<double, int, long long> scale(free_.map());
    {
      const auto own = free_.own_submatrix(a);
      Tpetra::Vector<double, int, long long> diagonal(own->getRowMap());
      own->getLocalDiagCopy(diagonal);
      std::ranges::copy(diagonal.getData(), scale.getDataNonConst().begin());
      inverse_ = make_incomplete_lu(own, free_.map(), fill);
    }
    divergence_ = constrained_.submatrix(a, free_);
    gradient_ = free_.submatrix(a, constrained_);
    scale.reciprocal(scale);
    scale.scale(-1);
    gradient_->leftScale(scale);
    Teuchos::RCP<TpetraMatrix> product = Teuchos::rcp(new TpetraMatrix(constrained_.map(), 0));
    Tpetra::MatrixMatrix::Multiply(*divergence_, false, *gradient_, false, *product);
    const auto c = constrained_.submatrix(a, constrained_);
    const auto schur = Tpetra::MatrixMatrix::add(1.0, false, *c, 1.0, false, *product);
    EquationBlock scalar;
    scalar.count = static_cast<int>(constrained_.rows().size());
    scalar.dimension = block.dimension;
    scalar.symmetric = false;
    scalar.coordinates = block.coordinates;
    schur_inverse_ = make_multigrid(schur, scalar);
  }
  [[nodiscard]] Teuchos::RCP<const TpetraMap> getDomainMap() const override { return map_; }
  [[nodiscard]] Teuchos::RCP<const TpetraMap> getRangeMap() const override { return map_; }
  void apply(const TpetraVector& x, TpetraVector& y, Teuchos::ETransp, double, double) const override {
    const TpetraVector f = free_.gather(x, first_);
    TpetraVector g = constrained_.gather(x, first_);
    TpetraVector u(f.getMap(), f.getNumVectors()), p(g.getMap(), g.getNumVectors());
    inverse_->apply(f, u);
    divergence_->apply(u, g, Teuchos::NO_TRANS, -1.0, 1.0);
    schur_inverse_->apply(g, p);
    gradient_->apply(p, u, Teuchos::NO_TRANS, 1.0, 1.0);
    free_.scatter(u, y, first_);
    constrained_.scatter(p, y, first_);
  }

 private:
  static std::vector<int> rows(const EquationBlock& block, bool constrained) {
    std::vector<int> result;
    const int n = block.unknowns_per_node;
    for (int r = 0; r < block.count; ++r)
      if ((r % n >= n - block.constraints) == constrained) result.push_back(block.first + r);
    return result;
  }
  int first_;  ///< of the block in the system
  Selection free_, constrained_;
  Teuchos::RCP<const TpetraMap> map_;
  Teuchos::RCP<TpetraMatrix> divergence_, gradient_;  ///< gradient_: H
  Teuchos::RCP<TpetraOperator> inverse_, schur_inverse_;
};

}  // namespace

Teuchos::RCP<TpetraOperator> make_simple(const Teuchos::RCP<TpetraMatrix>& system, const Matrix& a,
                                         const EquationBlock& block, int fill) {
  return Teuchos::rcp(new Simple(system, a, block, fill));
}

}  // namespace seam
