// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "seam/base/diagnostics.hpp"
#include "seam/plugin/registry.hpp"
#include "seam/scene/function.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/scene/schema.hpp"
#include "seam/scene/yaml_tree.hpp"

namespace seam {

/// Whole numbers of a scene are counted with in int.
constexpr long largest_integer = 2147483647;

/// What validation needs to know, and what it finds out on the way.
struct ValidationContext {
  const Registry& registry;
  Diagnostics& diagnostics;
  int dimension = 2;
  std::map<std::string, double> parameters;  ///< usable in expressions
  std::filesystem::path folder;              ///< files are relative to it
  bool files_must_exist = true;
  /// Name of a plugin that is found but not loaded and provides the type (kind, name), or "".
  std::function<std::string(const std::string& kind, const std::string& name)> provider;
  /// Plugins whose types the scene uses. Filled by validate().
  std::set<std::string> used_plugins;
  /// Named functions whose parts expressions may use; null for one that could not be created.
  std::map<std::string, std::shared_ptr<const Function>> functions = {};
  /// Where expressions use them: key path ("fields.water.boundary.0.velocity") and text ("exact.velocity").
  /// Filled by validate().
  std::map<std::string, std::string> function_parts = {};
};

/// Checks a YAML object against a schema and turns it into values, defaults filled in. All errors go to
/// `context.diagnostics`, with place, offending key or value, what is allowed and the nearest known name; a
/// key in error has no value in the result.
/// @param path how messages call the object: "fields.water", "" for the scene itself
Parameters validate(const YamlNode& node, const Schema& schema, ValidationContext& context,
                    const std::string& path);

/// Creates the functions of a scene's block `functions`, ahead of the validation that needs them: afterwards
/// expressions may use their parts. What is wrong in the block is left to validate() to report.
/// @param node the scene
void create_functions(const YamlNode& node, const Schema& schema, ValidationContext& context);

/// Evaluates a block of named constants, each of which may use those before it.
std::map<std::string, double> evaluate_parameters(const YamlNode& node, Diagnostics& diagnostics);

/// "number", "list of numbers", ...: the kind in words, for messages, `seam explain` and the reference pages.
std::string describe(const Parameter& parameter, int dimension = 0);

/// The allowed range in words: "above 0, at most 0.5"; "" when there is none.
std::string describe_range(const Parameter& parameter);

}  // namespace seam
