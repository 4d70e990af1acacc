// SPDX-License-Identifier: BSD-3-Clause
// seam schema: JSON Schema of scenes, for editors.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "command.hpp"
#include "seam/scene/json_schema.hpp"

namespace seam::cli {

Command schema_command(CLI::App& parent) {
  CLI::App* app = parent.add_subcommand("schema", "Print the JSON Schema of scenes, for editors");
  auto plugins = std::make_shared<std::vector<std::string>>();
  app->add_option("--plugins", *plugins, "with the types of these plugins (default: all that are found)")
      ->delimiter(',');
  return {app, [plugins] {
            Registry registry = builtin_types();
            PluginHost host = PluginHost::standard();
            load_plugins(*plugins, plugins->empty(), host, registry);
            fmt::print("{}", json_schema(scene_schema(), registry));
            return int{ok};
          }};
}

}  // namespace seam::cli
