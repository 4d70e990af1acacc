// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/solve/problem.hpp"

namespace seam {

/// Relative difference between a step and an explicit one that uses the old rate: half the step times the
/// change of the rate, which is the local error of the implicit Euler method. Of the unknown where it is
/// largest, in the norm of L2: what is left of a cut cell counts by its volume, so that no drop of fluid that
/// is squeezed between bodies sets the pace. And relative to no less than a part of the largest state so far:
/// what is left of a motion when it comes to rest is noise, and so is an unknown that has no part in the
/// equations. Collective.
/// @param step length of the step that has led to the states, s
/// @param largest sizes of the states so far, one for each unknown of each field; kept here, at first 0
double time_error(Problem& problem, double step, std::vector<double>& largest);

}  // namespace seam
