// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "exact_flow.hpp"
#include "seam/plugin/plugin_host.hpp"
#include "seam/run/simulation.hpp"
#include "seam/scene/scene.hpp"

/// Flows around bodies that are cut out of the mesh, run as scenes.
namespace seam::test {

/// What a scene may name: the core's types and this plugin's, compiled in.
Registry fluid_types();

/// A body with the exact velocity on its boundary, in a manufactured flow.
struct BodyInFlow {
  ExactFlow exact;
  std::string cell = "quadrilateral";
  int cells = 20;  ///< per direction
  std::string body = "{type: circle, centre: [0.47, 0.53], radius: 0.231}";
  std::string field = {};     ///< further keys of the fluid
  std::string coupling = {};  ///< further keys of the wall, as "penalty: {normal: 1}"
  std::string time = "{static: true, end: 1}";
  /// Of the grid; the unit square or cube unless given.
  std::string grid = {};
  [[nodiscard]] std::string scene() const;
};

/// A scene that is run in this process.
class FlowRun {
 public:
  explicit FlowRun(const std::string& text);
  FlowRun(const std::string& path, Overrides overrides);
  /// @throws Error when a step fails
  const Results& run();
  [[nodiscard]] Simulation& simulation() { return *simulation_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }

 private:
  Registry types_ = fluid_types();
  PluginHost host_{{}};
  Scene scene_;
  std::unique_ptr<Simulation> simulation_;
};

/// Errors of a run of BodyInFlow, over the fluid.
struct CutErrors {
  double velocity, gradient, pressure;
};
CutErrors errors_of(const Results& results);
/// Runs the flow. @throws Error when it fails
CutErrors errors_of(const BodyInFlow& flow);

}  // namespace seam::test
