// SPDX-License-Identifier: BSD-3-Clause
// seam explain: the keys of a type, or the list of all types.
#include "seam/scene/explain.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "command.hpp"
#include "common.hpp"

namespace seam::cli {

namespace {

struct Options {
  std::string type;
  std::vector<std::string> plugins;
};

int explain_one(const std::string& name, const Registry& registry) {
  if (name == "scene") {
    fmt::print("{}", explain(scene_schema()));
    return ok;
  }
  std::vector<std::string> known{"scene"};
  bool found = false;
  for (const Registry::Entry& entry : registry.entries()) {
    known.push_back(entry.name);
    // Types of two kinds may share a name; "kind:name" picks one.
    if (entry.name != name && entry.kind + ":" + entry.name != name) continue;
    fmt::print("{}{}", found ? "\n" : "", explain(entry, registry));
    found = true;
  }
  if (found) return ok;
  const std::string guess = nearest_name(name, known);
  throw Error(fmt::format("error: no type is called '{}'.{} `seam explain` lists them all", name,
                          guess.empty() ? "" : fmt::format(" Did you mean '{}'?", guess)));
}

int run(const Options& options) {
  Registry registry = builtin_types();
  PluginHost host = PluginHost::standard();
  load_plugins(options.plugins, options.plugins.empty(), host, registry);
  if (!options.type.empty()) return explain_one(options.type, registry);
  fmt::print("scene\n  {}\n{}", scene_schema().summary(), list_types(registry));
  return ok;
}

}  // namespace

Command explain_command(CommandLine& parent) {
  CommandLine line = parent.add_subcommand(
      "explain", "Show the keys of a type (or of 'scene'); without one, list all types");
  auto options = std::make_shared<Options>();
  line.add_option("type", options->type, "name of a type, kind:name, or 'scene'");
  line.add_option("--plugins", options->plugins, "load only these plugins (default: all that are found)")
      .delimiter(',');
  return {line, [options] { return run(*options); }};
}

}  // namespace seam::cli
