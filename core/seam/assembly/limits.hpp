// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace seam {

// Sizes of arrays in the innermost loops over elements. What exceeds them is refused where terms are bound.
inline constexpr int most_operands = 32;  ///< unknowns that a kernel speaks of
inline constexpr int most_columns = 256;  ///< numbers that it reads at a point
inline constexpr int most_moves = 36;     ///< derivatives of a point that moves: of four facets in space

}  // namespace seam
