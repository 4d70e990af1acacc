// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "seam/mesh/cell_type.hpp"

namespace seam {

/// One side of one cell.
struct CellFace {
  int cell;
  int face;  ///< local number in CellTopology::faces
  friend bool operator==(const CellFace&, const CellFace&) = default;
};

/// A whole mesh as it was read or generated, before it is distributed. All cells have one type and one
/// geometric order. Node and cell numbers of this struct are the global numbers of the distributed mesh, so
/// nothing that follows depends on the number of ranks.
struct MeshData {
  int dimension = 2;  ///< of space; cells have the same dimension
  CellType type = CellType::quadrilateral;
  int order = 1;                    ///< of the geometry: 1 or 2
  std::vector<double> coordinates;  ///< `dimension` per node
  std::vector<int> cells;           ///< topology(type).nodes(order) per cell, ordered as CellTopology says
  std::map<std::string, std::vector<CellFace>> boundaries;  ///< named sets of faces (outer or between cells)
  std::map<std::string, std::vector<int>> regions;          ///< named sets of cells

  [[nodiscard]] int node_count() const { return static_cast<int>(coordinates.size()) / dimension; }
  [[nodiscard]] int nodes_per_cell() const { return topology(type).nodes(order); }
  [[nodiscard]] int cell_count() const { return static_cast<int>(cells.size()) / nodes_per_cell(); }
};

}  // namespace seam
