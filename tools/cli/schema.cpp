// SPDX-License-Identifier: BSD-3-Clause
// seam schema: JSON Schema of scenes, for editors.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "command.hpp"
#include "common.hpp"
#include "seam/scene/json_schema.hpp"

namespace seam::cli {

Command schema_command(CommandLine& parent) {
  CommandLine line = parent.add_subcommand("schema", "Print the JSON Schema of scenes, for editors");
  auto plugins = std::make_shared<std::vector<std::string>>();
  line.add_option("--plugins", *plugins, "with the types of these plugins (default: all that are found)")
      .delimiter(',');
  return {line, [plugins] {
            Registry registry = builtin_types();
            PluginHost host = PluginHost::standard();
            load_plugins(*plugins, plugins->empty(), host, registry);
            fmt::print("{}", json_schema(scene_schema(), registry));
            return int{ok};
          }};
}

}  // namespace seam::cli
