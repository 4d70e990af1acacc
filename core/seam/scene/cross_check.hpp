// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "seam/plugin/plugin_host.hpp"
#include "seam/plugin/registry.hpp"
#include "seam/scene/scene.hpp"

namespace seam {

/// One place of a scene where something is named that is defined elsewhere.
struct NamedPlace {
  std::string target;  ///< "mesh", "field", "interface", "boundary", "region"
  std::string name;
  std::string path;  ///< "fields.water.boundary[0].on"
  Location where;
  std::string field;               ///< boundary, region: the field whose mesh is meant, or ""
  std::string mesh;                ///< boundary, region: the mesh that is meant, or ""
  std::vector<std::string> types;  ///< as of Parameter
};

/// All such places, in the order of the schema.
std::vector<NamedPlace> named_places(const Parameters& root, const Registry& registry);

/// Checks that meshes, fields and interfaces that are named exist, and what hangs together in other ways: a
/// check without bounds, a coupling given twice, and, as warnings, what is defined but not used.
/// @param used_plugins those whose types the scene uses
void cross_check(const Scene& scene, const Registry& registry, const std::vector<PluginHost::Found>& loaded,
                 const std::set<std::string>& used_plugins, Diagnostics& diagnostics);

}  // namespace seam
