// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/facets.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "seam/base/diagnostics.hpp"
#include "seam/cut/border.hpp"

namespace seam::cutting {
namespace {

void check_indices(const Surface& surface, int body, int dimension) {
  if (surface.dimension != dimension)
    throw Error(fmt::format("body {}: its surface has dimension {}, the mesh it cuts {}", body,
                            surface.dimension, dimension));
  if (surface.facets.empty())
    throw Error(
        fmt::format("body {}: its surface has no facet; give at least one, or leave the body out", body));
  for (std::size_t k = 0; k < surface.facets.size(); ++k)
    if (surface.facets[k] < 0 || surface.facets[k] >= surface.point_count())
      throw Error(fmt::format("body {}, facet {}: vertex {} does not exist; the surface has {} vertices",
                              body, k / dimension, surface.facets[k], surface.point_count()));
  for (std::size_t k = 0; k < surface.facets.size(); ++k)
    for (int i = 0; i < dimension; ++i) {
      const double x = surface.points[static_cast<std::size_t>(surface.facets[k]) * dimension + i];
      if (!std::isfinite(x))
        throw Error(
            fmt::format("body {}, facet {}: vertex {} has the coordinate {}; expected a finite number", body,
                        k / dimension, surface.facets[k], x));
    }
}

Vector position_of(const Surface& surface, int vertex) {
  Vector x{};
  for (int i = 0; i < surface.dimension; ++i) {
    const double value = surface.points[vertex * surface.dimension + i];
    if (std::isfinite(value)) x[i] = value;  // otherwise no facet uses the vertex
  }
  return x;
}

/// A unit vector, or zero where the facet has no extent.
Vector normal_into_body(int dimension, const Vector& a, const Vector& b, const Vector& c) {
  const auto [p, q, r] = dimension == 2 ? std::array{a, b, c} : longest_opposite(a, b, c);
  const Vector out = dimension == 2 ? Vector{q[1] - p[1], p[0] - q[0], 0} : cross(q - p, r - p);
  const double length = std::sqrt(dot(out, out));
  return length > 0 ? -1 / length * out : Vector{};
}

/// Rims of a surface: boundaries of facets (points in the plane, edges in space) that do not cancel. Vertices
/// at the same place count as one.
struct Rim {
  std::array<int, 2> vertex;  ///< in the plane twice the same
  int facet;                  ///< index into Facets::list
  int sign;                   ///< -1: where a segment starts
};

class RimFinder {
 public:
  RimFinder(const Facets& facets, int first_facet) : facets_(facets) {
    for (int f = first_facet; f < static_cast<int>(facets.list.size()); ++f) {
      const auto& v = facets.list[f].vertex;
      if (facets.dimension == 2) {
        add({{v[0], v[0]}, f, -1});
        add({{v[1], v[1]}, f, 1});
      } else {
        for (int k = 0; k < 3; ++k) add({{v[k], v[(k + 1) % 3]}, f, 1});
      }
    }
  }
  [[nodiscard]] std::vector<Rim> rims() const {
    std::vector<Rim> result;
    for (const auto& [key, entry] : open_)
      if (entry.first != 0) result.push_back(entry.second);
    return result;
  }

 private:
  void add(Rim rim) {
    LatticePoint a = facets_.point[rim.vertex[0]], b = facets_.point[rim.vertex[1]];
    if (facets_.dimension == 3 && a == b) return;  // no edge any more
    int sign = rim.sign;
    if (b < a) {
      std::swap(a, b);
      sign = -sign;
    }
    auto& entry = open_[{a, b}];
    entry.first += sign;
    // Of those that cancel in pairs the one that remains has the sign of the sum.
    if (entry.first == sign) entry.second = rim;
  }
  const Facets& facets_;
  std::map<std::pair<LatticePoint, LatticePoint>, std::pair<int, Rim>> open_;
};

int append_point(Facets& facets, const Vector& x) {
  facets.position.push_back(x);
  facets.point.push_back(facets.lattice.round(x));
  return static_cast<int>(facets.position.size()) - 1;
}

void find_normals(Facets& facets, int first_facet) {
  for (auto f = facets.list.begin() + first_facet; f != facets.list.end(); ++f)
    f->normal = normal_into_body(facets.dimension, facets.position[f->vertex[0]],
                                 facets.position[f->vertex[1]], facets.position[f->vertex[2]]);
}

void append_facet(Facets& facets, const std::array<int, 3>& v, int body, int facet, const Vector& normal) {
  facets.list.push_back({v, body, facet, normal});
}

/// Directions out of the surface at the vertices of its rim: away from the middles of the facets there,
/// weighted with their areas, as narrow ones have no direction but rounding. Out of the mesh where the rim
/// lies in its border.
/// @param outward as Border::lay_flush returns it
std::map<LatticePoint, Vector> directions_out(const Facets& facets, const std::vector<Rim>& rims,
                                              const std::vector<Vector>& outward) {
  std::map<LatticePoint, Vector> out;
  for (const Rim& rim : rims)
    for (const int v : rim.vertex) out[facets.point[v]] = {};
  double largest = 0;
  for (const Facet& f : facets.list) {
    if (f.body != facets.list[rims.front().facet].body) continue;
    const Vector &p = facets.position[f.vertex[0]], &q = facets.position[f.vertex[1]],
                 &r = facets.position[f.vertex[2]];
    const Vector area = facets.dimension == 2 ? q - p : cross(q - p, r - p);
    const Vector middle = facets.dimension == 2 ? 0.5 * (p + q) : 1.0 / 3 * (p + (q + r));
    for (int k = 0; k < facets.dimension; ++k) {
      const auto found = out.find(facets.point[f.vertex[k]]);
      if (found == out.end()) continue;
      found->second = found->second + std::sqrt(dot(area, area)) * (facets.position[f.vertex[k]] - middle);
      largest = std::max(largest, dot(found->second, found->second));
    }
  }
  const auto known = out;
  for (const Rim& rim : rims)
    for (int k = 0; k < 2; ++k) {
      const Vector& other = known.at(facets.point[rim.vertex[1 - k]]);
      const Vector& own = known.at(facets.point[rim.vertex[k]]);
      if (dot(own, own) < 1e-20 * largest) out[facets.point[rim.vertex[k]]] = other;
    }
  for (const Rim& rim : rims)
    for (const int v : rim.vertex)
      if (!outward.empty() && outward[v] != Vector{}) out[facets.point[v]] = outward[v];
  return out;
}

/// Sews a narrow strip to the rim.
void prolong(Facets& facets, const std::vector<Rim>& rims, const std::vector<Vector>& outward) {
  constexpr double share = 1e-6;  // of a facet: beyond all rounding, too little to reach into the mesh again
  double longest = 0;
  for (const Rim& rim : rims) {
    const auto& v = facets.list[rim.facet].vertex;
    const Vector edge = facets.position[v[1]] - facets.position[v[0]];
    longest = std::max(longest, std::sqrt(dot(edge, edge)));
  }
  std::map<LatticePoint, int> prolonged;
  for (const auto& [point, out] : directions_out(facets, rims, outward)) {
    const double length = std::sqrt(dot(out, out));
    const Vector shift = length > 0 ? share * longest / length * out : Vector{};
    prolonged[point] = append_point(facets, facets.lattice.position(point) + shift);
  }
  for (const Rim& rim : rims) {
    const Facet source = facets.list[rim.facet];
    const int a = rim.vertex[0], b = rim.vertex[1];
    const int c = prolonged[facets.point[a]], d = prolonged[facets.point[b]];
    if (facets.dimension == 2) {
      append_facet(facets, rim.sign > 0 ? std::array{a, c, c} : std::array{c, a, a}, source.body,
                   source.facet, source.normal);
    } else {
      append_facet(facets, {b, a, c}, source.body, source.facet, source.normal);
      append_facet(facets, {b, c, d}, source.body, source.facet, source.normal);
    }
  }
}

/// Whether a closed surface is turned inside out, beyond what rounding can do to one that encloses next to
/// nothing.
bool is_inside_out(const Facets& facets, int first_facet) {
  const Vector origin = facets.position[facets.list[first_facet].vertex[0]];
  double sum = 0, size = 0;
  for (int f = first_facet; f < static_cast<int>(facets.list.size()); ++f) {
    const auto& v = facets.list[f].vertex;
    const Vector a = facets.position[v[0]] - origin, b = facets.position[v[1]] - origin;
    if (facets.dimension == 2) {
      sum += (a[0] * b[1] - a[1] * b[0]) / 2;
      size += std::sqrt(dot(b - a, b - a));
    } else {
      const Vector c = facets.position[v[2]] - origin, area = cross(b - a, c - a);
      sum += dot(cross(a, b), c) / 6;
      size += std::sqrt(dot(area, area)) / 2;
    }
  }
  return sum < -2 * facets.lattice.spacing() * size;
}

void append_body(Facets& facets, const Border& border, const Surface& surface, int body) {
  const int dim = facets.dimension, first_point = static_cast<int>(facets.point.size());
  const int first_facet = static_cast<int>(facets.list.size());
  for (int v = 0; v < surface.point_count(); ++v) append_point(facets, position_of(surface, v));
  for (int f = 0; f < surface.facet_count(); ++f) {
    std::array<int, 3> v{};
    for (int k = 0; k < 3; ++k) v[k] = first_point + surface.facets[f * dim + std::min(k, dim - 1)];
    append_facet(facets, v, body, f, {});
  }
  // Before a slit is laid onto the border, which leaves nothing of it.
  const bool inside_out = surface.closed && is_inside_out(facets, first_facet);
  find_normals(facets, first_facet);
  const std::vector<Vector> outward = border.lay_flush(facets, first_facet);
  if (!outward.empty()) find_normals(facets, first_facet);
  const std::vector<Rim> rims = RimFinder(facets, first_facet).rims();
  if (surface.closed && !rims.empty()) {
    const Rim& rim = rims.front();
    const auto& [given, facet] = facets.origin[body][facets.list[rim.facet].facet];
    throw Error(fmt::format(
        "body {}: its surface is not closed at facet {}, near ({}); close it, or declare it open if its rim "
        "lies outside the mesh",
        given, facet, fmt::join(facets.position[rim.vertex[0]], ", ")));
  }
  facets.far.push_back(inside_out ? 1 : 0);
  facets.closed.push_back(surface.closed);
  if (!rims.empty()) prolong(facets, rims, outward);
  // Facets without extent meet nothing. Only their edges counted, where neighbours meet at a vertex between.
  const auto is_degenerate = [&](const Facet& f) {
    const LatticePoint &p = facets.point[f.vertex[0]], &q = facets.point[f.vertex[1]];
    return dim == 2 ? p == q : collinear(p, q, facets.point[f.vertex[2]]);
  };
  facets.list.erase(std::remove_if(facets.list.begin() + first_facet, facets.list.end(), is_degenerate),
                    facets.list.end());
}

}  // namespace

namespace {

/// Vertices at one point of the lattice get one position, so that an edge between two of them is met in one
/// place whichever facet it is looked at from. (In the plane their arrangement does that.)
void share_positions(Facets& facets) {
  std::map<LatticePoint, Vector> position;
  std::vector<char> moved(facets.point.size(), 0);
  for (std::size_t v = 0; v < facets.point.size(); ++v) {
    const Vector& first = position.try_emplace(facets.point[v], facets.position[v]).first->second;
    moved[v] = first == facets.position[v] ? 0 : 1;
    facets.position[v] = first;
  }
  for (Facet& f : facets.list)
    if (std::any_of(f.vertex.begin(), f.vertex.end(), [&](int v) { return moved[v] != 0; }))
      f.normal = normal_into_body(3, facets.position[f.vertex[0]], facets.position[f.vertex[1]],
                                  facets.position[f.vertex[2]]);
}

}  // namespace

Facets collect_facets(const Outline& outline, const Border& border, std::span<const Surface> bodies) {
  Facets facets;
  facets.dimension = outline.dimension;
  Vector low = outline.low, high = outline.high;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    check_indices(bodies[b], static_cast<int>(b), outline.dimension);
    for (int v = 0; v < bodies[b].point_count(); ++v) {
      const Vector x = position_of(bodies[b], v);
      for (int i = 0; i < outline.dimension; ++i) {
        low[i] = std::min(low[i], x[i]);
        high[i] = std::max(high[i], x[i]);
      }
    }
  }
  facets.lattice = Lattice(low, high);
  Solids solids = join(bodies, facets.lattice);
  facets.origin = std::move(solids.origin);
  for (std::size_t b = 0; b < solids.surfaces.size(); ++b)
    append_body(facets, border, solids.surfaces[b], static_cast<int>(b));
  if (facets.dimension == 3) share_positions(facets);
  return facets;
}

LatticePoint far_from(LatticePoint point) {
  point.x[0] = std::int64_t{1} << 51;
  return point;
}

int crossing(const Facets& facets, const Facet& facet, const LatticePoint& a, const LatticePoint& b) {
  const LatticePoint &p = facets.point[facet.vertex[0]], &q = facets.point[facet.vertex[1]];
  if (facets.dimension == 2) {
    const int side_a = side_of_facet(p, q, a), side_b = side_of_facet(p, q, b);
    if (side_a == side_b) return 0;
    return side_of_mesh_edge(a, b, p) == side_of_mesh_edge(a, b, q) ? 0 : side_b;
  }
  const LatticePoint& r = facets.point[facet.vertex[2]];
  const int side_a = side_of_facet(p, q, r, a), side_b = side_of_facet(p, q, r, b);
  if (side_a == side_b) return 0;
  const int turn = side_of_edges(a, b, p, q);
  if (side_of_edges(a, b, q, r) != turn || side_of_edges(a, b, r, p) != turn) return 0;
  return side_a;  // the normal points out of the body: below is inside
}

namespace {

Vector centre_of(const Facets& facets, const Facet& f) {
  Vector centre{};
  for (int k = 0; k < facets.dimension; ++k)
    centre = centre + 1.0 / facets.dimension * facets.position[f.vertex[k]];
  return centre;
}

constexpr int all_bodies = -1;

bool counts(const Facet& f, int body) { return body == all_bodies || f.body == body; }

const Facet* closest_facet(const Facets& facets, int body, const Vector& position) {
  const Facet* closest = nullptr;
  double distance = std::numeric_limits<double>::max();
  for (const Facet& f : facets.list) {
    if (!counts(f, body)) continue;
    const Vector d = position - centre_of(facets, f);
    if (dot(d, d) >= distance) continue;
    distance = dot(d, d);
    closest = &f;
  }
  return closest;
}

/// Sum of the crossings on the way.
int crossings(const Facets& facets, int body, const LatticePoint& from, const LatticePoint& to) {
  int sum = 0;
  for (const Facet& f : facets.list)
    if (counts(f, body)) sum += crossing(facets, f, from, to);
  return sum;
}

/// A point of the lattice on a facet, or next to it.
LatticePoint middle_of(const Facets& facets, const Facet& f) {
  const LatticePoint &p = facets.point[f.vertex[0]], &q = facets.point[f.vertex[1]];
  const LatticePoint& r = facets.point[f.vertex[2]];
  LatticePoint middle;
  for (int i = 0; i < 3; ++i)
    middle.x[i] = facets.dimension == 2 ? (p.x[i] + q.x[i]) / 2 : (p.x[i] + q.x[i] + r.x[i]) / 3;
  return middle;
}

/// From the side of a facet that is not far, and the facets on the way to it.
int winding_from_facet(const Facets& facets, int body, const LatticePoint& vertex) {
  const Facet* facet = closest_facet(facets, body, facets.lattice.position(vertex));
  if (facet == nullptr) return 0;
  const LatticePoint &p = facets.point[facet->vertex[0]], &q = facets.point[facet->vertex[1]];
  const LatticePoint end = middle_of(facets, *facet);
  const bool behind = facets.dimension == 2 ? side_of_facet(p, q, end) > 0
                                            : side_of_facet(p, q, facets.point[facet->vertex[2]], end) < 0;
  return (behind ? 1 : 0) - crossings(facets, body, vertex, end);
}

}  // namespace

int winding(const Facets& facets, int body, const LatticePoint& vertex) {
  if (!facets.closed[body]) return winding_from_facet(facets, body, vertex);
  return facets.far[body] - crossings(facets, body, vertex, far_from(vertex));
}

int coverage_at(const Facets& facets, const LatticePoint& vertex) {
  if (facets.list.empty()) return facets.all_covered ? 1 : 0;
  const bool all_closed = std::find(facets.closed.begin(), facets.closed.end(), false) == facets.closed.end();
  if (!all_closed) return winding_from_facet(facets, all_bodies, vertex);
  const bool covers_far = std::any_of(facets.far.begin(), facets.far.end(), [](int w) { return w > 0; });
  return (covers_far ? 1 : 0) - crossings(facets, all_bodies, vertex, far_from(vertex));
}

}  // namespace seam::cutting
