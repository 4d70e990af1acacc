// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/cut/lattice.hpp"

namespace seam::cutting {

/// A part of a facet of the plane.
struct Segment {
  LatticePoint a, b;
  int facet;  ///< index into Facets::list
};

/// Splits segments of the plane, rounding to the lattice, until any two of them share at most end points or
/// coincide. Parts without extent are left out.
/// @return whether anything was split
bool split_at_meetings(std::vector<Segment>& segments);

}  // namespace seam::cutting
