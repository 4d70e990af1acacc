// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/mesh/mesh.hpp"
#include "seam/surface/surface.hpp"

namespace seam {

/// Cost of each cell of a mesh out of which bodies are cut, relative to a whole cell of the wet part: those
/// inside a body cost next to nothing, cut ones have more points and an interface.
/// @param whole the mesh, all of it on every rank
/// @return [global cell]
std::vector<double> cut_cell_costs(const Mesh& whole, const std::vector<Surface>& bodies);

}  // namespace seam
