// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "seam/plugin/registry.hpp"
#include "seam/scene/scene.hpp"

namespace seam {

/// Every value of a scene by its key path ("fields.water.boundary.0.on"), with what `--set` replaces applied
/// and what the schemas of its types fill in, in one spelling: numbers as short as they can be, formulas
/// without blanks and with the values of the parameters, files by a checksum of their content. What a type
/// derives by itself where an optional key is left out is not among them.
using ResolvedScene = std::map<std::string, std::string>;

/// @param registry with the types of the scene's plugins, as load_scene() left it
/// @throws Error when a file that the scene names cannot be read
ResolvedScene resolve(const Scene& scene, const Registry& registry);

/// Whether a value decides what is computed. A key is taken to do so unless it is known not to.
bool determines_numbers(std::string_view path);

/// Whether a value says what is measured while the run goes on: what a series holds cannot be had from it in
/// another way afterwards, as formulas, statistics and checks can.
bool says_what_is_measured(std::string_view path);

/// Of the values that decide what is computed, 16 hexadecimal digits.
std::string resolved_checksum(const ResolvedScene& values);

/// What of two scenes differs in values that decide what is computed or measured, one line a key:
/// "fields.beam.density: 1000, now 4000".
std::vector<std::string> resolved_differences(const ResolvedScene& before, const ResolvedScene& now);

}  // namespace seam
