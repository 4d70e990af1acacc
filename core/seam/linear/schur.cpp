// SPDX-License-Identifier: BSD-3-Clause
#include <TpetraExt_MatrixMatrix.hpp>
#include <algorithm>

#include "seam/linear/preconditioner.hpp"

namespace seam {
namespace {

/// The approximate factorisation SIMPLE of [F G; D C], with H = -diag(F)^-1 G and S = C + D H:
/// u = F^-1 f, p = S^-1 (g - D u), u += H p. For several vectors F^-1 is a forward block Gauss-Seidel step.
class Simple final : public TpetraOperator {
 public:
  Simple(const Matrix& a, const EquationBlock& equations, int fill)
      : system_(tpetra_view(a)),
        map_(system_->getRowMap()),
        free_(*system_, rows(equations, false)),
        constrained_(*system_, rows(equations, true)) {
    add_unknowns(a, equations, fill);
    Tpetra::Vector<double, int, long long> diagonal(map_);
    system_->getLocalDiagCopy(diagonal);
    TpetraVector scale = free_.gather(diagonal);
    divergence_ = constrained_.submatrix(a, free_);
    gradient_ = free_.submatrix(a, constrained_);
    scale.reciprocal(scale);
    scale.scale(-1);
    gradient_->leftScale(*scale.getVector(0));
    Teuchos::RCP<TpetraMatrix> product = Teuchos::rcp(new TpetraMatrix(constrained_.map(), 0));
    Tpetra::MatrixMatrix::Multiply(*divergence_, false, *gradient_, false, *product);
    const auto c = constrained_.submatrix(a, constrained_);
    const auto schur = Tpetra::MatrixMatrix::add(1.0, false, *c, 1.0, false, *product);
    hold_level(*schur);
    schur_inverse_ = make_multigrid(schur, constraint(equations), equations.dimension);
    system_ = Teuchos::null;
  }
  [[nodiscard]] Teuchos::RCP<const TpetraMap> getDomainMap() const override { return map_; }
  [[nodiscard]] Teuchos::RCP<const TpetraMap> getRangeMap() const override { return map_; }
  void apply(const TpetraVector& x, TpetraVector& y, Teuchos::ETransp, double, double) const override {
    TpetraVector g = constrained_.gather(x);
    TpetraVector p(g.getMap(), g.getNumVectors());
    solve_free(x, y);
    TpetraVector u = free_.gather(y);
    divergence_->apply(u, g, Teuchos::NO_TRANS, -1.0, 1.0);
    schur_inverse_->apply(g, p);
    gradient_->apply(p, u, Teuchos::NO_TRANS, 1.0, 1.0);
    free_.scatter(u, y);
    constrained_.scatter(p, y);
  }

 private:
  /// An unknown that constrains nothing.
  struct Free {
    Selection rows;
    Teuchos::RCP<TpetraOperator> inverse;
    std::vector<Teuchos::RCP<TpetraMatrix>> before;  ///< what couples it to each of those in front
  };
  /// What holds the level of a pressure may lie in another field, as a body in a closed vessel: the
  /// complement, which knows this one only, is singular then. A small part of its diagonal stands in; the
  /// iterations around find the level, one vector among many.
  static void hold_level(TpetraMatrix& schur) {
    constexpr double rounding = 1e-11, part = 1e-4;
    TpetraVector constant(schur.getDomainMap(), 1), image(schur.getRangeMap(), 1);
    constant.putScalar(1);
    schur.apply(constant, image);
    if (image.getVector(0)->norm2() > rounding * schur.getFrobeniusNorm()) return;
    Tpetra::Vector<double, int, long long> diagonal(schur.getRowMap());
    schur.getLocalDiagCopy(diagonal);
    const auto values = diagonal.getData(0);
    schur.resumeFill();
    for (int row = 0; row < static_cast<int>(values.size()); ++row) {
      const int column = schur.getColMap()->getLocalElement(schur.getRowMap()->getGlobalElement(row));
      const double more = part * values[row];
      schur.sumIntoLocalValues(row, 1, &more, &column);
    }
    schur.fillComplete(schur.getDomainMap(), schur.getRangeMap());
  }
  static const EquationUnknown& constraint(const EquationBlock& equations) {
    return *std::ranges::find(equations.unknowns, UnknownRole::constraint, &EquationUnknown::role);
  }
  static std::vector<int> rows(const EquationBlock& equations, bool constraints) {
    std::vector<int> result;
    for (const EquationUnknown& unknown : equations.unknowns)
      if ((unknown.role == UnknownRole::constraint) == constraints)
        result.insert(result.end(), unknown.rows.begin(), unknown.rows.end());
    std::ranges::sort(result);
    return result;
  }
  /// What displaces points comes first: the others' equations are on the mesh that it moves.
  void add_unknowns(const Matrix& a, const EquationBlock& equations, int fill) {
    std::vector<const EquationUnknown*> order;
    for (const UnknownRole role : {UnknownRole::motion, UnknownRole::plain, UnknownRole::derived})
      for (const EquationUnknown& unknown : equations.unknowns)
        if (unknown.role == role) order.push_back(&unknown);
    for (const EquationUnknown* unknown : order) {
      Free next{Selection(*system_, unknown->rows), {}, {}};
      if (unknown->role == UnknownRole::motion)
        next.inverse = make_multigrid(next.rows.submatrix(a, next.rows), *unknown, equations.dimension);
      else
        next.inverse = make_incomplete_lu(next.rows.own_submatrix(a), next.rows.map(), fill);
      for (const Free& other : unknowns_) next.before.push_back(next.rows.submatrix(a, other.rows));
      unknowns_.push_back(std::move(next));
    }
  }
  void solve_free(const TpetraVector& x, TpetraVector& y) const {
    std::vector<TpetraVector> solution;
    for (const Free& unknown : unknowns_) {
      TpetraVector f = unknown.rows.gather(x);
      for (std::size_t k = 0; k < solution.size(); ++k)
        unknown.before[k]->apply(solution[k], f, Teuchos::NO_TRANS, -1.0, 1.0);
      solution.emplace_back(f.getMap(), f.getNumVectors());
      unknown.inverse->apply(f, solution.back());
      unknown.rows.scatter(solution.back(), y);
    }
  }
  Teuchos::RCP<TpetraMatrix> system_;  ///< while this is built
  Teuchos::RCP<const TpetraMap> map_;
  Selection free_, constrained_;
  Teuchos::RCP<TpetraMatrix> divergence_, gradient_;  ///< gradient_: H
  Teuchos::RCP<TpetraOperator> schur_inverse_;
  std::vector<Free> unknowns_;
};

}  // namespace

Teuchos::RCP<TpetraOperator> make_simple(const Matrix& a, const EquationBlock& equations, int fill) {
  return Teuchos::rcp(new Simple(a, equations, fill));
}

}  // namespace seam
