// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/interface/interface.hpp"
#include "seam/run/results.hpp"
#include "seam/scene/scene.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

/// A scene that is set up, at its start.
struct BuiltScene {
  const Scene& scene;
  const Problem& problem;
  const std::vector<std::pair<std::string, std::unique_ptr<Interface>>>& interfaces;
  const MeshFinder& meshes;
  const Results& first;  ///< what was recorded at the start
  double start, end;     ///< s
};

/// What is legal, but hardly meant: an interface of which nothing lies in its field, a field without
/// unknowns, bodies that overlap, walls whose velocity is not the rate of their motion. Collective.
std::vector<Diagnostic> scene_doubts(const BuiltScene& built);

}  // namespace seam
