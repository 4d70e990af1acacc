// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/record/results.hpp"
#include "seam/scene/scene.hpp"

namespace seam {

/// Names under which the end of a run adds numbers of its own, beside those of the scene.
inline const std::vector<std::string> counts_at_the_end{
    "newton.iterations.median", "newton.iterations.most", "steps.taken", "steps.rejected",
    "newton.frozen_steps",      "linear.iterations.most", "unknowns"};

/// Before the formulas of a row: each number has a name of its own, also as formulas spell it, and none is
/// called like a parameter, time or t; what statistics and checks ask for exists.
/// @param row of the first time, without formulas
/// @throws Error listing all mistakes with their places
void check_result_names(const Scene& scene, const Results& row);

}  // namespace seam
