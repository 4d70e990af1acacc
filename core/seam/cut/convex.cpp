// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/convex.hpp"

#include <algorithm>
#include <cmath>

namespace seam::cutting {
namespace {

/// Where an edge passes through a plane; the same whichever way round the edge comes.
Vector passage(Vector a, Vector b, double height_a, double height_b) {
  if (b < a) {
    std::swap(a, b);
    std::swap(height_a, height_b);
  }
  return a + height_a / (height_a - height_b) * (b - a);
}

/// The face that closes a split polyhedron: its corners in order around the normal.
Polygon cap(std::vector<Vector> points, const Vector& normal) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return {};
  Vector middle{};
  for (const Vector& p : points) middle = middle + 1.0 / static_cast<double>(points.size()) * p;
  int least = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(normal[i]) < std::abs(normal[least])) least = i;
  Vector axis{};
  axis[least] = 1;
  const Vector s = cross(axis, normal), t = cross(normal, s);
  const auto angle = [&](const Vector& p) { return std::atan2(dot(p - middle, t), dot(p - middle, s)); };
  std::sort(points.begin(), points.end(),
            [&](const Vector& a, const Vector& b) { return angle(a) < angle(b); });
  return points;
}

}  // namespace

Vector vector_area(const Polygon& polygon) {
  Vector sum{};
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    sum = sum + 0.5 * cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
  return sum;
}

Polygon turned_to(const Vector& normal, Polygon polygon) {
  if (dot(vector_area(polygon), normal) < 0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

void split(const Polygon& polygon, const Plane& plane, Polygon& front, Polygon& back) {
  front.clear();
  back.clear();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double height_a = plane.height(a), height_b = plane.height(b);
    (height_a > 0 ? front : back).push_back(a);
    if ((height_a > 0) == (height_b > 0)) continue;
    const Vector x = passage(a, b, height_a, height_b);
    front.push_back(x);
    back.push_back(x);
  }
  if (front.size() < 3) front.clear();
  if (back.size() < 3) back.clear();
}

void split(const Convex& body, const Plane& plane, int origin, Convex& front, Convex& back) {
  front.faces.clear();
  back.faces.clear();
  std::vector<Vector> rim;
  Polygon above, below;
  for (const Convex::Face& face : body.faces) {
    split(face.corner, plane, above, below);
    for (std::size_t k = 0; k < face.corner.size(); ++k) {
      const Vector &a = face.corner[k], &b = face.corner[(k + 1) % face.corner.size()];
      const double height_a = plane.height(a), height_b = plane.height(b);
      if ((height_a > 0) != (height_b > 0)) rim.push_back(passage(a, b, height_a, height_b));
    }
    if (!above.empty()) front.faces.push_back({above, face.origin});
    if (!below.empty()) back.faces.push_back({below, face.origin});
  }
  const Polygon closing = cap(rim, plane.normal);
  if (closing.empty()) return;
  if (!back.faces.empty()) back.faces.push_back({closing, origin});
  if (!front.faces.empty()) front.faces.push_back({{closing.rbegin(), closing.rend()}, origin});
}

Polygon common_part(const Polygon& polygon, const Polygon& other, const Vector& normal, double shortest) {
  Polygon part = polygon, front, back;
  for (std::size_t k = 0; k < other.size() && !part.empty(); ++k) {
    const Vector &a = other[k], &b = other[(k + 1) % other.size()];
    if (dot(b - a, b - a) <= shortest * shortest) continue;
    const Vector out = cross(b - a, normal);
    split(part, {out, dot(out, a)}, front, back);
    part = back;
  }
  return part;
}

double volume(const Convex& body) {
  if (body.faces.empty()) return 0;
  const Vector apex = body.faces[0].corner[0];
  double sum = 0;
  for (const Convex::Face& face : body.faces) sum += dot(vector_area(face.corner), face.corner[0] - apex) / 3;
  return sum;
}

Vector centre(const Convex& body) {
  Vector sum{};
  double count = 0;
  for (const Convex::Face& face : body.faces)
    for (const Vector& x : face.corner) {
      sum = sum + x;
      ++count;
    }
  return 1 / count * sum;
}

}  // namespace seam::cutting
