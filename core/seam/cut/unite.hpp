// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/cut/border.hpp"

namespace seam::cutting {

/// Replaces the facets by the boundary of the union of all bodies in the plane: facets, or their parts, that
/// have a body on one side only. Facets are split where they meet, at points of the
/// lattice, and each kind of part is tested exactly once. A point is covered when the winding number of any
/// body is positive there.
/// @param border of the mesh: beyond it open surfaces end, so that nothing follows from there for what is
/// inside
void unite_in_plane(Facets& facets, const Border& border);

}  // namespace seam::cutting
