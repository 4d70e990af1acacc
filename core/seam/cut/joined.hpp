// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "seam/cut/lattice.hpp"
#include "seam/surface/surface.hpp"

namespace seam::cutting {

/// Bodies, each with all of its surface.
struct Solids {
  std::vector<Surface> surfaces;
  std::vector<std::vector<std::array<int, 2>>> origin;  ///< [solid][facet]: surface and facet it stems from
};

/// Puts open surfaces together whose rims run along each other, as those of the parts of one body's surface
/// that have interfaces of their own: what lies inside is a matter of all of them. Where no rim is left the
/// result is closed.
/// @param lattice on which rims are compared
Solids join(std::span<const Surface> surfaces, const Lattice& lattice);

}  // namespace seam::cutting
