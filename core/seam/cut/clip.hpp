// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "seam/cut/facets.hpp"
#include "seam/cut/geometry.hpp"
#include "seam/cut/outline.hpp"

namespace seam::cutting {

/// What clipping reads: the mesh on the lattice and the facets.
struct ClipInput {
  const Outline& outline;
  const std::vector<LatticePoint>& vertex;  ///< of the outline
  const Facets& facets;
};

/// Finds the pieces of some facets in a cell of the plane and where they pass through its sides.
void clip_segments(const ClipInput& input, std::span<const int> facets, CutCell& cell);
/// The wet parts of a plane cell's sides, given how often its vertices are covered by bodies.
void find_wet_sides(const ClipInput& input, const std::vector<int>& coverage, CutCell& cell);

/// The same in space, with a cell's edges and triangles in place of its sides.
void clip_triangles(const ClipInput& input, std::span<const int> facets, CutCell& cell);
void find_wet_faces(const ClipInput& input, const std::vector<int>& coverage, CutCell& cell);

}  // namespace seam::cutting
