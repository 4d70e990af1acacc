// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "seam/mesh/mesh.hpp"
#include "seam/plugin/registry.hpp"
#include "seam/surface/surface.hpp"

namespace seam {

/// The surface on which a function is zero, as the body where it is negative. The function is sampled at the
/// nodes and the centres of a mesh's cells and taken as linear between them (a triangulation that neighbours
/// share), so the surface is as fine as the mesh it is going to cut. It ends on the mesh's boundary where the
/// body leaves the mesh, and is declared open then. Collective; all ranks get the whole surface.
/// @param value called with `dimension` coordinates, m
/// @throws Error when the value is not finite, naming the place
Surface level_set_surface(const Mesh& mesh, const std::function<double(const double*)>& value);

/// Registers the body "level_set".
void register_level_set(Registry& registry);

}  // namespace seam
