// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <TpetraExt_MatrixMatrix.hpp>

#include "seam/base/diagnostics.hpp"
#include "seam/linear/preconditioner.hpp"

namespace seam {
namespace {

/// The approximate factorisation SIMPLE of [F G; D C], with H = -diag(F)^-1 G and S = C + D H:
/// u = F^-1 f, p = S^-1 (g - D u), u += H p. For several vectors F^-1 is a forward block Gauss-Seidel step.
class Simple final : public TpetraOperator {
 public:
  Simple(const Teuchos::RCP<TpetraMatrix>& system, const Matrix& a, const EquationBlock& block,
         const FieldInverses& use)
      : first_(block.first),
        free_(*system, rows(block, 0, block.unknowns_per_node - block.constraints())),
        constrained_(*system,
                     rows(block, block.unknowns_per_node - block.constraints(), block.unknowns_per_node)),
        map_(Teuchos::rcp(new TpetraMap(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), block.count,
                                        0, system->getComm()))) {
    add_vectors(system, a, block, use);
    Tpetra::Vector<double, int, long long> diagonal(system->getRowMap());
    system->getLocalDiagCopy(diagonal);
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
    refuse_free_level(*schur, block);
    schur_inverse_ = make_multigrid(schur, part(block, block.constraints()));
  }
  [[nodiscard]] Teuchos::RCP<const TpetraMap> getDomainMap() const override { return map_; }
  [[nodiscard]] Teuchos::RCP<const TpetraMap> getRangeMap() const override { return map_; }
  void apply(const TpetraVector& x, TpetraVector& y, Teuchos::ETransp, double, double) const override {
    TpetraVector g = constrained_.gather(x, first_);
    TpetraVector p(g.getMap(), g.getNumVectors());
    solve_vectors(x, y);
    TpetraVector u = free_.gather(y, first_);
    divergence_->apply(u, g, Teuchos::NO_TRANS, -1.0, 1.0);
    schur_inverse_->apply(g, p);
    gradient_->apply(p, u, Teuchos::NO_TRANS, 1.0, 1.0);
    free_.scatter(u, y, first_);
    constrained_.scatter(p, y, first_);
  }

 private:
  struct Vector {
    Selection rows;
    Teuchos::RCP<TpetraOperator> inverse;
    std::vector<Teuchos::RCP<TpetraMatrix>> before;  ///< what couples it to each of those in front
  };
  /// What holds a constant pressure may lie in another field: the complement, which knows this one only, is
  /// singular then, and iterations stop short of the solution.
  static void refuse_free_level(const TpetraMatrix& schur, const EquationBlock& block) {
    constexpr double rounding = 1e-11;
    TpetraVector constant(schur.getDomainMap(), 1), image(schur.getRangeMap(), 1);
    constant.putScalar(1);
    schur.apply(constant, image);
    if (image.getVector(0)->norm2() > rounding * schur.getFrobeniusNorm()) return;
    throw Error(fmt::format(
        "the level of the scalar unknown of field '{}' (its pressure) is held by nothing in this field, only "
        "by "
        "what it is coupled to: `preconditioner: schur` treats the field by itself and cannot solve for it; "
        "take `linear: {{type: krylov, preconditioner: multigrid}}`, or ilu, or `linear: direct`",
        block.field));
  }
  /// Rows of the components [from, to) of all nodes.
  static std::vector<int> rows(const EquationBlock& block, int from, int to) {
    std::vector<int> result;
    for (int r = 0; r < block.count; ++r)
      if (const int c = r % block.unknowns_per_node; c >= from && c < to) result.push_back(block.first + r);
    return result;
  }
  void add_vectors(const Teuchos::RCP<TpetraMatrix>& system, const Matrix& a, const EquationBlock& block,
                   const FieldInverses& use) {
    const int end = block.unknowns_per_node - block.constraints();
    for (int from = 0, k = 0; from < end; from += block.unknowns[k++]) {
      const int size = block.unknowns[k];
      Vector vector{Selection(*system, rows(block, from, from + size)), {}, {}};
      if (from + size < end && size == block.dimension)
        vector.inverse = make_multigrid(vector.rows.submatrix(a, vector.rows), part(block, size));
      else
        vector.inverse = make_incomplete_lu(vector.rows.own_submatrix(a), vector.rows.map(), use.fill);
      for (const Vector& other : vectors_) vector.before.push_back(vector.rows.submatrix(a, other.rows));
      vectors_.push_back(std::move(vector));
    }
  }
  /// The block as if each node had `size` unknowns only.
  static EquationBlock part(const EquationBlock& block, int size) {
    EquationBlock result;
    result.count = block.count / block.unknowns_per_node * size;
    result.unknowns_per_node = size;
    result.dimension = block.dimension;
    result.symmetric = false;
    result.coordinates = block.coordinates;
    return result;
  }
  void solve_vectors(const TpetraVector& x, TpetraVector& y) const {
    std::vector<TpetraVector> solution;
    for (const Vector& vector : vectors_) {
      TpetraVector f = vector.rows.gather(x, first_);
      for (std::size_t k = 0; k < solution.size(); ++k)
        vector.before[k]->apply(solution[k], f, Teuchos::NO_TRANS, -1.0, 1.0);
      solution.emplace_back(f.getMap(), f.getNumVectors());
      vector.inverse->apply(f, solution.back());
      vector.rows.scatter(solution.back(), y, first_);
    }
  }
  int first_;  ///< of the block in the system
  Selection free_, constrained_;
  Teuchos::RCP<const TpetraMap> map_;
  Teuchos::RCP<TpetraMatrix> divergence_, gradient_;  ///< gradient_: H
  Teuchos::RCP<TpetraOperator> schur_inverse_;
  std::vector<Vector> vectors_;
};

}  // namespace

Teuchos::RCP<TpetraOperator> make_simple(const Teuchos::RCP<TpetraMatrix>& system, const Matrix& a,
                                         const EquationBlock& block, const FieldInverses& use) {
  return Teuchos::rcp(new Simple(system, a, block, use));
}

}  // namespace seam
