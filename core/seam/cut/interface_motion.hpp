// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/surface/moving_facet.hpp"

namespace seam {

/// How the points of an InterfaceRule move with the vertices of the facet they lie on. The rule as it is
/// computed is differentiated: points keep their share of a piece whose ends slide along the borders of the
/// cell.
struct InterfaceMotion {
  std::vector<MovingPoint<2, 1>> in_plane;  ///< [point]
  std::vector<MovingPoint<3, 1>> in_space;  ///< [point]
  template <int dim>
  [[nodiscard]] auto& points() {
    if constexpr (dim == 2)
      return in_plane;
    else
      return in_space;
  }
  template <int dim>
  [[nodiscard]] const auto& points() const {
    if constexpr (dim == 2)
      return in_plane;
    else
      return in_space;
  }
};

}  // namespace seam
