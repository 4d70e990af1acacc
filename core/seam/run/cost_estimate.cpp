// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/cost_estimate.hpp"

#include "seam/assembly/assembler.hpp"
#include "seam/base/memory.hpp"

namespace seam {
namespace {

// Of a factorisation with its solve, on a core of 2023 at 2 to 3 GHz: eight scenes from 400 to 57,000
// unknowns took between 0.6 and 1.5 times what these give (docs/decisions/0044-check-is-the-set-up.md).
constexpr double operations_per_second = 1.2e10;
constexpr double seconds_per_unknown = 4.5e-6;

}  // namespace

CostEstimate estimate_cost(Problem& problem, LinearSolver& solver, double assembly_seconds) {
  const Communicator& communicator = problem.communicator();
  CostEstimate cost;
  cost.bytes = communicator.sum(peak_memory());
  cost.seconds_per_step = (CostEstimate::iterations + 1) * communicator.max(assembly_seconds);
  const Matrix& matrix = problem.assembler().matrix();
  const std::optional<LinearSolver::Effort> effort = solver.effort(matrix);
  cost.has_linear = effort.has_value();
  if (!effort) return cost;
  cost.bytes += effort->bytes;
  cost.seconds_per_step += CostEstimate::iterations / static_cast<double>(communicator.size()) *
                           (effort->operations / operations_per_second +
                            seconds_per_unknown * static_cast<double>(matrix.global_rows));
  return cost;
}

}  // namespace seam
