// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/conformance/check.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

/// Compares the rates of what is given over time, which a function may say itself, with differences of its
/// values. Nothing where nothing that has rates changes with time. One rank only.
std::vector<ConformanceCheck> check_given_values(const Problem& problem, double time);

}  // namespace seam
