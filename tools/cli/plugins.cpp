// SPDX-License-Identifier: BSD-3-Clause
// seam plugins: what is found where, without running any of its code.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "command.hpp"
#include "common.hpp"
#include "seam/plugin/descriptor.hpp"

namespace seam::cli {

namespace {

void print(const PluginHost::Found& found) {
  fmt::print("{}\n  file:     {}\n", found.name, found.file.string());
  for (const auto& hidden : found.hidden) fmt::print("  hides:    {} (not used)\n", hidden.string());
  const std::string problem = found.why_not();
  if (!problem.empty()) fmt::print("  unusable: {}\n", problem);
  if (found.info.name.empty()) return;
  fmt::print("  version:  {} ({}), plugin ABI {}.{}\n", found.info.version, found.info.licence,
             found.info.abi_major, found.info.abi_minor);
  if (!found.info.required_plugins.empty()) {
    fmt::print("  requires: {}\n", fmt::join(found.info.required_plugins, ", "));
  }
  for (const auto& [kind, type] : found.info.provides) fmt::print("  provides: {} {}\n", kind, type);
}

int list() {
  const PluginHost host = PluginHost::standard();
  const auto found = host.scan();
  for (const PluginHost::Found& plugin : found) print(plugin);
  fmt::print("{}{} plugins in:\n", found.empty() ? "" : "\n", found.size());
  for (const auto& folder : host.folders()) fmt::print("  {}\n", folder.string());
  for (const std::string& refused : host.refused()) fmt::print("  {}\n", refused);
  if (host.folders().empty() && host.refused().empty()) fmt::print("  (no folder; set SEAM_PLUGIN_PATH)\n");
  fmt::print("this Seam: plugin ABI {}.{}, headers {}, {}\n", plugin_abi_major, plugin_abi_minor,
             host_headers(), host_fingerprint());
  return ok;
}

/// All kinds of types, and which there are of each: of the core, and of the plugins that can be used.
int list_kinds() {
  std::map<std::string, std::vector<std::string>> types;
  const Registry builtin = builtin_types();
  for (const Registry::Entry& entry : builtin.entries()) types[entry.kind].push_back(entry.name);
  const PluginHost host = PluginHost::standard();
  for (const PluginHost::Found& found : host.scan())
    for (const auto& [kind, type] : found.info.provides)
      if (found.why_not().empty()) types[kind].push_back(fmt::format("{} ({})", type, found.name));
  for (auto& [kind, names] : types) {
    std::ranges::sort(names);
    fmt::print("{:<20} {}\n", kind, fmt::join(names, ", "));
  }
  return ok;
}

}  // namespace

Command plugins_command(CommandLine& parent) {
  CommandLine line = parent.add_subcommand("plugins", "List the plugins that are found, and where");
  const auto kinds = std::make_shared<bool>(false);
  line.add_flag("--kinds", *kinds, "List the kinds of types instead, and the types of each");
  return {line, [kinds] { return *kinds ? list_kinds() : list(); }};
}

}  // namespace seam::cli
