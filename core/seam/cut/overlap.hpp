// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "seam/surface/surface.hpp"

namespace seam {

/// A vertex of one closed surface that lies within the other, m. Surfaces that cross without a vertex inside
/// of each other, as a cross of two bars, are not found.
std::optional<std::vector<double>> vertex_inside(const Surface& a, const Surface& b);

/// Whether a point lies within the body that a closed surface bounds.
bool is_inside(const Surface& surface, const double* x);

}  // namespace seam
