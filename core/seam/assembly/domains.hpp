// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "seam/assembly/element.hpp"
#include "seam/field/field.hpp"
#include "seam/physics/physics.hpp"

namespace seam {

struct Quadrature;

/// The quadrature points of one part of a cut cell, or of its boundary.
struct CutPoints {
  int cell = -1;
  int part = 0;                   ///< of the cell, where it has several (Field::parts)
  int face = -1;                  ///< local face, for parts of the boundary
  std::vector<double> weight;     ///< [point], physical
  std::vector<double> reference;  ///< [point][dimension]
  /// Tabulates the shape functions of the side's field there: kept for all cut cells they would take more
  /// memory than everything else.
  void attach(ElementSide& side, bool with_hessian) const;
};

/// The owned active cells of a field: whole ones share one quadrature, cut ones have their own.
class CellDomain final : public IntegrationDomain {
 public:
  enum class Cells { all, uncut };
  CellDomain(Field& field, int degree, Cells cells = Cells::all);
  [[nodiscard]] int size() const override { return static_cast<int>(whole_.size() + cut_.size()); }
  [[nodiscard]] std::vector<Field*> fields() const override { return {field_}; }
  void fill(int index, Element& element) const override;
  [[nodiscard]] const int* nodes(int index, int side, int block) const override;
  [[nodiscard]] std::string description() const override;
  [[nodiscard]] const Field* whole_field() const override { return cells_ == Cells::all ? field_ : nullptr; }
  void update(const Field& field) override;

 private:
  Field* field_;
  int degree_;
  Cells cells_;
  std::vector<int> whole_;
  std::vector<CutPoints> cut_;  ///< numbered after the whole ones
  const Quadrature* rule_;
  ShapeTable tables_[2];
};

/// Shape tables at a quadrature rule on every face of a cell type.
class FaceTables {
 public:
  FaceTables(const Field& field, int degree, bool with_hessian);
  [[nodiscard]] const Quadrature& rule() const { return *rule_; }
  void attach(ElementSide& side) const;
  /// Tables of the second cell of a face at the points of the first one's, by how the two see the face.
  void attach_partner(ElementSide& side, int orientation) const;
  /// How the second of two cells sees their common face: which of its vertices is the first cell's first, and
  /// whether they follow in reverse.
  /// @param first, second local nodes of the cells, vertices first
  static int orientation(const CellTopology& cell, const int* first, int first_face, const int* second,
                         int second_face);

 private:
  void tabulate_partners(const Field& field, bool with_hessian);
  CellType type_;
  const Quadrature* rule_;
  std::vector<ShapeTable> tables_[2];                 ///< [face]
  std::vector<std::vector<ShapeTable>> partners_[2];  ///< [face][orientation]
};

/// Faces of a field's active cells that carry a name, or all outer ones; this rank evaluates those of its
/// owned cells. Of a cut cell's face only the wet part counts, each part of the cell for itself.
class BoundaryDomain final : public IntegrationDomain {
 public:
  /// @param boundary its name, "" for the whole outer surface of the mesh
  BoundaryDomain(Field& field, const std::string& boundary, int degree);
  /// Takes faces out for good. @param boundaries their names; empty for all faces
  void leave_out(const std::vector<std::string>& boundaries);

  [[nodiscard]] int size() const override { return static_cast<int>(whole_.size() + cut_.size()); }
  [[nodiscard]] std::vector<Field*> fields() const override { return {field_}; }
  void fill(int index, Element& element) const override;
  [[nodiscard]] const int* nodes(int index, int side, int block) const override;
  [[nodiscard]] std::string description() const override;
  void update(const Field& field) override;

 private:
  Field* field_;
  std::string boundary_;
  int degree_;
  std::set<std::pair<int, int>> left_out_;  ///< cell and face
  std::vector<CellFace> whole_;
  std::vector<CutPoints> cut_;  ///< numbered after the whole ones
  FaceTables tables_;
};

/// Whole faces between two active cells of a field: side 0 is the cell with the lower global number. Where
/// parts of cells have unknowns of their own, each pair of parts in touch across the face is an element.
class InteriorFaceDomain final : public IntegrationDomain {
 public:
  enum class Faces {
    all,
    ghost,     ///< at least one of the cells is cut
    wet_ghost  ///< and part of the face lies in the wet part
  };
  InteriorFaceDomain(Field& field, int degree, Faces faces = Faces::all);
  [[nodiscard]] int size() const override { return static_cast<int>(faces_.size()); }
  [[nodiscard]] std::vector<Field*> fields() const override { return {field_, field_}; }
  void fill(int index, Element& element) const override;
  [[nodiscard]] const int* nodes(int index, int side, int block) const override;
  [[nodiscard]] std::string description() const override;
  void update(const Field& field) override;

 private:
  [[nodiscard]] bool belongs(const Mesh::InteriorFace& face, bool belonged) const;
  struct OrientedFace {
    CellFace side[2];
    int part[2];
    int orientation;
  };
  void add(const Mesh::InteriorFace& face);
  Field* field_;
  Faces choice_;
  std::vector<OrientedFace> faces_;
  FaceTables tables_;
};

/// Points `side` at a local cell of its field, or at one of its parts.
void attach_cell(ElementSide& side, const Field& field, int cell, int part = 0);

/// True where some space of the field, or its mesh, has this order.
bool uses_order(const Field& field, int order);

/// Reference coordinates in a cell of points given in space, by Newton's method.
/// @param guess start value and result, [dimension]
/// @throws Error when it does not converge, naming the cell
void invert_map(const ElementSide& side, const double* position, double* guess);

/// Where a place lies in a cell.
struct PlaceInCell {
  std::vector<double> reference;  ///< coordinates, [dimension]
  double outside;                 ///< how far outside of the reference cell they lie; 0 within
};
/// Nothing far outside of a curved cell, where its map has no inverse.
std::optional<PlaceInCell> locate(const ElementSide& side, const double* position);

}  // namespace seam
