// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "seam/surface/surface.hpp"

namespace seam {

class Mesh;

/// Looks for parts of a body's surface that are given twice, so that what couples there would count twice,
/// and for open surfaces that are closed by another body's alone: what holds two bodies together lets them
/// part a little, and then nothing is closed. Collective; the same on all ranks.
/// @param surfaces that cut the mesh @param bodies whose they are, by name; "" where it is none of a mesh
/// @throws Error where a facet is given twice, or where the surface of one body ends inside the mesh on that
/// of another one, naming both, the place, and what to do
void refuse_unsound_surfaces(const Mesh& mesh, const std::vector<Surface>& surfaces,
                             const std::vector<std::string>& bodies);

}  // namespace seam
