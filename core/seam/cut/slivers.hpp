// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/cut/geometry.hpp"

namespace seam::cutting {

/// Share of a cell's volume below which a wet part is not kept.
constexpr double smallest_part = 1e-11;

/// Volumes and areas of a cut cell from its boundary.
void measure(const Outline& outline, CutCell& cell);

/// Takes cut cells out whose wet part is too small: they become body. Their pieces go to the neighbours
/// behind their wet faces, laid onto those faces with the faces' areas, so that every neighbour's interface
/// and remaining wet faces still close. A neighbour that was not cut becomes so. Cut cells whose interface
/// is negligible become wet. Sets `state` of all cells concerned.
void settle_slivers(const Outline& outline, std::vector<CutCell>& cells, std::vector<CellState>& state);

/// A cell that is wet all over, as a cut cell.
CutCell whole_cell(const Outline& outline, int cell);

/// Turns the marked cells into body; where a neighbour stays, pieces are handed over as those of slivers.
void drop_cells(const Outline& outline, const std::vector<char>& dropped, std::vector<CutCell>& cells,
                std::vector<CellState>& state);

}  // namespace seam::cutting
