// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "seam/mesh/mesh_data.hpp"
#include "seam/surface/surface.hpp"

namespace seam {

class Mesh;
class Registry;

/// Finds a mesh of the scene by its name.
using MeshFinder = std::function<std::shared_ptr<const MeshData>(const std::string& name)>;

/// A surface as a function of time.
using MovingSurface = std::function<Surface(double time)>;

/// What a shape may ask of the scene.
struct BodySetting {
  const Mesh& background;  ///< out of which the body is cut; must outlive the surface
  const MeshFinder& meshes;
};

/// The shape of a body of given geometry. A type of kind "body".
class BodyShape {
 public:
  virtual ~BodyShape() = default;
  /// Its boundary, before the motion that the interface may add. Every rank of the background mesh gets the
  /// same; calls of the result are collective.
  [[nodiscard]] virtual MovingSurface surface(const BodySetting& setting) const = 0;
  /// Whether it is defined in space instead of in its own frame: then no motion can be added.
  [[nodiscard]] virtual bool is_in_space() const { return false; }
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
