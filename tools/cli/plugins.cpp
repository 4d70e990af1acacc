// SPDX-License-Identifier: BSD-3-Clause
// seam plugins: what is found where, without running any of its code.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>

#include "command.hpp"

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

}  // namespace

Command plugins_command(CLI::App& parent) {
  return {parent.add_subcommand("plugins", "List the plugins that are found, and where"), list};
}

}  // namespace seam::cli
