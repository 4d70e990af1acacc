// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace seam {

/// Splits weighted points into parts of equal weight by recursive coordinate cuts (Zoltan2's multijagged).
/// @param points `dimension` coordinates each
/// @param weights one per point; empty for equal weights
/// @return the part of every point, in [0, parts)
std::vector<int> partition_points(int dimension, const std::vector<double>& points,
                                  const std::vector<double>& weights, int parts);

}  // namespace seam
