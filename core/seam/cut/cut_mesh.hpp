// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "seam/cut/wet_parts.hpp"
#include "seam/mesh/mesh.hpp"
#include "seam/surface/surface.hpp"

namespace seam {

struct InterfaceMotion;

/// Where a background cell lies: wholly outside all bodies, wholly inside them, or partly.
enum class CellState : char { wet, body, cut };

/// Points and weights on a part of a cell. Weights are physical measures: they add up to the part's volume,
/// or to its area. Those of a volume or of a face may be negative and their points may lie inside a body:
/// they are the Gauss points of the unit square or cube of reference coordinates (of the face, for a face),
/// on triangles and tetrahedra as well, whose half or five sixths of them then lie outside of the cell.
struct CutRule {
  std::vector<double> reference;  ///< [point][dimension], in the background cell
  std::vector<double> weight;     ///< [point], m^d or m^(d-1)
  [[nodiscard]] int count() const { return static_cast<int>(weight.size()); }
};

/// Points on the interface in one cell, split at facet and at cell borders.
struct InterfaceRule : CutRule {
  std::vector<double> position;         ///< [point][dimension], m
  std::vector<double> normal;           ///< [point][dimension], out of the wet part: into the body
  std::vector<int> body, facet;         ///< [point]
  std::vector<double> facet_reference;  ///< [point][dimension - 1], the facet's own coordinates: vertex 0 is
                                        ///< the origin, vertices 1 and 2 the unit points
  /// In the plane: where on the facet the point's piece, or the part of it that has its own rule, begins and
  /// ends, [point][2].
  std::vector<double> span;
};

/// Where between two places on a facet of a body what is integrated there has kinks: ascending, in the
/// facet's own coordinate.
using PieceBreaks = std::function<std::vector<double>(int body, int facet, double from, double to)>;

/// The boundary of the wet part of a cell. In the plane: its outlines, counter-clockwise, holes clockwise.
/// In space: the faces of its polyhedron, counter-clockwise seen from outside.
struct WetShape {
  std::vector<double> points;  ///< [point][dimension], m; polygons behind each other
  std::vector<int> first;      ///< [polygon + 1]: its first point
  [[nodiscard]] int count() const { return static_cast<int>(first.size()) - 1; }
};

/// The wet part of a mesh from which bodies are cut out. The wet part lies outside all bodies; the interface
/// is exactly its boundary. For every cut cell, to rounding: wet part + body part = cell; the areas of the
/// interface and of the wet parts of the cell's faces add up to zero as vectors; polynomials up to the
/// degree asked for are integrated exactly.
class CutMesh {
 public:
  explicit CutMesh(const Mesh& mesh);
  ~CutMesh();

  /// Cuts the owned and ghost cells. Collective. Every rank passes the same bodies.
  /// @throws Error when a surface is degenerate: no facet, a vertex that does not exist, or one that is not
  /// finite, or an outline that should be closed and is not, naming body and facet
  void cut(std::span<const Surface> bodies);

  /// All wet parts of a cell together.
  static constexpr int all_parts = -1;
  /// Tells the connected wet parts within each cell apart, until the next cut() or drop(). A part
  /// that no neighbour's wet part touches stays with the largest one of its cell, and in space all that is
  /// wet of a cell that is not affine is one part. Collective.
  void separate_parts();
  /// Number of wet parts of a cell: 1 unless they are told apart, also in a body.
  [[nodiscard]] int parts(int cell) const;
  /// Middle of a wet part of a cell, m.
  [[nodiscard]] std::array<double, 3> part_centre(int cell, int part) const;
  /// Middle of a whole cell, m.
  [[nodiscard]] std::array<double, 3> cell_centre(int cell) const;
  /// Whether a point of a cell lies in a wet part.
  [[nodiscard]] bool holds(int cell, int part, const std::array<double, 3>& position) const;
  /// The part that holds a point of a cell; the nearest one for a point of a body.
  [[nodiscard]] int part_at(int cell, const std::array<double, 3>& position) const;
  /// Parts (of the cell, of its neighbour behind a face) whose wet part is in touch across the face.
  [[nodiscard]] std::vector<std::pair<int, int>> joined(int cell, int face) const;
  /// The local cell behind a face, -1 where there is none.
  [[nodiscard]] int neighbour(int cell, int face) const;

  /// Something of the last cut that is legal and surely meant otherwise.
  struct Doubt {
    std::string kind;     ///< the same for all that are alike
    std::string message;  ///< what, where, and what to do
  };
  /// Of bodies beside the mesh's border; the same on all ranks.
  [[nodiscard]] std::vector<Doubt> doubts() const;
  /// Faces of owned cells on the mesh's border that a body behind it covers, wholly or in part: what is there
  /// is an interface.
  [[nodiscard]] std::vector<CellFace> covered_faces() const;

  [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
  /// Of a local cell.
  [[nodiscard]] CellState state(int cell) const { return state_[cell]; }
  /// Local cells that are cut, ascending.
  [[nodiscard]] const std::vector<int>& cut_cells() const { return cut_cells_; }
  /// Volume of the wet part and of a whole cell, and area of the interface in it. The cell must be cut.
  [[nodiscard]] double wet_volume(int cell, int part = all_parts) const;
  [[nodiscard]] double cell_volume(int cell) const;
  [[nodiscard]] double interface_area(int cell, int part = all_parts) const;

  /// Rule for the wet part of a cut cell, empty for one inside a body; exact for monomials with each
  /// exponent up to `degree` in the coordinates of an affine cell.
  /// @param part of those that separate_parts() told apart
  void volume_rule(int cell, int degree, CutRule& rule, int part = all_parts) const;
  /// Rule for the interface in a cut cell, exact for polynomials of total degree `degree` on each piece.
  /// @param motion where not null: how the rule changes as facets move
  /// @param breaks in the plane: where to divide pieces
  void interface_rule(int cell, int degree, InterfaceRule& rule, InterfaceMotion* motion = nullptr,
                      int part = all_parts, const PieceBreaks& breaks = {}) const;
  /// Rule for the wet part of one face of a cut cell; empty where the face is dry, or the cell is a
  /// body's.
  void face_rule(int cell, int face, int degree, CutRule& rule, int part = all_parts) const;

  /// For pictures. The cell must be cut.
  void wet_shape(int cell, WetShape& shape, int part = all_parts) const;
  /// For pictures: triangles or tetrahedra of which the wet part of a cut cell consists, positively
  /// oriented. In the plane they are as fine as the outline and share its points with neighbours.
  /// @param corners [simplex][dimension + 1][dimension], m
  void wet_simplices(int cell, std::vector<double>& corners, int part = all_parts) const;

  /// Collective.
  [[nodiscard]] WetParts find_parts() const;
  /// Turns local cells into body, as those of parts that are too small. Collective; ghosts must be listed on
  /// every rank, and the cells should make up whole parts: then no interface is left over. Holds until the
  /// next cut().
  /// @return the wet volume dropped on all ranks, m^d
  double drop(const std::vector<int>& cells);

 private:
  [[nodiscard]] bool is_wet(int cell, int face) const;
  [[nodiscard]] bool are_joined(int cell, int part, int face, int other, int other_part,
                                int other_face) const;
  void number_cut_cells();
  void adopt_ghost_states();

  struct Geometry;
  const Mesh* mesh_;
  std::vector<CellState> state_;
  std::vector<int> cut_cells_;
  std::unique_ptr<Geometry> geometry_;
};

}  // namespace seam
