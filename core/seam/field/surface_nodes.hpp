// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace seam {

class Space;
struct CellTopology;

/// Of a cell's face between its vertices, m^(d-1). @param x the cell's geometry nodes, [node][dimension]
double face_area(const CellTopology& cell, int face, const double* x);

/// How much of some parts of a mesh's boundary each local node stands for, m^(d-1): every face deals out its
/// area among its nodes alike. 0 where a node lies on none of them. Collective.
/// @param boundaries names; empty for the whole outer surface
/// @throws Error when a name is unknown
std::vector<double> surface_shares(const Space& space, const std::vector<std::string>& boundaries);

/// The other nodes of the faces that a node is on, among those of some parts of the boundary, [owned node];
/// empty but for the nodes asked for. Those that are asked for are not among them.
std::vector<std::vector<int>> nodes_beside(const Space& space, const std::vector<std::string>& boundaries,
                                           const std::vector<char>& asked_for);

}  // namespace seam
