// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/cut/cut_mesh.hpp"
#include "seam/space/space.hpp"

namespace seam {

/// The fluid parts of the cut cells that this rank owns, as linear triangles or tetrahedra for pictures.
/// Corners of neighbouring cells that coincide are one point, and so are corners and nodes of the space.
struct ClippedCells {
  /// @param active per local cell
  ClippedCells(const Space& space, const CutMesh& cut, const std::vector<char>& active);

  /// Appends the values of nodal functions of the space at the points.
  /// @param values [node][component] on entry, [node or point][component] on return
  void append_values(int components, std::vector<double>& values) const;

  std::vector<double> points;   ///< [point][dimension], m: further ones behind the nodes of the space
  std::vector<int> simplices;   ///< [simplex][dimension + 1]: nodes of the space, then points
  std::vector<int> background;  ///< [simplex]: the local cell it lies in

 private:
  const Space* space_;
  std::vector<int> cell_;            ///< [point]: local cell with whose functions it is evaluated
  std::vector<double> shape_value_;  ///< [point][node of the cell]
};

}  // namespace seam
