// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>
#include <vector>

#include "seam/scene/expression.hpp"
#include "seam/term/kernel_term.hpp"

namespace seam {

/// Functions of position and time at a point, one for each of `count` components. Where the position carries
/// derivatives, so does the result: a function gives values, whose differences over 1e-5 cells are exact
/// enough for a tangent.
/// @param position where they are evaluated, m
/// @param x gives time and cell size
template <int count, int dim, class G>
Vec<count, G> evaluate_at(const std::vector<Expression>& functions, const Vec<dim, G>& position,
                          const Point<dim, G>& x) {
  Vec<count, G> value;
  double here[dim];
  for (int i = 0; i < dim; ++i) here[i] = plain(position[i]);
  for (int c = 0; c < count; ++c) value[c] = functions[c](here, dim, x.time);
  if constexpr (!std::is_same_v<G, double>) {
    const double step = 1e-5 * x.cell_size;
    for (int i = 0; i < dim; ++i) {
      double slope[count];
      here[i] += step;
      for (int c = 0; c < count; ++c) slope[c] = functions[c](here, dim, x.time);
      here[i] -= 2 * step;
      for (int c = 0; c < count; ++c) slope[c] = (slope[c] - functions[c](here, dim, x.time)) / (2 * step);
      here[i] += step;
      const G moved = position[i] - here[i];
      for (int c = 0; c < count; ++c) value[c] += slope[c] * moved;
    }
  }
  return value;
}

}  // namespace seam
