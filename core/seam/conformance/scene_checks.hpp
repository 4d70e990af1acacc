// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "seam/conformance/check.hpp"
#include "seam/plugin/plugin_host.hpp"
#include "seam/record/results.hpp"
#include "seam/scene/scene.hpp"

namespace seam {

/// What replaces a scene's own settings in the conformance kit: a direct solver, so that runs can be
/// compared, but where the plugin brings solvers itself; a restart point at every step, and no field output.
Overrides conformance_overrides(const PluginInfo& plugin);

/// Runs a scene and checks what must hold in any scene: its own checks, the tangent, the rewind of a failed
/// step (to the bit), a restart in the middle (to the bit). One rank only.
/// @param scene loaded with conformance_overrides()
/// @param folder for results; created
/// @param begins told what is done next: it is what a plugin crashes in
std::vector<ConformanceCheck> check_scene(const Scene& scene, const Registry& registry,
                                          const std::filesystem::path& folder,
                                          const std::function<void(const std::string&)>& begins);

/// Compares the series of runs on several numbers of ranks with those of the first, to 1e-8 of their size: of
/// a component that of its whole vector or tensor; of a formula what its operands make up, since a balance is
/// zero but for rounding; and what a check of the scene says is near enough (`within`).
/// @param files series.csv of each run
/// @param ranks of each run
ConformanceCheck check_ranks(const Scene& scene, const std::vector<std::filesystem::path>& files,
                             const std::vector<int>& ranks);

}  // namespace seam
