// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "seam/mesh/cell_type.hpp"

namespace seam {

/// Values at the points or in the cells of a piece.
struct VtuArray {
  std::string name;
  int components = 1;  ///< 1: scalar, 2 or 3: vector, 9: tensor (row by row), or any other number
  std::vector<double> values;
  std::vector<std::string> component_names = {};  ///< shown by ParaView; empty, or one per component
};

/// What one process writes at one time: cells of one type and order, and parts of cells beside them.
struct VtuPiece {
  int dimension = 2;  ///< coordinates per point: 2 or 3
  CellType type = CellType::quadrilateral;
  int order = 1;
  std::vector<double> points;
  std::vector<int> connectivity;  ///< topology(type).nodes(order) per cell, ordered as CellTopology says
  std::vector<int> simplices;     ///< dimension + 1 points per linear triangle or tetrahedron
  std::vector<VtuArray> point_arrays;
  std::vector<VtuArray> cell_arrays;  ///< of the cells, then of the simplices
};

/// Writes a .vtu file (binary, compressed). Vectors of two components get a third one of 0, as ParaView
/// expects. The file appears under its name only when it is complete.
/// @throws Error when it cannot be written; std::logic_error when sizes contradict each other
void write_vtu(const std::string& path, const VtuPiece& piece);

/// Writes the .pvtu file that joins the pieces of all processes.
/// @param pieces names of the .vtu files relative to the folder of `path`
/// @param like a piece with the same arrays (those of any process: values are not looked at)
void write_pvtu(const std::string& path, const std::vector<std::string>& pieces, const VtuPiece& like);

}  // namespace seam
