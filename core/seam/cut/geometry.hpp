// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/cut/border.hpp"
#include "seam/cut/cell_search.hpp"
#include "seam/cut/cut_mesh.hpp"
#include "seam/cut/facets.hpp"
#include "seam/cut/ghost_values.hpp"
#include "seam/cut/outline.hpp"

namespace seam::cutting {

/// A part of one facet in one cell: a segment in the facet's direction, or a polygon, counter-clockwise seen
/// from outside the body.
struct FacetPiece {
  int body, facet;
  int first, count;  ///< of CutCell::points
  Vector normal;     ///< unit, into the body
  double scale = 1;  ///< of its area
  bool handed_over =
      false;  ///< stems from a neighbour too thin to be kept; no part of the cell's own boundary
};

/// A signed part of one side of a cell; all of them add up to the side's wet part.
struct SideSimplex {
  int face;
  Vector normal;                 ///< unit, of the side, out of the cell
  std::array<Vector, 3> corner;  ///< segment (two of them) or triangle
  double sign;                   ///< +1 or -1
  double area;                   ///< sign included; negative where the corners run against the side
};

/// Where a facet passes through a side (in the plane) or an edge (in space) of a cell.
struct Crossing {
  int body;
  int place;     ///< side of Outline in the plane, edge of Outline in space
  int step;      ///< +1 into the body when walking along it, -1 out of it
  double share;  ///< of its length
  Vector position;
};

/// In space: where a facet's plane passes through a side; seen from outside the cell the body is on its
/// right.
struct Trace {
  int side;  ///< of Outline
  Vector from, to;
};

struct CutCell {
  int cell = -1;
  std::vector<Vector> points;
  std::vector<FacetPiece> pieces;
  std::vector<SideSimplex> wet;
  std::vector<Crossing> crossings;
  std::vector<Trace> traces;
  std::vector<int> facets;  ///< of Facets, that may meet the cell
  bool united = false;      ///< wet parts of faces are triangles that do not overlap
  unsigned dry_faces = 0;   ///< bit f: what lies behind face f was too thin to be kept
  double wet_volume = 0, volume = 0, interface_area = 0;
};

/// One of several connected wet parts of a cell.
struct CellPart {
  CutCell cut;      ///< its own pieces and wet faces
  Vector centre{};  ///< of its volume
};

/// Vector area of a part: of a simplex in the direction of its orientation (in the plane to the right).
Vector vector_area(int dimension, const Vector& a, const Vector& b, const Vector& c);
/// Vector area of a piece, out of the wet part.
Vector vector_area(int dimension, const CutCell& cell, const FacetPiece& piece);

/// Appends a plane convex polygon as wet triangles of a face.
/// @param normal unit, out of the cell; corners are counter-clockwise about it
void append_wet(int face, const Vector& normal, const std::vector<Vector>& polygon,
                std::vector<SideSimplex>& wet);

/// Calls visit(corners, sign) for planar simplices that bound the cell's wet part; times the sign they are
/// oriented outward.
template <class Visit>
void visit_boundary(int dimension, const CutCell& cell, const Visit& visit) {
  for (const SideSimplex& w : cell.wet) visit(w.corner, w.sign);
  for (const FacetPiece& p : cell.pieces) {
    if (p.handed_over) continue;
    const Vector* x = &cell.points[p.first];
    if (dimension == 2)
      visit(std::array{x[0], x[1], x[1]}, -p.scale);
    else
      for (int k = 1; k + 1 < p.count; ++k) visit(std::array{x[0], x[k], x[k + 1]}, -p.scale);
  }
}

}  // namespace seam::cutting

namespace seam {

struct CutMesh::Geometry {
  explicit Geometry(const Mesh& mesh)
      : outline(mesh),
        search(outline, mesh.cells()),
        border(outline, mesh.owned_cells(), mesh.communicator()),
        ghosts(mesh) {}

  cutting::Outline outline;
  cutting::CellSearch search;
  cutting::Border border;
  cutting::GhostValues ghosts;
  std::vector<Surface> bodies;
  cutting::Facets facets;
  std::vector<cutting::LatticePoint> vertex;  ///< of the outline
  std::vector<int> coverage;                  ///< [vertex]: 0 in the wet part
  std::vector<cutting::CutCell> cells;        ///< ascending
  std::vector<int> index;                     ///< [cell]: into cells, -1 for others
  /// [index]: several connected parts, or none where there is one; empty when they are not told apart.
  std::vector<std::vector<cutting::CellPart>> parts;
  /// @throws std::logic_error when the cell is not cut
  [[nodiscard]] const cutting::CutCell& at(int cell, int part = all_parts) const;
  [[nodiscard]] const std::vector<cutting::CellPart>& parts_of(int cell) const;
};

}  // namespace seam
