// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "seam/assembly/time_point.hpp"

/// What to say of a step that does not converge.
namespace seam {

class Problem;

/// The tied unknown that is farthest from where relations say, beside its size; "" where all are there.
/// Collective.
std::string describe_pending(Problem& problem, const TimePoint& at);
/// Where an unknown's residual is largest, a node's position at rest. Collective.
/// @param unknown as FIELD.UNKNOWN
std::string describe_largest_residual(const Problem& problem, const std::string& unknown);

}  // namespace seam
