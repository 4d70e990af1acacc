// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "seam/base/communicator.hpp"
#include "seam/cut/cell_search.hpp"
#include "seam/cut/facets.hpp"
#include "seam/cut/outline.hpp"

namespace seam::cutting {

/// The border of a mesh, on every rank all of it, and the facets of bodies that are flush with it.
///
/// A facet is flush when all of it lies within `flush_reach` of a side's plane, on whichever side of it, and
/// in front of or behind that side. It is laid onto the border: there and nowhere else it is decided what a
/// body touches there. The body of one kind of flush facets lies behind the border: its side is an interface
/// like any other, in the cells on the wet side. The body of the other kind lies in front of it, in the mesh:
/// it leaves nothing wet between itself and the border.
class Border {
 public:
  /// Of a cell's size.
  static constexpr double flush_reach = 1e-9;

  struct Side {
    std::array<Vector, 3> corner{};
    Vector normal{};  ///< unit, out of the mesh
    double size = 0;  ///< of its cell, m
    friend auto operator<=>(const Side&, const Side&) = default;
  };

  /// Collective. @param owned cells: the first ones
  Border(const Outline& outline, int owned, const Communicator& communicator);

  /// Lays the flush facets from `first_facet` on, which are those of one body, onto the border. Their
  /// positions lie in it afterwards; their points are by some steps of the lattice in the mesh where the body
  /// lies behind the border, and as far out of it where the body lies in front.
  /// @return [vertex of facets]: unit normal out of the mesh of those laid onto it, zero for others; empty
  /// when no facet is flush
  std::vector<Vector> lay_flush(Facets& facets, int first_facet) const;

  [[nodiscard]] const std::vector<Side>& sides() const { return sides_; }

  /// What is legal beside the border and surely meant otherwise, of bodies behind it.
  struct Doubts {
    struct Gap {
      Vector at{};
      double width = 0;  ///< the largest, in cells
    };
    /// Facets that end short of the border, by more than what is flush and by less than a hundredth of a
    /// cell: the border there is a border.
    std::optional<Gap> short_of_it;
    /// A corner of a side that flush facets cover in part: what they leave of it is a border.
    std::optional<Vector> covered_partly;
    /// [side]: share that flush facets cover.
    std::vector<double> covered;
  };
  /// The same on all ranks, as they have all facets and all sides.
  [[nodiscard]] Doubts doubts(const Facets& facets) const;

 private:
  struct Plane;
  [[nodiscard]] bool is_flush(const Facets& facets, const Facet& facet, const Side& side) const;

  std::vector<Side> sides_;
  CellSearch search_;
};

}  // namespace seam::cutting
