// SPDX-License-Identifier: BSD-3-Clause
#include "seam/linear/gmres.hpp"

#include <BelosBlockGmresSolMgr.hpp>
#include <BelosTpetraAdapter.hpp>

namespace seam {

int gmres(const Teuchos::RCP<TpetraMatrix>& matrix, const Teuchos::RCP<TpetraOperator>& preconditioner,
          const std::vector<double>& b, std::vector<double>& x, const GmresOptions& options) {
  const auto solution = to_tpetra(matrix->getDomainMap(), x);
  const auto right_side = to_tpetra(matrix->getRangeMap(), b);
  auto problem = Teuchos::rcp(
      new Belos::LinearProblem<double, TpetraVector, TpetraOperator>(matrix, solution, right_side));
  problem->setRightPrec(preconditioner);
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
