// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

namespace seam {

/// Shapes of cells and of their faces. `point` is the cell of a mesh that carries unknowns without extent, as
/// those of a rigid body.
enum class CellType { point, segment, triangle, quadrilateral, tetrahedron, hexahedron };

/// Topology of a cell type and where the nodes of its Lagrange element of order 2 sit. Vertices, edges and
/// nodes are ordered as VTK orders those of its (bi-, tri-) quadratic cells: vertices, then edge midpoints,
/// then (hexahedron) face midpoints, then the centre (segment, quadrilateral, hexahedron).
///
/// Reference coordinates: [0,1] per direction for segment, quadrilateral and hexahedron; the unit simplex
/// (vertex 0 at the origin) for triangle and tetrahedron.
struct CellTopology {
  CellType type;
  int dimension;
  int vertices;
  std::vector<std::array<int, 2>> edges;
  CellType face_type;                   ///< cells of dimension 2: segment; 3: triangle or quadrilateral
  std::vector<std::vector<int>> faces;  ///< local vertices, outward normal by the right-hand rule (2D:
                                        ///< outward is to the right of 0 -> 1)
  int nodes(int order) const;           ///< number of nodes of the Lagrange element of order 1 or 2
  /// Reference coordinates of the nodes of order 2 (its first ones are those of order 1), `dimension` each.
  std::vector<double> node_coordinates;
  /// Local nodes of order 2 that lie on each face, in the order of the face type's own element.
  std::vector<std::vector<int>> face_nodes;
};

const CellTopology& topology(CellType type);
/// Whether shape functions are polynomials of one total degree; otherwise products of those along directions.
[[nodiscard]] constexpr bool is_simplex(CellType type) {
  return type == CellType::triangle || type == CellType::tetrahedron;
}
std::string name(CellType type);

}  // namespace seam
