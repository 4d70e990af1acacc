// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/wet_leaves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seam::cutting {
namespace {

/// Of the volume of a cell or the area of a polygon: less than that is rounding.
constexpr double negligible = 1e-14;

/// The cell as convex polyhedra: itself, or the tetrahedra that its sides form with its centre.
std::vector<Convex> convex_parts(const Outline& outline, int cell, bool is_convex) {
  Convex whole;
  for (int s = outline.first_side[cell]; s < outline.first_side[cell + 1]; ++s) {
    const auto& v = outline.sides[s].vertex;
    whole.faces.push_back({{outline.position[v[0]], outline.position[v[1]], outline.position[v[2]]}, s});
  }
  if (is_convex) return {whole};
  std::vector<Convex> parts;
  const Vector apex = outline.centre(cell);
  for (const Convex::Face& base : whole.faces) {
    Convex& part = parts.emplace_back(Convex{{base}});
    for (int k = 0; k < 3; ++k)
      part.faces.push_back({{base.corner[(k + 1) % 3], base.corner[k], apex}, base.origin});
  }
  return parts;
}

/// Whether a polygon reaches into a polyhedron.
bool reaches(Polygon polygon, const Convex& part) {
  const Vector whole = vector_area(polygon);
  Polygon front, back;
  for (const Convex::Face& face : part.faces) {
    const Vector out = vector_area(face.corner);
    split(polygon, {out, dot(out, face.corner[0])}, front, back);
    polygon = back;
  }
  const Vector inside = vector_area(polygon);
  return dot(inside, inside) > negligible * negligible * dot(whole, whole);
}

/// Solid angle of a triangle seen from x, positive from behind (Van Oosterom and Strackee 1983).
double solid_angle(const std::array<Vector, 3>& corner, const Vector& x) {
  const Vector a = corner[0] - x, b = corner[1] - x, c = corner[2] - x;
  // From near by, rounding would see a half space behind a needle.
  const Vector ab = b - a, bc = c - b, ca = a - c, twice_area = cross(ab, bc);
  const double longest = std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)});
  if (dot(twice_area, twice_area) <= negligible * negligible * longest * longest) return 0;
  const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
  return 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

/// Divides the cell along the planes of the interface until each part lies wholly in the wet part or not.
void split_along_interface(const CutCell& cell, std::vector<Convex>& parts) {
  for (std::size_t k = 0; k < cell.pieces.size(); ++k) {
    const FacetPiece& p = cell.pieces[k];
    if (p.handed_over) continue;
    const Polygon polygon(cell.points.begin() + p.first, cell.points.begin() + p.first + p.count);
    const Plane plane{p.normal, dot(p.normal, polygon[0])};
    std::vector<Convex> divided;
    for (Convex& part : parts) {
      Convex front, back;
      if (reaches(polygon, part)) split(part, plane, piece_origin(static_cast<int>(k)), front, back);
      if (front.faces.empty() || back.faces.empty() || volume(front) < negligible * cell.volume ||
          volume(back) < negligible * cell.volume) {
        divided.push_back(std::move(part));
        continue;
      }
      divided.push_back(std::move(front));
      divided.push_back(std::move(back));
    }
    parts = std::move(divided);
  }
}

}  // namespace

bool is_wet_at(const CutCell& cell, const Vector& x) {
  double sum = 0;
  visit_boundary(3, cell, [&](const std::array<Vector, 3>& corner, double sign) {
    sum += (sign > 0 ? 1 : -1) * solid_angle(corner, x);
  });
  return sum > 2 * std::numbers::pi;
}

std::vector<Convex> wet_leaves(const Outline& outline, const CutCell& cell, bool is_convex) {
  std::vector<Convex> parts = convex_parts(outline, cell.cell, is_convex);
  split_along_interface(cell, parts);
  std::erase_if(parts, [&](const Convex& part) { return !is_wet_at(cell, centre(part)); });
  return parts;
}

}  // namespace seam::cutting
