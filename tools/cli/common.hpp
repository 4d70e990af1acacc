// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "seam/plugin/plugin_host.hpp"
#include "seam/plugin/registry.hpp"
#include "seam/scene/scene.hpp"

namespace seam::cli {

/// A registry with the types that need no plugin.
Registry builtin_types();

/// Splits the values of `--set a.b=c` for load_scene().
/// @throws Error when one has no '='.
Overrides parse_overrides(const std::vector<std::string>& values);

/// Loads the named plugins, or (with `all`) every one that is found and can be used.
void load_plugins(const std::vector<std::string>& names, bool all, PluginHost& host, Registry& registry);

}  // namespace seam::cli
