// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/conformance/check.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

/// Compares the coefficients of ties, the rates that they give, and how what they hand on changes with values
/// and with motions, with finite differences at the present states: a value that depends on the state in
/// another way than its coefficients say would spoil Newton's method or the balance. Nothing where nothing is
/// tied. One rank only.
std::vector<ConformanceCheck> check_constraints(Problem& problem, const TimePoint& at);

}  // namespace seam
