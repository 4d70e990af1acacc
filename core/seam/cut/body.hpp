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

/// The boundary of a mesh as planar facets that know where they come from.
struct BodyBoundary {
  Surface surface;
  std::vector<int> node;         ///< [point]: node of the mesh
  std::vector<CellFace> parent;  ///< [facet]: the face that it is part of
  std::vector<int> local;        ///< [facet][dimension]: its corners among the nodes of the parent's cell
};

/// The outer boundary of a mesh, or the named parts of it.
/// @param boundaries names; empty for all of the boundary
/// @throws Error when a name is unknown
BodyBoundary body_boundary(const MeshData& mesh, const std::vector<std::string>& boundaries);

}  // namespace seam
