// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/scene/scene.hpp"

namespace seam {

/// How the expressions of a scene use the time t.
struct TimeUse {
  bool any = false;           ///< some expression depends on t
  std::vector<double> kinks;  ///< ascending: times at which one changes its form, s
};

/// Looks for t in the texts of a scene. Kinks are the times between two at which a condition of an expression
/// changes, `2*t < 3 ? 0 : ...`, or the arguments of `min` and `max` or that of `abs` and `sign` change their
/// order, where that depends on the time alone. What a function of a plugin does inside is not known.
TimeUse find_time_use(const Scene& scene, double from, double to);

}  // namespace seam
