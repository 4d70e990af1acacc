// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "seam/cut/geometry.hpp"
#include "seam/cut/interface_motion.hpp"

namespace seam::cutting {

/// How one piece of a facet in a cell follows the facet's vertices. Its corners are of three sorts: vertices
/// of the facet go with it, points on the facet's border stay on it, and points on the cell's border, which
/// is fixed, slide along both.
class PieceMotion {
 public:
  PieceMotion(const Outline& outline, const CutCell& cell, const FacetPiece& piece, const Surface& surface);

  /// Appends the derivatives of a point of the simplex of corners 0, a, b.
  /// @param share of the three corners in the point
  void append(const std::array<int, 3>& corners, const std::array<double, 3>& share,
              InterfaceMotion& motion) const;
  /// In the plane: appends the derivatives of the place on the facet of a point that keeps its share of the
  /// piece.
  void append_share(double share, std::vector<double>& values) const;

 private:
  using Matrix = std::array<Vector, 3>;  ///< rows
  void find_frame(const Surface& surface, int facet);
  [[nodiscard]] std::array<double, 3> barycentric(const Vector& x) const;
  struct Constraint {
    Vector normal{};  ///< of the line or plane on which a corner stays
    int side = -1;    ///< of Outline; -1 for the facet's own border
    [[nodiscard]] bool at_rest() const { return side >= 0; }
  };
  [[nodiscard]] Constraint constraint(const Vector& a, const Vector& b) const;
  [[nodiscard]] Matrix slide(const Constraint& before, const Constraint& after) const;
  [[nodiscard]] Matrix slide_along_edge(int first, int second) const;
  void find_slides(const Vector* corner);

  int dim_;
  const Outline* outline_;
  int cell_;
  Vector normal_{};
  double size_ = 0;                   ///< of the facet, m
  std::array<Vector, 3> vertex_{};    ///< of the facet
  std::array<Vector, 3> gradient_{};  ///< of its barycentric coordinates along the facet
  std::vector<Vector> corner_;
  std::vector<Matrix> slide_;  ///< [corner]: motion relative to the facet = slide * motion of the facet there
};

}  // namespace seam::cutting
