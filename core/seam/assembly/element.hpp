// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "seam/mesh/lagrange.hpp"
#include "seam/term/term.hpp"

namespace seam {

class CellConstant;
class Field;

/// One side of an element: a cell, and the reference coordinates of the element's points in it.
struct ElementSide {
  const Field* field = nullptr;
  int global_cell = -1;              ///< number of the cell in the whole mesh, for messages
  int face = -1;                     ///< local face, where the points lie on one
  const double* geometry = nullptr;  ///< [geometry node][dimension]
  double diameter = 0;
  /// Local nodes of the cell in each block of the field.
  std::vector<const int*> nodes;
  /// Shape tables at the points, per order (index order - 1); null where no space uses that order.
  const ShapeTable* table[2] = {nullptr, nullptr};
  /// Those that are tabulated for this element alone.
  std::unique_ptr<ShapeTable> own_table[2];
  /// Of blocks that have functions of their own here: by block, without points where it has none.
  std::vector<ShapeTable> own_functions;

  /// The functions of a block at the points. @param order of its space
  [[nodiscard]] const ShapeTable& functions(int block, int order) const {
    const auto b = static_cast<std::size_t>(block);
    return b < own_functions.size() && own_functions[b].points > 0 ? own_functions[b] : *table[order - 1];
  }

  // Filled by map_geometry:
  std::vector<double> position;          ///< [point][dimension]
  std::vector<double> inverse_jacobian;  ///< [point][reference direction][dimension]
  std::vector<double> determinant;       ///< [point]

  /// Evaluates the cell's map at the points of `table[geometry order - 1]`.
  /// @throws Error when the map is not orientation-preserving at a point
  void map_geometry();
};

/// How an element's points move with the nodes of the bodies on its sides: derivatives with respect to the
/// coordinates of the nodes that a point's facets have, one facet of each mover. Move k of a point =
/// (mover * dimension + node) * dimension + component of it, dimension^2 for each mover.
struct PointMotion {
  std::vector<int> node;         ///< [point][mover][dimension]: node of the side's cell in the moving block
  std::vector<double> position;  ///< [point][dimension][move]
  std::vector<double> normal;    ///< [point][dimension][move], 1/m
  std::vector<double> relative_weight;  ///< [point][move], 1/m
  std::vector<double> gap;              ///< [point][move]; empty where the element has no gap
  /// [side]: [point][reference direction][move], through the side's cell, 1/m; empty for a mesh at rest in
  /// space, through which points pass with their position.
  std::array<std::vector<double>, 5> reference;
};

/// What terms are integrated over: a cell, a face, or a piece of an interface, with its quadrature points.
struct Element {
  int dimension = 2;
  int points = 0;
  std::vector<double> weight;      ///< [point], m^d or m^(d-1)
  std::vector<double> normal;      ///< [point][dimension], outward from side 0; empty for cells
  std::vector<double> cell_size;   ///< [point]
  std::vector<double> trace_size;  ///< [point], see Point
  std::vector<double> gap;         ///< [point], see Point; empty where there is none
  /// [constant][point]: those that terms asked the domain to keep.
  std::vector<std::vector<double>> constants;
  std::vector<ElementSide> sides;
  const PointMotion* motion = nullptr;  ///< where the domain has movers

  /// Fills weight and normal of points on a face of side 0's cell. @param weights of the reference face
  void measure_face(const CellTopology& cell, int face, const std::vector<double>& weights);
  /// Sum of the weights.
  [[nodiscard]] double measure() const;
  /// Sets cell_size and trace_size of all points.
  void set_sizes(double cell, double trace);
};

/// A set of elements on which a list of terms is integrated. This rank evaluates each of its elements; all
/// elements of all ranks together make up the domain.
class IntegrationDomain {
 public:
  virtual ~IntegrationDomain() = default;
  /// Number of elements this rank evaluates.
  [[nodiscard]] virtual int size() const = 0;
  /// The field on each side.
  [[nodiscard]] virtual std::vector<Field*> fields() const = 0;
  /// Sets up element `index`; the object is reused from element to element.
  virtual void fill(int index, Element& element) const = 0;
  /// Local nodes of one side's cell in one block, without the cost of fill().
  [[nodiscard]] virtual const int* nodes(int index, int side, int block) const = 0;
  /// The unknowns that displace the points, and the sides they live on; none where they are at rest.
  [[nodiscard]] virtual const std::vector<Operand>& movers() const;
  /// The side whose volume ends at the elements and grows and shrinks as they move, -1 for none.
  [[nodiscard]] virtual int swept_side() const { return -1; }
  /// Lets the points follow the present states of the movers. Collective. @param time end of the step
  /// @return true when there are other elements now, or elements have other cells
  virtual bool follow(double time) {
    (void)time;
    return false;
  }
  /// The field whose cells, all of them, are the elements; null where they are not.
  [[nodiscard]] virtual const Field* whole_field() const { return nullptr; }
  /// Finds the elements anew after this field's active cells, or the bodies that cut them, have changed.
  virtual void update(const Field& field) { (void)field; }
  /// Keeps a number per cell of a side, in one region of its field, for a term.
  /// @return index into Element::constants
  virtual int add_constant(int side, std::shared_ptr<const CellConstant> constant, int region);
  /// Those that follow the deformation are computed anew: at the start of a step, or in each iteration.
  virtual void forget_constants(bool new_step) { (void)new_step; }
  /// For messages: "cells of field 'water'".
  [[nodiscard]] virtual std::string description() const = 0;
};

}  // namespace seam
