// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "seam/interface/interface.hpp"
#include "seam/mesh/mesh_data.hpp"
#include "seam/plugin/registry.hpp"
#include "seam/scene/scene.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

/// A coupling of the scene, and what the scene says of it.
struct SceneCoupling {
  Parameters parameters;
  std::unique_ptr<Coupling> coupling;

  [[nodiscard]] const std::string& on() const { return parameters.text("on"); }
  [[nodiscard]] std::string describe() const;
};

/// What a scene describes, as objects: its meshes, interfaces and couplings, and all fields and terms in one
/// problem.
struct BuiltScene {
  std::map<std::string, std::shared_ptr<const MeshData>> meshes;
  std::vector<std::pair<std::string, std::unique_ptr<Interface>>> interfaces;
  std::vector<SceneCoupling> couplings;
  std::unique_ptr<Problem> problem;

  [[nodiscard]] MeshFinder mesh_finder() const {
    return [this](const std::string& name) { return meshes.at(name); };
  }
};

/// Builds meshes, fields, interfaces and couplings, in this order. Collective.
/// @param start time at which bodies cut meshes first, s
/// @throws Error with places in the scene; what is wrong with several parts of a kind is said at once
BuiltScene build_scene(const Scene& scene, const Registry& registry, const Communicator& communicator,
                       double start);

/// The unknowns that couplings bring to a field. @throws Error with places in the scene
std::vector<Unknown> unknowns_of_couplings(const BuiltScene& built, const std::string& field, int dimension,
                                           const std::vector<Unknown>& of_physics);

/// Builds the interfaces of a scene and binds the terms and measures of its couplings to them. Collective.
/// @param built with its meshes, interfaces, couplings and fields
/// @throws Error with places in the scene
void build_couplings(const Scene& scene, BuiltScene& built);

}  // namespace seam
