// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/cut/lattice.hpp"
#include "seam/mesh/mesh.hpp"

namespace seam::cutting {

/// The map between a cell's reference coordinates and space, in both directions. Written out for affine
/// cells.
class CellMap {
 public:
  CellMap(const Mesh& mesh, int cell);

  [[nodiscard]] bool affine() const { return affine_; }
  /// The affine map with the same position and derivatives in the middle of the cell; this one if it is
  /// affine.
  [[nodiscard]] CellMap linearised() const;
  /// Volume of an affine cell's unit square or cube of reference coordinates.
  [[nodiscard]] double determinant() const { return determinant_; }
  [[nodiscard]] Vector to_space(const Vector& reference) const;
  /// Newton's method where the cell is not affine.
  /// @throws Error when it does not converge, naming the cell
  [[nodiscard]] Vector to_reference(const Vector& position) const;
  /// Of an affine cell, for differences of positions.
  [[nodiscard]] Vector difference_to_reference(const Vector& difference) const;

 private:
  void find_affine_map();
  [[nodiscard]] Vector newton(const Vector& position, Vector guess) const;

  const Mesh* mesh_;
  int cell_;
  bool affine_ = false;
  Vector origin_{};
  std::array<Vector, 3> column_{};   ///< derivatives of the position
  std::array<Vector, 3> inverse_{};  ///< rows
  double determinant_ = 0;
};

/// Rows of the inverse of the matrix with the given columns, and its determinant. In the plane the third
/// column is the unit vector.
double invert(const std::array<Vector, 3>& columns, std::array<Vector, 3>& rows);

}  // namespace seam::cutting
