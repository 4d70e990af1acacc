// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "seam/cut/surface.hpp"
#include "seam/mesh/mesh_data.hpp"
#include "seam/plugin/registry.hpp"

namespace seam {

/// Finds a mesh of the scene by its name.
using MeshFinder = std::function<std::shared_ptr<const MeshData>(const std::string& name)>;

/// The shape of a body of given geometry. A type of kind "body".
class BodyShape {
 public:
  virtual ~BodyShape() = default;
  /// Its boundary, before any motion. @param dimension of the scene
  [[nodiscard]] virtual Surface surface(int dimension, const MeshFinder& meshes) const = 0;
};

/// Registers "circle", "sphere", "box", "outline" and "mesh".
void register_bodies(Registry& registry);

/// The outer boundary of a mesh, or the named parts of it, as planar facets.
/// @param boundaries names; empty for all of the boundary
Surface boundary_surface(const MeshData& mesh, const std::vector<std::string>& boundaries);

}  // namespace seam
