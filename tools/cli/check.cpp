// SPDX-License-Identifier: BSD-3-Clause
// seam check: everything about a scene that can be known without solving it.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "command.hpp"
#include "seam/mesh/input/mesh_input.hpp"

namespace seam::cli {

namespace {

struct Options {
  std::string scene;
  std::vector<std::string> set;
  bool without_meshes = false;
};

/// Loads all meshes, so that the errors of several are reported at once.
std::map<std::string, MeshNames> mesh_names(const Scene& scene) {
  std::map<std::string, MeshNames> result;
  std::string errors;
  for (const auto& [name, parameters] : scene.root.map("meshes")) {
    try {
      const MeshData mesh = load_mesh(parameters);
      MeshNames& names = result[name];
      for (const auto& boundary : mesh.boundaries) names.boundaries.insert(boundary.first);
      for (const auto& region : mesh.regions) names.regions.insert(region.first);
      fmt::print("mesh {}: {} {} cells of order {}, {} nodes\n", name, mesh.cell_count(),
                 seam::name(mesh.type), mesh.order, mesh.node_count());
    } catch (const Error& e) {
      errors += (errors.empty() ? "" : "\n") + std::string(e.what());
    }
  }
  if (!errors.empty()) throw Error(errors);
  return result;
}

int run(const Options& options) {
  Registry registry = builtin_types();
  PluginHost host = PluginHost::standard();
  const Scene scene = load_scene(options.scene, parse_overrides(options.set), host, registry);
  if (!options.without_meshes) check_mesh_names(scene, registry, mesh_names(scene));
  if (!scene.warnings.all().empty()) fmt::print(stderr, "{}\n", scene.warnings.text());
  fmt::print("{}: ok\n", options.scene);
  return ok;
}

}  // namespace

Command check_command(CLI::App& parent) {
  CLI::App* app =
      parent.add_subcommand("check", "Check a scene, its plugins and its meshes, without solving");
  auto options = std::make_shared<Options>();
  app->add_option("scene", options->scene, "YAML file")->required();
  app->add_option("--set", options->set, "replace a value: key.key=value; may be repeated")->take_all();
  app->add_flag("--without-meshes", options->without_meshes, "leave the meshes alone");
  return {app, [options] { return run(*options); }};
}

}  // namespace seam::cli
