// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "seam/mesh/cell_type.hpp"

namespace seam {

/// Lagrange shape functions of one order on one cell type, tabulated at a set of reference points. Nodes are
/// ordered as CellTopology says.
struct ShapeTable {
  int dimension = 0;  ///< of the reference cell
  int nodes = 0;
  int stride = 0;  ///< nodes, padded with zeros to a multiple of 4 for the assembly's vector instructions
  int points = 0;
  std::vector<double> value;     ///< [point][stride]
  std::vector<double> gradient;  ///< [point][direction][stride], with respect to reference coordinates
  std::vector<double> hessian;   ///< [point][direction][direction][stride]; empty unless asked for

  [[nodiscard]] const double* value_at(int q) const {
    return value.data() + static_cast<std::ptrdiff_t>(q) * stride;
  }
  [[nodiscard]] const double* gradient_at(int q) const {
    return gradient.data() + static_cast<std::ptrdiff_t>(q) * stride * dimension;
  }
  [[nodiscard]] const double* hessian_at(int q) const {
    return hessian.data() + static_cast<std::ptrdiff_t>(q) * stride * dimension * dimension;
  }
};

/// Tabulates the shape functions of order 1 or 2 at `points` (dimension coordinates each).
void tabulate(CellType type, int order, const double* points, int count, bool with_hessian,
              ShapeTable& table);

/// Maps reference coordinates on a face to those of its cell.
/// @param on_face coordinates in the face type's reference cell, `dimension - 1` of them
/// @param in_cell result, `dimension` of them
void face_to_cell(const CellTopology& cell, int face, const double* on_face, double* in_cell);

/// Volume of a cell, m^dimension; negative when it is turned inside out, 0 for a point.
/// @param order of the geometry
/// @param nodes [geometry node][dimension]
double cell_volume(CellType type, int order, const double* nodes);

}  // namespace seam
