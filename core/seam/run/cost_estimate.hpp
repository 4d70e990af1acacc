// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/linear/linear_solver.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

/// What a step will cost, from the system at the start: good to a factor of two or so.
struct CostEstimate {
  double bytes = 0;             ///< resident at most, of all ranks
  double seconds_per_step = 0;  ///< with `iterations` of Newton's method
  bool has_linear = true;  ///< false: what linear solves take is not in it, since their number is not known
  static constexpr int iterations = 3;
};

/// Of the system that was assembled last, with its tangent. Collective.
/// @param assembly_seconds that took
CostEstimate estimate_cost(Problem& problem, LinearSolver& solver, double assembly_seconds);

}  // namespace seam
