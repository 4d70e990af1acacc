// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/cut/cut_mesh.hpp"
#include "seam/field/field.hpp"

namespace seam {

/// The wet parts of the cut cells that this rank owns, as linear triangles or tetrahedra for pictures.
/// Corners of neighbouring cells that coincide are one point, and so are corners and nodes of the space;
/// where parts of cells may have unknowns of their own, only those of a part are.
struct ClippedCells {
  /// @param field that is cut
  /// @param space one of its own
  ClippedCells(const Field& field, const Space& space);

  /// Appends the values of nodal functions of the space at the points.
  /// @param values [node][component] on entry, [node or point][component] on return
  void append_values(int components, std::vector<double>& values) const;

  std::vector<double> points;   ///< [point][dimension], m: further ones behind the nodes of the space
  std::vector<int> simplices;   ///< [simplex][dimension + 1]: nodes of the space, then points
  std::vector<int> background;  ///< [simplex]: the local cell it lies in

 private:
  const Space* space_;
  std::vector<const int*> nodes_;    ///< [point]: of the part of a cell with whose functions it is evaluated
  std::vector<double> shape_value_;  ///< [point][node of the cell]
};

}  // namespace seam
