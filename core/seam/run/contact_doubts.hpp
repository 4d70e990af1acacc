// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/run/scene_doubts.hpp"

namespace seam {

/// What is legal, but hardly meant, of bodies that touch in a field: one that the other body is not cut out
/// of, a porous partner that does not look back, one that is tied besides, impacts that add energy, pores
/// that a coupling without pores leaves open; and of surfaces that do not see each other where they are
/// joined or overlap.
std::vector<Diagnostic> contact_doubts(const SceneAtStart& scene);

}  // namespace seam
