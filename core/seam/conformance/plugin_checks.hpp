// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "seam/conformance/check.hpp"
#include "seam/plugin/plugin_host.hpp"
#include "seam/scene/scene.hpp"

namespace seam {

/// Checks a plugin without a scene: its descriptor fits this Seam, it loads and registers exactly what it
/// declares, and the schema of each type is complete: every key says what it means, every default is valid by
/// its own rules, `seam explain` and the JSON Schema can be made.
/// @param host must find the plugin and those it requires; they are loaded into `registry`
std::vector<ConformanceCheck> check_plugin(const PluginHost::Found& plugin, PluginHost& host,
                                           Registry& registry);

/// Calls `visit` for every object of a registered type in a scene: fields, materials, couplings, solvers.
void for_each_typed(const Scene& scene, const Registry& registry,
                    const std::function<void(const Registry::Entry&, const Parameters&)>& visit);

/// One check per type that the plugin provides: some scene uses it.
/// @param used "kind:name"
std::vector<ConformanceCheck> check_coverage(const PluginInfo& plugin, const std::set<std::string>& used);

}  // namespace seam
