// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "seam/mesh/mesh_data.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/scene/schema.hpp"

namespace seam {

/// How the rectangles of a triangle grid are cut: along the diagonal that rises in x, the one that falls, or
/// both in turn (which favours no direction).
enum class Diagonals { alternating, rising, falling };

/// A box cut into cells by lines (planes) of constant x, y and z.
struct Grid {
  CellType cell = CellType::quadrilateral;   ///< its dimension is that of the mesh
  int order = 1;                             ///< of the geometry
  std::array<std::vector<double>, 3> lines;  ///< per direction, increasing, at least two
  Diagonals diagonals = Diagonals::alternating;
};

/// The lines of n cells between two places. Their widths form a geometric sequence.
/// @param ratio width of the last cell over that of the first
std::vector<double> graded_lines(double from, double to, int n, double ratio = 1.0);

/// The mesh of a box. Nodes are numbered lexicographically, x first. Boundaries: x_min, x_max, y_min, ...
/// Tetrahedra: six of them per brick, all around the diagonal from its lowest to its highest corner.
/// @throws Error when the grid has more entries than numbers of type int can count
MeshData make_grid(const Grid& grid);

/// Keys of a scene's `grid`.
Schema grid_schema();

/// The mesh that a scene's `grid` describes.
/// @throws Error with the place in the scene
MeshData load_grid(const Parameters& parameters, int dimension);

}  // namespace seam
