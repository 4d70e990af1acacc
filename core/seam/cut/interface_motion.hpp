// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace seam {

/// How the points of an InterfaceRule move with the vertices of the facet they lie on: derivatives with
/// respect to move k = vertex * dimension + component of the facet's vertices, dimension^2 of them. The rule
/// as it is computed is differentiated: points keep their share of a piece whose ends slide along the borders
/// of the cell.
struct InterfaceMotion {
  std::vector<double> position;         ///< [point][dimension][move]
  std::vector<double> normal;           ///< [point][dimension][move], 1/m
  std::vector<double> relative_weight;  ///< [point][move], 1/m
  std::vector<double> facet_reference;  ///< [point][dimension - 1][move], 1/m
  std::vector<double> span;             ///< in the plane: of InterfaceRule::span, [point][2][move], 1/m
};

}  // namespace seam
