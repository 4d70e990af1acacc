// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "seam/base/diagnostics.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/scene/schema.hpp"

namespace seam {

class PluginHost;
class Registry;

/// Values that replace those of the file, in this order: key path ("parameters.h", "time.step.initial",
/// "fields.water.boundary.0.on") and the YAML text of the value ("1/32").
using Overrides = std::vector<std::pair<std::string, std::string>>;

/// A validated scene: everything its file says, defaults filled in, references checked.
struct Scene {
  Parameters root;                           ///< values of scene_schema()
  std::map<std::string, double> parameters;  ///< the scene's named constants, as overridden
  std::filesystem::path path;                ///< of the file; files it names are relative to its folder
  std::string text;                          ///< the file's content
  Overrides overrides;                       ///< applied to it
  std::vector<std::string> plugins;          ///< names of those it loads
  /// Where expressions use a part of a function: key path and what the scene says there ("exact.velocity").
  std::map<std::string, std::string> function_parts;
  Diagnostics warnings;
  /// The place of an entry in one of its maps: "interfaces", "gamma"; none where there is no such entry.
  [[nodiscard]] Location where(const std::string& map, const std::string& name) const;
};

/// The version of the format that this Seam reads. It grows when a scene of today would mean something else.
constexpr long scene_format = 1;

/// The keys of a scene.
Schema scene_schema();

/// Reads a scene, loads the plugins it names and validates it.
/// @param registry holds what the core provides; the plugins add their types
/// @throws Error listing all that is wrong with the scene, PluginError when plugins fail.
Scene load_scene(const std::filesystem::path& path, const Overrides& overrides, PluginHost& host,
                 Registry& registry);

/// The same for text. Entry point of the fuzz target.
/// @param path for messages and relative file names; need not exist
Scene parse_scene_text(const std::string& text, const std::filesystem::path& path, const Overrides& overrides,
                       PluginHost& host, Registry& registry);

/// The names a mesh carries.
struct MeshNames {
  std::set<std::string> boundaries;
  std::set<std::string> regions;
};

/// Checks every name of a boundary or region in the scene against the meshes.
/// @param meshes by the name they have in the scene; names on a mesh that is not among them are not checked
/// @throws Error naming the place of each unknown name and that of its mesh.
void check_mesh_names(const Scene& scene, const Registry& registry,
                      const std::map<std::string, MeshNames>& meshes);

}  // namespace seam
