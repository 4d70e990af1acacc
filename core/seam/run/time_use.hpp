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

/// Looks for t in the texts of a scene. Kinks are what t is compared with, `t < 1000 ? 0 : ...`, and the
/// other argument of `min(t, ...)` and `max(t, ...)`, where those are constants.
TimeUse find_time_use(const Scene& scene);

}  // namespace seam
