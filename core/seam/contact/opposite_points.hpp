// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "seam/contact/facet_search.hpp"
#include "seam/contact/moving_pair.hpp"
#include "seam/cut/lattice.hpp"
#include "seam/surface/body_surface.hpp"

namespace seam {

/// How far from a point its opposite one may be, m.
struct ContactWindow {
  double reach = 0;  ///< ahead
  double depth = 0;  ///< behind: how far bodies may have overlapped
};

/// Looks from a body's surface along its normals at another surface, or at itself, both as they are now.
class OppositePoints {
 public:
  /// @param other null where the opposite surface is given
  /// @param surface, opposite the two surfaces as they are now
  OppositePoints(const BodySurface& own, const BodySurface* other, Surface surface, Surface opposite,
                 ContactWindow window);

  struct Hit {
    int own_facet, facet;  ///< of the two surfaces
    FacetPair pair;
  };
  /// @param on_facet the facet's own coordinates, [dimension - 1]
  [[nodiscard]] std::optional<Hit> find(int facet, const double* on_facet) const;
  /// The nearest facet that faces a point, seen as far as one likes.
  /// @param depth, reach m, as FacetSearch::find() has them
  [[nodiscard]] std::optional<FacetSearch::Hit> facing(int facet, const double* on_facet, double depth,
                                                       double reach) const;
  /// Facets of the own surface that are no partners of one of its facets; none where the other surface is
  /// another body's.
  [[nodiscard]] FacetSearch::Exclude neighbours(int facet) const;
  [[nodiscard]] const Surface& own_surface() const { return surface_; }
  [[nodiscard]] const Surface& opposite_surface() const { return search_.surface(); }
  /// Takes another facet for the one opposite, infinitely far away: for a point that has none, and whose
  /// place depends on that facet.
  [[nodiscard]] Hit far_hit(int facet, const double* on_facet, int other_facet) const;
  /// Whether a point has no opposite one for the reason that it lies inside of the other body, further than
  /// the window looks back.
  [[nodiscard]] bool has_passed(int facet, const double* on_facet) const;
  /// Outward, of length 1.
  [[nodiscard]] cutting::Vector normal(int facet) const;
  /// m^(d-1), twice that in space.
  [[nodiscard]] double area(int facet) const;

  /// Where a part of a facet begins or ends, in the plane: at a facet of the opposite surface that crosses
  /// it, below a vertex of one, or else at a place that it keeps.
  struct Break {
    double share;     ///< of the facet's length
    int facet = -1;   ///< of the opposite surface
    int vertex = -1;  ///< of that facet, where it does not cross
    [[nodiscard]] bool follows() const { return facet >= 0; }
    [[nodiscard]] bool crosses() const { return facet >= 0 && vertex < 0; }
  };
  struct Stretch {
    Break from, to;
    [[nodiscard]] double length() const { return to.share - from.share; }
  };
  /// In the plane: the parts of a facet, or of one of its parts, between which the facet opposite changes, so
  /// that integrals are exact. In space: all of it.
  [[nodiscard]] std::vector<Stretch> stretches(int facet, double from = 0, double to = 1) const;
  /// In the plane: an end of a wet or a closed part of a facet, with the facet opposite that makes it.
  [[nodiscard]] Break end_at(int facet, double share) const;
  /// In the plane: where an end of a stretch is as the facets of a pair move; an end that follows another
  /// facet than the pair's keeps its place.
  [[nodiscard]] Moves<2, 2> place_of(const Break& end, const Hit& hit, const MovingPair<2>& pair) const;
  /// The pair of a hit as its facets move: the point keeps its part of the stretch.
  template <int dim>
  [[nodiscard]] MovingPair<dim> moving(const Hit& hit, const Stretch& stretch) const;

 private:
  [[nodiscard]] std::array<cutting::Vector, 3> own_vertices(int facet) const;
  [[nodiscard]] bool is_own_neighbourhood(int facet, int other_facet) const;
  const BodySurface* own_;
  bool is_itself_;
  Surface surface_;  ///< own
  FacetSearch search_;
  ContactWindow window_;
};

}  // namespace seam
