// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "seam/cut/geometry.hpp"
#include "seam/surface/moving_facet.hpp"

namespace seam::cutting {

/// One piece of a facet in a cell as it follows the facet's vertices. Its corners are of three sorts:
/// vertices of the facet go with it, points on the facet's border stay on it, and points on the cell's
/// border, which is fixed, slide along both.
template <int dim>
class MovingPiece {
 public:
  using Number = Moves<dim, 1>;
  MovingPiece(const Outline& outline, const CutCell& cell, const FacetPiece& piece, const Surface& surface);

  /// A point of the simplex of some of the corners; without its span.
  /// @param share of the corners in it
  [[nodiscard]] MovingPoint<dim, 1> point(const std::array<int, dim>& corners,
                                          const std::array<double, dim>& share) const;
  /// In the plane: the place on the facet of a point that keeps its share of the piece.
  [[nodiscard]] Number on_facet(double share) const;

 private:
  using Plain = Vec<dim, double>;
  /// The line or plane on which a corner stays.
  struct Border {
    Plain normal{};
    int side = -1;  ///< of Outline; -1 for the facet's own border, which moves along
    [[nodiscard]] bool at_rest() const { return side >= 0; }
  };
  struct Corner {
    Plain position;
    Vec<dim - 1, Number> on_facet;
  };
  void find_frame(const Surface& surface, int facet);
  void find_slides();
  [[nodiscard]] Border border(const Plain& a, const Plain& b) const;
  [[nodiscard]] Plain along_facet(const Plain& vector) const;
  void keep_on(const Border& border, const Plain& direction, Corner& corner) const;
  void slide(const Border& before, const Border& after, Corner& corner) const;
  void slide_along_edge(int first, int second, Corner& corner) const;

  const Outline* outline_;
  int cell_;
  double size_ = 0;  ///< of the facet, m
  Corners<dim, Number> facet_;
  Corners<dim, double> vertex_;      ///< of the facet, now
  Vec<dim, Number> into_body_;       ///< unit normal
  Plain normal_{};                   ///< the same, now
  std::array<Plain, dim> gradient_;  ///< of the shares of the facet's vertices, along it
  std::vector<Corner> corner_;
  std::vector<Vec<dim, Number>> position_;  ///< [corner]
};

}  // namespace seam::cutting
