// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "seam/assembly/element.hpp"

namespace seam {

/// The owned cells of a field, or those of them that are active. All share one quadrature.
class CellDomain final : public IntegrationDomain {
 public:
  CellDomain(Field& field, int degree);
  [[nodiscard]] int size() const override { return static_cast<int>(cells_.size()); }
  [[nodiscard]] std::vector<Field*> fields() const override { return {field_}; }
  void fill(int index, Element& element) const override;
  [[nodiscard]] const int* nodes(int index, int side, int block) const override;
  [[nodiscard]] std::string description() const override;
  void restrict_to(const Field& field, const std::vector<char>& active) override;

 private:
  Field* field_;
  std::vector<int> cells_;  ///< owned and active
  const Quadrature* rule_;
  ShapeTable tables_[2];
};

/// Shape tables at a quadrature rule on every face of a cell type.
class FaceTables {
 public:
  FaceTables(const Field& field, int degree, bool with_hessian);
  [[nodiscard]] const Quadrature& rule() const { return *rule_; }
  void attach(ElementSide& side) const;

 private:
  const Quadrature* rule_;
  std::vector<ShapeTable> tables_[2];
};

/// Faces of a field's cells that carry a name; this rank evaluates those of its owned cells.
class BoundaryDomain final : public IntegrationDomain {
 public:
  BoundaryDomain(Field& field, const std::string& boundary, int degree);

  [[nodiscard]] int size() const override { return static_cast<int>(faces_.size()); }
  [[nodiscard]] std::vector<Field*> fields() const override { return {field_}; }
  void fill(int index, Element& element) const override;
  [[nodiscard]] const int* nodes(int index, int side, int block) const override;
  [[nodiscard]] std::string description() const override;
  void restrict_to(const Field& field, const std::vector<char>& active) override;

 private:
  Field* field_;
  std::string boundary_;
  std::vector<CellFace> all_faces_, faces_;
  FaceTables tables_;
};

/// Faces between two cells of a field: side 0 is the cell with the lower global number.
class InteriorFaceDomain final : public IntegrationDomain {
 public:
  InteriorFaceDomain(Field& field, int degree);
  [[nodiscard]] int size() const override { return static_cast<int>(faces_.size()); }
  [[nodiscard]] std::vector<Field*> fields() const override { return {field_, field_}; }
  void fill(int index, Element& element) const override;
  [[nodiscard]] const int* nodes(int index, int side, int block) const override;
  [[nodiscard]] std::string description() const override;
  void restrict_to(const Field& field, const std::vector<char>& active) override;

 private:
  Field* field_;
  std::vector<Mesh::InteriorFace> faces_;
  FaceTables tables_;
  mutable ShapeTable partner_[2];
};

/// Points `side` at a local cell of its field.
void attach_cell(ElementSide& side, const Field& field, int cell);

/// Reference coordinates in a cell of points given in space, by Newton's method.
/// @param guess start value and result, [dimension]
/// @throws Error when it does not converge, naming the cell
void invert_map(const ElementSide& side, const double* position, double* guess);

}  // namespace seam
