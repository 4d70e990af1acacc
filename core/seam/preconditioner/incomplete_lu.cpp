// SPDX-License-Identifier: BSD-3-Clause
#include <Ifpack2_LocalSparseTriangularSolver.hpp>
#include <Ifpack2_RILUK.hpp>
#include <algorithm>

#include "seam/preconditioner/library.hpp"

namespace seam {
namespace {

using Rows = Tpetra::RowMatrix<double, int, long long>;

/// The factors L D U of this rank's part of a matrix. Ifpack2's own operator would keep that matrix as well,
/// as large as the factors.
class IncompleteLu final : public TpetraOperator {
 public:
  IncompleteLu(const Teuchos::RCP<TpetraMatrix>& own, const Teuchos::RCP<const TpetraMap>& rows, int fill)
      : rows_(rows), own_(own->getRowMap()) {
    if (own_->getGlobalNumElements() == 0) return;
    Ifpack2::RILUK<Rows> factorisation(Teuchos::RCP<const TpetraMatrix>{own});
    Teuchos::ParameterList parameters;
    parameters.set("fact: iluk level-of-fill", fill);
    factorisation.setParameters(parameters);
    factorisation.initialize();
    factorisation.compute();
    lower_ = solver(factorisation.getL());
    upper_ = solver(factorisation.getU());
    inverse_diagonal_ =
        Teuchos::rcp(new Tpetra::Vector<double, int, long long>(factorisation.getD(), Teuchos::Copy));
  }
  [[nodiscard]] Teuchos::RCP<const TpetraMap> getDomainMap() const override { return rows_; }
  [[nodiscard]] Teuchos::RCP<const TpetraMap> getRangeMap() const override { return rows_; }
  void apply(const TpetraVector& x, TpetraVector& y, Teuchos::ETransp, double, double) const override {
    if (lower_.is_null()) return;
    TpetraVector z(own_, x.getNumVectors());
    copy(x, z);
    lower_->apply(z, z);
    z.elementWiseMultiply(1.0, *inverse_diagonal_, z, 0.0);
    upper_->apply(z, z);
    copy(z, y);
  }

 private:
  using Triangle = Ifpack2::LocalSparseTriangularSolver<Rows>;
  /// Shares the memory of the factor.
  static Teuchos::RCP<Triangle> solver(const TpetraMatrix& factor) {
    auto result = Teuchos::rcp(new Triangle(Teuchos::rcp(new TpetraMatrix(factor))));
    result->initialize();
    result->compute();
    return result;
  }
  static void copy(const TpetraVector& from, TpetraVector& to) {
    for (std::size_t v = 0; v < from.getNumVectors(); ++v)
      std::ranges::copy(from.getData(v), to.getDataNonConst(v).begin());
  }
  Teuchos::RCP<const TpetraMap> rows_, own_;
  Teuchos::RCP<Triangle> lower_, upper_;
  Teuchos::RCP<const Tpetra::Vector<double, int, long long>> inverse_diagonal_;
};

}  // namespace

Teuchos::RCP<TpetraOperator> build_incomplete_lu(const Teuchos::RCP<TpetraMatrix>& own,
                                                 const Teuchos::RCP<const TpetraMap>& rows, int fill) {
  return Teuchos::rcp(new IncompleteLu(own, rows, fill));
}

}  // namespace seam
