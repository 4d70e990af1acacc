// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "seam/conformance/check.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

class Assembler;

/// Largest error of a tangent against finite differences, and the block of the system it is in.
struct TangentError {
  double relative = 0;
  std::string block;  ///< "equations of block.displacement by water.pressure"
};

/// Size of the changes of each unknown, in the order of fields and their unknowns: the cell size for lengths,
/// 1 for angles, otherwise the largest present value.
std::vector<double> unknown_scales(const Problem& problem);

/// Compares the tangent with finite differences of the residual at the present states, in several random
/// directions of each unknown. Prescribed unknowns must have been freed. One rank only.
/// @param spaces_follow cuts follow the bodies that move, as far as no unknown comes or goes; the assembler
/// must be the problem's own
TangentError tangent_error(Problem& problem, Assembler& assembler, const TimePoint& at, bool spaces_follow);

/// Frees all prescribed unknowns, shakes the present states at random, and checks the tangent of the whole
/// system and of each term. The problem is of no use for solving afterwards. One rank only.
/// @param at the step the present states belong to
std::vector<ConformanceCheck> check_tangents(Problem& problem, const TimePoint& at);

}  // namespace seam
