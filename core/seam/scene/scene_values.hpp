// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "seam/scene/scene.hpp"

namespace seam {

/// Every value that a scene states, by its key path ("fields.water.boundary.0.on"), with what `--set`
/// replaces applied, as text. Of files that it names (meshes, recorded steps) also a checksum of their
/// content, by the key path and "(content)". Defaults are not among them.
std::map<std::string, std::string> scene_values(const Scene& scene);

/// What of two states of a scene makes another simulation, one line a key: "fields.beam.density: 1000, now
/// 4000". Titles, checks, the study and what is written besides series (pictures, intervals, statistics) do
/// not.
std::vector<std::string> scene_differences(const std::map<std::string, std::string>& before,
                                           const std::map<std::string, std::string>& now);

/// Whether a key path is that of a block, or leads into it.
bool is_or_is_within(std::string_view path, std::string_view block);

/// Of a file, 16 hexadecimal digits; "" when it cannot be read.
std::string content_checksum(const std::filesystem::path& file);

}  // namespace seam
