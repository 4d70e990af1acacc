// SPDX-License-Identifier: BSD-3-Clause
// seam check: all that a run does before its first step, so that what a run would refuse is refused here.
#include <fmt/ranges.h>

#include <cstdio>
#include <memory>

#include "command.hpp"
#include "seam/run/simulation.hpp"
#include "seam/scene/resolved.hpp"
#include "session.hpp"

namespace seam::cli {

namespace {

struct Options {
  std::string scene;
  std::vector<std::string> set;
  bool without_meshes = false;
  bool resolved = false;
};

/// Every value, those that decide what is computed apart from the others.
void print_resolved(const ResolvedScene& values) {
  fmt::print("# decide what is computed, checksum {}\n", resolved_checksum(values));
  for (const auto& [path, value] : values)
    if (determines_numbers(path)) fmt::print("{}: {}\n", path, value);
  fmt::print("# the others\n");
  for (const auto& [path, value] : values)
    if (!determines_numbers(path)) fmt::print("{}: {}\n", path, value);
}

void print_contents(Simulation& simulation) {
  for (const FieldEntry& entry : simulation.problem().fields()) {
    const MeshData& mesh = entry.mesh->whole();
    std::vector<std::string> unknowns;
    for (const Unknown& unknown : entry.field->unknowns())
      unknowns.push_back(fmt::format("{} ({})", unknown.name, unknown.unit.empty() ? "-" : unknown.unit));
    fmt::print("field {}: {}; mesh {} of {} {} cells of order {}, {} nodes\n", entry.name,
               fmt::join(unknowns, ", "), entry.mesh->name(), mesh.cell_count(), seam::name(mesh.type),
               mesh.order, mesh.node_count());
  }
  fmt::print("recorded at each step: {}\n", fmt::join(simulation.results().names(), ", "));
  fmt::print("{} unknowns\n", simulation.unknowns());
}

int run(const Options& options, bool is_root) {
  Registry registry = builtin_types();
  PluginHost host = PluginHost::standard();
  const Scene scene = load_scene(options.scene, parse_overrides(options.set), host, registry);
  Diagnostics warnings = scene.warnings;
  if (options.resolved) {
    if (is_root) print_resolved(resolve(scene, registry));
    return ok;
  }
  if (!options.without_meshes) {
    Simulation simulation(scene, registry, Communicator());
    simulation.prepare();
    simulation.require_held();
    simulation.find_conflicts();
    warnings = simulation.warnings();
    if (is_root) print_contents(simulation);
  }
  if (is_root && !warnings.all().empty()) fmt::print(stderr, "{}\n", warnings.text());
  if (is_root) fmt::print("{}: ok\n", options.scene);
  return ok;
}

}  // namespace

Command check_command(CLI::App& parent) {
  CLI::App* app = parent.add_subcommand(
      "check", "Check a scene: set it up as `run` does before the first step, without writing anything");
  auto options = std::make_shared<Options>();
  app->add_option("scene", options->scene, "YAML file")->required();
  app->add_option("--set", options->set, "replace a value: key.key=value; may be repeated")->take_all();
  app->add_flag("--without-meshes", options->without_meshes, "look at the text alone: nothing is built");
  app->add_flag(
      "--resolved", options->resolved,
      "print every value with its key path, defaults filled in, and the checksum of those that decide "
      "what is computed; nothing is built");
  return {app, [options] { return run_on_all_ranks([&](bool is_root) { return run(*options, is_root); }); }};
}

}  // namespace seam::cli
