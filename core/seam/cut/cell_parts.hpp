// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/cut/geometry.hpp"

namespace seam::cutting {

/// Divides the wet part of a cut cell into its connected parts. Parts without a wet face, which nothing but
/// the cell itself could hold, stay with the largest one.
/// @param is_convex whether the cell is; of others in space the wet part counts as connected
/// @return the parts, ordered by where they lie; empty when there is only one
std::vector<CellPart> connected_parts(const Outline& outline, const CutCell& cell, bool is_convex);

/// Whether wet faces of two parts of neighbouring cells overlap on their common face.
/// @param size of the cells, m: what is less than 1e-12 of it is rounding
bool touch(int dimension, const CutCell& first, int first_face, const CutCell& second, int second_face,
           double size);

/// Centre of the volume of a cell's wet part, or of its boundary where there is next to no volume.
/// @param middle of the cell
Vector wet_centre(int dimension, const CutCell& cell, const Vector& middle);

/// Whether a point lies in the wet part of a cell, or of a part of it.
bool contains(int dimension, const CutCell& cell, const Vector& x);

/// Moves all that bounds one part to another.
void merge_parts(const Outline& outline, std::vector<CellPart>& parts, int from, int to);

}  // namespace seam::cutting
