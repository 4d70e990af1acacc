// SPDX-License-Identifier: BSD-3-Clause
#include "cut_flow.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "couplings.hpp"
#include "fluid.hpp"
#include "seam/cut/cut_interface.hpp"
#include "seam/interface/matching.hpp"
#include "seam/surface/body.hpp"

namespace seam::test {

Registry fluid_types() {
  Registry registry;
  register_linear_solvers(registry);
  register_matching(registry);
  register_cut(registry);
  register_bodies(registry);
  fluid::declare_stabilisations(registry);
  fluid::declare_couplings(registry);
  registry.add<Physics>(
      "field", "cutfem_fluid", fluid::Fluid::schema(),
      [](const Parameters& p, const Registry& r) { return std::make_unique<fluid::Fluid>(p, r); });
  return registry;
}

std::string BodyInFlow::scene() const {
  const int dim = exact.dimension();
  std::string keys;
  for (const char c : exact.scene(field)) keys += c == '\n' ? "\n    " : std::string(1, c);
  const std::string box = !grid.empty() ? grid
                          : dim == 2
                              ? fmt::format("from: [0, 0], to: [1, 1], cells: [{0}, {0}]", cells)
                              : fmt::format("from: [0, 0, 0], to: [1, 1, 1], cells: [{0}, {0}, {0}]", cells);
  return fmt::format(
      "title: A body in a manufactured flow\ndimension: {0}\nplugins: []\n"
      "meshes: {{box: {{grid: {{{1}, cell: {2}}}}}}}\n"
      "fields:\n  water:\n    type: cutfem_fluid\n    mesh: box\n    {3}\n"
      "interfaces:\n  body: {{type: cut, field: water, body: {4}}}\n"
      "coupling: [{{type: fluid_wall, on: body, velocity: {5}{6}{7}}}]\n"
      "time: {8}\noutput:\n  fields: false\n  errors:\n"
      "    v: {{field: water, unknown: velocity, exact: {5}, gradient: {9}}}\n"
      "    p: {{field: water, unknown: pressure, exact: [\"{10}\"]}}\n",
      dim, box, cell, keys, body, quoted(exact.velocity), coupling.empty() ? "" : ", ", coupling, time,
      quoted(exact.gradient), exact.pressure);
}

FlowRun::FlowRun(const std::string& text)
    : scene_(parse_scene_text(text, "flow.yaml", {}, host_, types_)),
      simulation_(std::make_unique<Simulation>(scene_, types_, Communicator())) {}

FlowRun::FlowRun(const std::string& path, Overrides overrides)
    : scene_([&] {
        overrides.emplace_back("plugins", "[]");
        return load_scene(path, overrides, host_, types_);
      }()),
      simulation_(std::make_unique<Simulation>(scene_, types_, Communicator())) {}

const Results& FlowRun::run() {
  RunOptions options;
  // Of this process alone: the tests may run several times at once.
  options.folder = std::filesystem::temp_directory_path() / fmt::format("seam_cut_flow_test_{}", getpid());
  options.quiet = true;
  const Results& results = simulation_->run(options);
  std::filesystem::remove_all(options.folder);
  return results;
}

CutErrors errors_of(const Results& results) {
  return {results.once.at("v.l2"), results.once.at("v.h1"), results.once.at("p.l2")};
}

CutErrors errors_of(const BodyInFlow& flow) {
  FlowRun run(flow.scene());
  return errors_of(run.run());
}

}  // namespace seam::test
