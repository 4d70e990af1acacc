// SPDX-License-Identifier: BSD-3-Clause
#include "seam/run/scene_builder.hpp"

#include <fmt/format.h>

#include <cmath>

#include "seam/base/error_list.hpp"
#include "seam/base/memory.hpp"
#include "seam/base/plugin_fault.hpp"
#include "seam/base/policy.hpp"
#include "seam/cut/cell_costs.hpp"
#include "seam/mesh/input/mesh_input.hpp"

namespace seam {
namespace {

using Meshes = std::map<std::string, std::shared_ptr<const MeshData>>;

Meshes load_meshes(const Scene& scene) {
  Meshes meshes;
  std::string errors;
  for (const auto& [name, parameters] : scene.root.map("meshes")) {
    try {
      meshes[name] =
          needing_memory(fmt::format("the mesh '{}'", name), parameters.where(),
                         [&, &of = parameters] { return std::make_shared<MeshData>(load_mesh(of)); });
    } catch (const OutOfMemory&) {
      throw;
    } catch (const Error& error) {
      errors += (errors.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  if (!errors.empty()) throw Error(errors);
  return meshes;
}

/// What can be named on them.
std::map<std::string, MeshNames> mesh_names(const Meshes& meshes) {
  std::map<std::string, MeshNames> names;
  for (const auto& [name, mesh] : meshes) {
    for (const auto& entry : mesh->boundaries) names[name].boundaries.insert(entry.first);
    for (const auto& entry : mesh->regions) names[name].regions.insert(entry.first);
  }
  return names;
}

/// A bound on the unknowns of a field, before there are any.
void require_allowed_unknowns(const Physics& physics, const MeshData& mesh, const Location& where) {
  if (physics.support() == Support::point) return;
  double unknowns = 0;
  for (const Unknown& unknown : physics.unknowns(mesh.dimension)) {
    // Halved edges: 2^dimension times as many nodes.
    const double nodes =
        mesh.node_count() * (unknown.order > mesh.order ? std::pow(2.0, mesh.dimension) : 1.0);
    unknowns += unknown.given ? 0 : nodes * unknown.components;
  }
  require_within(unknowns, policy().limits.unknowns, "unknowns", "unknowns of the field, about", where);
}

/// What the cells of a mesh cost, from the bodies that cut it at the start; empty where they all cost the
/// same.
std::vector<double> cell_costs(const Scene& scene, const BuiltScene& built, const std::string& mesh,
                               const Communicator& communicator, double start) {
  if (communicator.size() == 1) return {};
  std::vector<const Interface*> cutting;
  for (const auto& [name, interface] : built.interfaces)
    for (const auto& [field, parameters] : scene.root.map("fields"))
      if (field == interface->fields().front() && parameters.text("mesh") == mesh)
        cutting.push_back(interface.get());
  if (cutting.empty()) return {};
  // Every rank holds the whole mesh at the start and finds the same costs.
  const Mesh whole(mesh, built.meshes.at(mesh), Communicator(MPI_COMM_SELF));
  const MeshFinder find = built.mesh_finder();
  std::vector<Surface> bodies;
  for (const Interface* interface : cutting)
    if (auto body = interface->body({whole, find}, start)) bodies.push_back(std::move(*body));
  return bodies.empty() ? std::vector<double>{} : cut_cell_costs(whole, bodies);
}

void add_field(BuiltScene& built, const std::string& name, const Parameters& parameters,
               const std::shared_ptr<const Mesh>& mesh, const Registry& registry) {
  auto physics = registry.create<Physics>("field", parameters);
  const std::string plugin = plugin_of(*physics);
  call_plugin(
      parameters.where(), [&] { return fmt::format("field '{}'{}", name, plugin); },
      [&] {
        require_allowed_unknowns(*physics, mesh->whole(), parameters.where());
        const std::vector<Unknown> brought =
            unknowns_of_couplings(built, name, mesh->dimension(), physics->unknowns(mesh->dimension()));
        built.problem->add_field(name, mesh, std::move(physics), parameters.where(), brought);
      });
}

void add_constraint(Problem& problem, const Parameters& parameters, const Registry& registry) {
  auto constraint = registry.create<Constraint>("constraint", parameters);
  const std::string plugin = plugin_of(*constraint);
  call_plugin(
      parameters.where(), [&] { return fmt::format("constraint '{}'{}", parameters.type(), plugin); },
      [&] { problem.add_constraint(std::move(constraint), parameters.where()); });
}

}  // namespace

BuiltScene build_scene(const Scene& scene, const Registry& registry, const Communicator& communicator,
                       double start) {
  BuiltScene built;
  built.problem = std::make_unique<Problem>(communicator);
  built.meshes = load_meshes(scene);
  check_mesh_names(scene, registry, mesh_names(built.meshes));
  ErrorList errors(communicator);
  for (const auto& [name, parameters] : scene.root.map("interfaces"))
    errors.attempt([&, &called = name, &of = parameters] {
      built.interfaces.emplace_back(called, registry.create<Interface>("interface", of));
    });
  for (const Parameters& parameters : scene.root.list("coupling"))
    errors.attempt([&] {
      built.couplings.push_back({parameters, registry.create<Coupling>("coupling", parameters)});
    });
  std::map<std::string, std::shared_ptr<const Mesh>> distributed;
  for (const auto& [name, parameters] : scene.root.map("fields")) {
    const std::string& mesh = parameters.text("mesh");
    if (!distributed.contains(mesh))
      distributed[mesh] = needing_memory(
          fmt::format("the distributed mesh '{}' ({} cells)", mesh, built.meshes.at(mesh)->cell_count()),
          parameters.where(), [&] {
            return std::make_shared<Mesh>(mesh, built.meshes.at(mesh), communicator,
                                          cell_costs(scene, built, mesh, communicator, start));
          });
    errors.attempt([&, &called = name, &of = parameters] {
      needing_memory(fmt::format("the unknowns of the field '{}'", called), of.where(),
                     [&] { add_field(built, called, of, distributed[mesh], registry); });
    });
  }
  errors.throw_if_any();
  build_couplings(scene, built);
  for (const Parameters& parameters : scene.root.list("constraints"))
    errors.attempt([&] { add_constraint(*built.problem, parameters, registry); });
  errors.throw_if_any();
  return built;
}

}  // namespace seam
