// SPDX-License-Identifier: BSD-3-Clause
#include "seam/linear/gmres.hpp"

#include <BelosBlockGmresSolMgr.hpp>
#include <BelosTpetraAdapter.hpp>

namespace seam {
namespace {

/// An operator between vectors whose entries are weighed: W A, or M W^-1 (`before`).
class Weighed final : public TpetraOperator {
 public:
  Weighed(Teuchos::RCP<const TpetraOperator> inner, Teuchos::RCP<TpetraVector> weights, bool before)
      : inner_(std::move(inner)), weights_(std::move(weights)), before_(before) {}
  [[nodiscard]] Teuchos::RCP<const TpetraMap> getDomainMap() const override { return inner_->getDomainMap(); }
  [[nodiscard]] Teuchos::RCP<const TpetraMap> getRangeMap() const override { return inner_->getRangeMap(); }
  void apply(const TpetraVector& x, TpetraVector& y, Teuchos::ETransp, double alpha,
             double beta) const override {
    TpetraVector in(x, Teuchos::Copy), out(inner_->getRangeMap(), x.getNumVectors());
    if (before_) in.elementWiseMultiply(1.0, *weights_->getVector(0), in, 0.0);
    inner_->apply(in, out);
    if (!before_) out.elementWiseMultiply(1.0, *weights_->getVector(0), out, 0.0);
    y.update(alpha, out, beta);
  }

 private:
  Teuchos::RCP<const TpetraOperator> inner_;
  Teuchos::RCP<TpetraVector> weights_;
  bool before_;
};

}  // namespace

int gmres(const Teuchos::RCP<TpetraMatrix>& matrix, const Teuchos::RCP<TpetraOperator>& preconditioner,
          const std::vector<double>& weights, const std::vector<double>& b, std::vector<double>& x,
          const GmresOptions& options) {
  const auto solution = to_tpetra(matrix->getDomainMap(), x);
  const auto right_side = to_tpetra(matrix->getRangeMap(), b);
  Teuchos::RCP<const TpetraOperator> system = matrix, inverse = preconditioner;
  if (!weights.empty()) {
    const auto weight = to_tpetra(matrix->getRangeMap(), weights);
    auto unweigh = Teuchos::rcp(new TpetraVector(*weight, Teuchos::Copy));
    unweigh->reciprocal(*weight);
    right_side->elementWiseMultiply(1.0, *weight->getVector(0), *right_side, 0.0);
    system = Teuchos::rcp(new Weighed(matrix, weight, false));
    inverse = Teuchos::rcp(new Weighed(preconditioner, unweigh, true));
  }
  auto problem = Teuchos::rcp(
      new Belos::LinearProblem<double, TpetraVector, TpetraOperator>(system, solution, right_side));
  problem->setRightPrec(inverse);
  problem->setProblem();
  auto parameters = Teuchos::rcp(new Teuchos::ParameterList);
  parameters->set("Convergence Tolerance", options.tolerance);
  parameters->set("Maximum Iterations", options.maximum_iterations);
  parameters->set("Num Blocks", std::min(options.restart, options.maximum_iterations));
  parameters->set("Maximum Restarts", options.maximum_iterations / options.restart + 1);
  parameters->set("Explicit Residual Scaling", "Norm of RHS");
  parameters->set("Implicit Residual Scaling", "Norm of RHS");
  parameters->set("Verbosity", 0);
  Belos::BlockGmresSolMgr<double, TpetraVector, TpetraOperator> solver(problem, parameters);
  solver.solve();
  from_tpetra(*solution, x);
  return solver.getNumIters();
}

}  // namespace seam
