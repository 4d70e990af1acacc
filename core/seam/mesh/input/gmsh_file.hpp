// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "seam/mesh/cell_type.hpp"

namespace seam {

/// What Gmsh's numbers of element types mean.
struct GmshElementType {
  CellType type;
  int order;
  int nodes;
};

/// The contents of a Gmsh file as they stand there, both formats alike.
struct GmshFile {
  struct Elements {
    GmshElementType type;
    std::vector<int> groups;  ///< tags of the physical groups
    std::vector<int> nodes;   ///< index into node_tags, `type.nodes` per element, in Gmsh's order
    int line = 0;             ///< of the first element
  };
  std::vector<long long> node_tags;
  std::vector<std::array<double, 3>> node_positions;
  std::vector<Elements> elements;                          ///< blocks of equal type and groups
  std::map<std::pair<int, int>, std::string> group_names;  ///< by dimension and tag
};

/// Reads the text of a file of format 2.2 or 4.1.
/// @throws Error with file and line
GmshFile parse_gmsh(const std::string& text, const std::string& name);

}  // namespace seam
