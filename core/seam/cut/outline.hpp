// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "seam/cut/lattice.hpp"
#include "seam/mesh/mesh.hpp"

namespace seam::cutting {

/// A planar simplex of a cell's boundary: a segment in the plane, a triangle in space; outward normal to the
/// right of vertex 0 -> 1 or by the right-hand rule.
struct Side {
  std::array<int, 3> vertex{};  ///< of Outline
  std::array<int, 3> edge{};  ///< of Outline: edge k runs from vertex k to the next; in the plane only edge 0
  std::array<signed char, 3>
      forward{};  ///< +1: the side runs along its edge k as the edge does; -1: against it
  int face = 0;   ///< of the cell
};

/// The cells of a mesh as polygons or polyhedra whose sides two neighbours share exactly. Straight edges and
/// planar faces stay whole (a planar quadrilateral is two triangles); bent ones of order 2 are split at their
/// middle nodes, and a quadrilateral that is not planar is four triangles around its middle.
class Outline {
 public:
  explicit Outline(const Mesh& mesh);

  /// Local numbers of the vertices of all cells; order 2 counts middle nodes.
  [[nodiscard]] int vertex_count() const { return static_cast<int>(position.size()); }
  [[nodiscard]] int edge_count() const { return static_cast<int>(edges.size()); }

  int dimension;
  std::vector<Vector> position;           ///< [vertex], m
  std::vector<std::array<int, 2>> edges;  ///< [edge]: vertices
  std::vector<Side> sides;                ///< those of cell c: first_side[c] to first_side[c + 1]
  std::vector<int> first_side;
  std::vector<int> first_edge_of_vertex, edges_of_vertex;  ///< edges at each vertex, in the same manner
  std::vector<std::array<int, 8>> neighbour;  ///< [cell][face]: local cell behind it, -1 where there is none
  Vector low{}, high{};                       ///< box around all cells of all ranks

  [[nodiscard]] Vector centre(int cell) const;
  /// Area or volume of the polygon or polyhedron.
  [[nodiscard]] double volume(int cell) const;

 private:
  void number_vertices(const Mesh& mesh);
  void add_sides(const Mesh& mesh, int cell);
  void split_quadrilateral(const Mesh& mesh, int cell, int face);
  void add_side(int face, const std::array<int, 3>& vertices);
  void number_edges();
  void find_neighbours(const Mesh& mesh);
  [[nodiscard]] int vertex_of(int cell, int node) const {
    return cell_vertex_[cell * nodes_per_cell_ + node];
  }

  int nodes_per_cell_;
  std::vector<int> cell_vertex_;  ///< [cell][node]
  std::vector<int> global_;       ///< [vertex]: node of the whole mesh; none for middles of faces
  std::map<std::array<int, 4>, int> middles_;  ///< of faces that are not planar, by their sorted corners
};

/// Unit normal out of the cell.
Vector side_normal(const Outline& outline, const Side& side);

}  // namespace seam::cutting
