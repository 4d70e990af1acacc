// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/run/scene_doubts.hpp"

namespace seam {

/// What is legal, but hardly meant, of bodies that touch in a field: one that the other body is not cut out
/// of, a porous partner that does not look back, pores that a coupling without pores leaves open.
std::vector<Diagnostic> contact_doubts(const SceneAtStart& scene);

}  // namespace seam
