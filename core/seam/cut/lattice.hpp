// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace seam::cutting {

/// Position, m; the last coordinate is 0 in the plane.
using Vector = std::array<double, 3>;

inline Vector operator+(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector operator*(double s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A triangle's corners turned round so that its longest side is opposite the first: the sides from there
/// tell the normal best, as two long sides of a needle are parallel but for rounding.
inline std::array<Vector, 3> longest_opposite(const Vector& a, const Vector& b, const Vector& c) {
  const double ab = dot(b - a, b - a), bc = dot(c - b, c - b), ca = dot(a - c, a - c);
  if (bc >= ab && bc >= ca) return {a, b, c};
  return ca >= ab ? std::array{b, c, a} : std::array{c, a, b};
}

/// A position rounded to the lattice, in units of its spacing; below 2^51 in magnitude. Rounded coordinates
/// are even, so that the middle between two of them is on the lattice as well.
struct LatticePoint {
  std::array<std::int64_t, 3> x{};
  friend auto operator<=>(const LatticePoint&, const LatticePoint&) = default;
};

/// The lattice on which everything between inside and outside is decided: about 2^49 points across all that
/// takes part, so that orientations of rounded positions are exact in 128-bit integers. A position is rounded
/// the same way wherever it occurs, hence neighbouring cells and facets never disagree.
class Lattice {
 public:
  Lattice() = default;
  /// Covers the box between two corners; its spacing is a power of two.
  Lattice(const Vector& low, const Vector& high);
  [[nodiscard]] LatticePoint round(const Vector& position) const;
  [[nodiscard]] Vector position(const LatticePoint& point) const;
  [[nodiscard]] double spacing() const { return spacing_; }
  friend bool operator==(const Lattice&, const Lattice&) = default;

 private:
  Vector origin_{};
  double spacing_ = 1;
};

// Signs of orientations between points of the mesh (a, b, c) and of a body (p, q, r). The bodies are thought
// of as translated by (e, e^2, e^3) with an infinitesimal e: then no vertex of one lies on a line or plane of
// the other and no edges meet, and all signs belong to one true configuration. They are never zero unless a
// segment or triangle is itself degenerate (or the edges of edge_side_of_edge are parallel, which then do not
// meet).

/// In the plane: p to the left (+1) or right (-1) of the mesh's edge ab.
int side_of_mesh_edge(const LatticePoint& a, const LatticePoint& b, const LatticePoint& p);
/// In the plane: a to the left (+1) or right (-1) of the body's segment pq.
int side_of_facet(const LatticePoint& p, const LatticePoint& q, const LatticePoint& a);
/// In space: p above (+1) or below (-1) the mesh's triangle abc, counter-clockwise seen from above.
int side_of_mesh_face(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                      const LatticePoint& p);
/// In space: a above (+1) or below (-1) the body's triangle pqr.
int side_of_facet(const LatticePoint& p, const LatticePoint& q, const LatticePoint& r, const LatticePoint& a);
/// In space: sign of the volume of the tetrahedron abpq with the mesh's edge ab and the body's edge pq.
int side_of_edges(const LatticePoint& a, const LatticePoint& b, const LatticePoint& p, const LatticePoint& q);

/// In space: whether three points lie on a line.
bool collinear(const LatticePoint& p, const LatticePoint& q, const LatticePoint& r);

// Sizes on the lattice, rounded: for what is too small, or too close, for the positions to tell.

/// Twice the area of abc, negative when clockwise.
double size(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c);
/// Six times the volume of abcd.
double size(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d);

// Without any translation: zero when the points are collinear or coplanar.
int orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c);
int orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d);

}  // namespace seam::cutting
