// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/cut/lattice.hpp"

namespace seam::cutting {

using Polygon = std::vector<Vector>;

/// Points x with normal . x = offset; in front where it is larger.
struct Plane {
  Vector normal{};
  double offset = 0;
  [[nodiscard]] double height(const Vector& x) const { return dot(normal, x) - offset; }
};

/// A convex polyhedron by its faces, counter-clockwise seen from outside.
struct Convex {
  struct Face {
    Polygon corner;
    int origin;  ///< who made it, for the caller
  };
  std::vector<Face> faces;
};

/// Vector area of a plane polygon.
Vector vector_area(const Polygon& polygon);
/// Its corners counter-clockwise about a normal.
Polygon turned_to(const Vector& normal, Polygon polygon);
/// Splits a convex polygon; either part may be empty.
void split(const Polygon& polygon, const Plane& plane, Polygon& front, Polygon& back);
/// Splits a polyhedron; the new faces get the given origin. Either part may be empty.
void split(const Convex& body, const Plane& plane, int origin, Convex& front, Convex& back);
/// Part of a convex polygon inside another one in the same plane, counter-clockwise about the normal. Edges
/// of the other up to the length `shortest` have no direction but rounding and do not count.
Polygon common_part(const Polygon& polygon, const Polygon& other, const Vector& normal, double shortest);
double volume(const Convex& body);
Vector centre(const Convex& body);

}  // namespace seam::cutting
