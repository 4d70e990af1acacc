// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/record/results.hpp"
#include "seam/run/scene_builder.hpp"

namespace seam {

/// A scene that is set up, at its start.
struct SceneAtStart {
  const Scene& scene;
  const BuiltScene& built;
  const Results& first;  ///< what was recorded there
  double start, end;     ///< s
  double step;           ///< length of the first one, s
};

/// What is legal, but hardly meant: an interface of which nothing lies in its field, a field without
/// unknowns, bodies that overlap, walls whose velocity is not the rate of their motion. Collective.
std::vector<Diagnostic> scene_doubts(const SceneAtStart& scene);

}  // namespace seam
