// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/run/scene_doubts.hpp"

namespace seam {

/// What is legal, but hardly meant, of rigid bodies and of what constraints tie: angles in degrees,
/// points that follow another shape, the finer side of two that is not the tied one.
std::vector<Diagnostic> constraint_doubts(const SceneAtStart& scene);

}  // namespace seam
