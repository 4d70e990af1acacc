// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/record/results.hpp"
#include "seam/scene/scene.hpp"

namespace seam {

/// Appends the present values of the formulas in output.formulas, which may use the series recorded before
/// them in this step and the scene's parameters.
/// @throws Error with the place in the scene
void record_formulas(const Scene& scene, Results& results);

/// Sets the numbers that output.statistics asks for: what a series does over a span of time.
/// @throws Error with the place in the scene
void finish_statistics(const Scene& scene, Results& results);

}  // namespace seam
