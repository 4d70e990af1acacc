// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "seam/cut/joined.hpp"
#include "seam/cut/lattice.hpp"
#include "seam/cut/outline.hpp"
#include "seam/surface/surface.hpp"

namespace seam::cutting {

/// A segment or triangle of the surfaces that cut.
struct Facet {
  std::array<int, 3> vertex{};  ///< of Facets
  int body = 0, facet = 0;      ///< where it comes from: a solid, and a facet of that
  Vector normal{};              ///< unit, into the body
};

/// The boundaries of all bodies on the lattice, bodies behind each other in order. A body here is a solid
/// with all of its surface, whose parts may be surfaces of their own for all others.
struct Facets {
  int dimension = 2;
  Lattice lattice;
  std::vector<LatticePoint> point;  ///< [vertex]
  std::vector<Vector> position;     ///< [vertex], m
  std::vector<Facet> list;          ///< without those that have no extent on the lattice
  /// Value of a body's winding number far away: 1 for a closed surface turned inside out, whose body is what
  /// lies outside of it.
  std::vector<int> far;
  std::vector<bool> closed;  ///< [body]
  bool all_covered = false;  ///< without any facet: whether a body is everywhere, or nowhere
  /// [body][facet]: the surface, and its facet, of which that is.
  std::vector<std::vector<std::array<int, 2>>> origin;
};

class Border;

/// Checks the surfaces, joins those of one solid, puts them on a lattice that covers them and the mesh, and
/// lays what is flush with the mesh's border onto it. The rim of an open surface is prolonged a little, so
/// that it also ends outside of the mesh when it was meant to end on its boundary.
/// @throws Error as CutMesh::cut does
Facets collect_facets(const Outline& outline, const Border& border, std::span<const Surface> bodies);

/// A point beside another one, beyond all facets.
LatticePoint far_from(LatticePoint point);

/// +1 when a step from mesh vertex a to b passes the facet from front to back, that is into the body, -1 the
/// other way, 0 when it misses.
int crossing(const Facets& facets, const Facet& facet, const LatticePoint& a, const LatticePoint& b);

/// Winding number of a body about a vertex of the mesh: positive inside. Visits all facets.
int winding(const Facets& facets, int body, const LatticePoint& vertex);
/// 1 where a vertex of the mesh is covered by a body, 0 in the wet part, when no facet lies in another body.
/// Visits all facets.
int coverage_at(const Facets& facets, const LatticePoint& vertex);

}  // namespace seam::cutting
