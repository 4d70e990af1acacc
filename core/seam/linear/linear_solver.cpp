// SPDX-License-Identifier: BSD-3-Clause
#include "seam/linear/linear_solver.hpp"

#include <fmt/format.h>

#include <cmath>

#include "seam/base/stopwatch.hpp"
#include "seam/linear/automatic_solver.hpp"
#include "seam/linear/block_inverse.hpp"
#include "seam/linear/equilibration.hpp"
#include "seam/linear/krylov_solver.hpp"
#include "seam/linear/mumps_solver.hpp"
#include "seam/plugin/registry.hpp"

namespace seam {

SolveReport LinearSolver::solve(const Matrix& a, const std::vector<EquationBlock>& blocks,
                                const std::vector<double>& b, std::vector<double>& x) {
  SolveReport report;
  x.assign(a.rows, 0.0);
  if (norm(a.communicator, b) == 0.0) return report;
  weights_ = equation_weights(a, blocks);
  const Stopwatch watch;
  solve_into(a, blocks, b, x, report);
  report.solve_seconds = watch.seconds() - report.setup_seconds;
  // Never trust a solver's own word: some return wrong solutions without an error.
  std::vector<double> residual, size = b;
  multiply(a, x, residual);
  for (int i = 0; i < a.rows; ++i) {
    residual[i] = weights_[i] * (b[i] - residual[i]);
    size[i] *= weights_[i];
  }
  report.relative_residual = norm(a.communicator, residual) / norm(a.communicator, size);
  if (!(report.relative_residual <= acceptable_residual_))
    throw SingularMatrix(
        fmt::format("the linear solve left a relative residual of {:.2e} (acceptable: {:.0e}) after {} "
                    "iterations: the system is singular or too ill-conditioned for this solver",
                    report.relative_residual, acceptable_residual_, report.iterations),
        {});
  return report;
}

std::optional<LinearSolver::Effort> LinearSolver::effort(const Matrix&) { return std::nullopt; }

double norm(const Communicator& communicator, const std::vector<double>& x) {
  double square = 0;
  for (const double v : x) square += v * v;
  return std::sqrt(communicator.sum(square));
}

void register_linear_solvers(Registry& registry) {
  registry.add<LinearSolver>(
      "linear_solver", "auto", AutomaticSolver::schema(),
      [](const Parameters& p, const Registry& all) { return std::make_unique<AutomaticSolver>(p, all); });
  registry.add<LinearSolver>(
      "linear_solver", "direct", MumpsSolver::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<MumpsSolver>(p); });
  registry.add<LinearSolver>(
      "linear_solver", "krylov", KrylovSolver::schema(),
      [](const Parameters& p, const Registry& all) { return std::make_unique<KrylovSolver>(p, all); });
  register_block_inverses(registry);
}

}  // namespace seam
