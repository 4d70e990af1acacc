// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/sound_surfaces.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "seam/base/diagnostics.hpp"
#include "seam/cut/cell_map.hpp"
#include "seam/mesh/mesh.hpp"

namespace seam {

using namespace cutting;

namespace {

constexpr double nearness = 1e-6;  ///< of a cell's diameter

Vector vertex(const Surface& surface, int facet, int k) {
  Vector x{};
  const auto dim = static_cast<std::size_t>(surface.dimension);
  const auto number = static_cast<std::size_t>(surface.facets[facet * dim + k]);
  std::copy_n(&surface.points[number * dim], dim, x.begin());
  return x;
}

/// Where the surfaces of one body end together: parts that it gives one by one share their vertices.
std::set<Vector> rim(const std::vector<const Surface*>& surfaces) {
  std::map<std::vector<Vector>, int> count;  // of the facets at a vertex, in space at an edge
  for (const Surface* surface : surfaces)
    for (int facet = 0; facet < surface->facet_count(); ++facet)
      for (int k = 0; k < surface->dimension; ++k) {
        std::vector<Vector> end{vertex(*surface, facet, k)};
        if (surface->dimension == 3) end.push_back(vertex(*surface, facet, (k + 1) % 3));
        std::ranges::sort(end);
        ++count[end];
      }
  std::set<Vector> result;
  for (const auto& [end, facets] : count)
    if (facets == 1) result.insert(end.begin(), end.end());
  return result;
}

/// A place on a facet that the surfaces of one body give twice.
std::optional<Vector> given_twice(const std::vector<const Surface*>& surfaces) {
  std::set<std::vector<Vector>> seen;
  for (const Surface* surface : surfaces)
    for (int facet = 0; facet < surface->facet_count(); ++facet) {
      std::vector<Vector> corners;
      for (int k = 0; k < surface->dimension; ++k) corners.push_back(vertex(*surface, facet, k));
      std::ranges::sort(corners);
      if (!seen.insert(corners).second) return corners.front();
    }
  return std::nullopt;
}

/// From a point to a segment, or a triangle's plane where the point is over it, else to its edges.
double distance(const Surface& surface, int facet, const Vector& x) {
  const auto to_segment = [&](const Vector& a, const Vector& b) {
    const Vector along = b - a;
    const double share = std::clamp(dot(x - a, along) / dot(along, along), 0.0, 1.0);
    const Vector way = x - (a + share * along);
    return std::sqrt(dot(way, way));
  };
  const Vector a = vertex(surface, facet, 0), b = vertex(surface, facet, 1);
  if (surface.dimension == 2) return to_segment(a, b);
  const Vector c = vertex(surface, facet, 2), normal = cross(b - a, c - a);
  const auto is_left_of = [&](const Vector& from, const Vector& to) {
    return dot(cross(to - from, x - from), normal) >= 0;
  };
  if (is_left_of(a, b) && is_left_of(b, c) && is_left_of(c, a))
    return std::abs(dot(x - a, normal)) / std::sqrt(dot(normal, normal));
  return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

bool lies_in(CellType type, const Vector& reference) {
  const int dim = topology(type).dimension;
  double sum = 0, least = 1, most = 0;
  for (int d = 0; d < dim; ++d) {
    sum += reference[d];
    least = std::min(least, reference[d]);
    most = std::max(most, reference[d]);
  }
  return least >= -nearness && (is_simplex(type) ? sum : most) <= 1 + nearness;
}

/// Whether a place, and what is a little beside it, lies in the mesh. Collective.
bool is_inside(const Mesh& mesh, const Vector& x, double beside) {
  const int dim = mesh.dimension();
  for (int d = 0; d < dim; ++d)
    for (const double way : {-beside, beside}) {
      Vector at = x;
      at[d] += way;
      bool found = false;
      for (int cell = 0; cell < mesh.owned_cells() && !found; ++cell) {
        Vector corner{};
        std::copy_n(mesh.geometry(cell), dim, corner.begin());
        if (dot(at - corner, at - corner) > mesh.diameter(cell) * mesh.diameter(cell)) continue;
        found = lies_in(mesh.type(), CellMap(mesh, cell).to_reference(at));
      }
      if (!mesh.communicator().any(found)) return false;
    }
  return true;
}

}  // namespace

void refuse_unsound_surfaces(const Mesh& mesh, const std::vector<Surface>& surfaces,
                             const std::vector<std::string>& bodies) {
  std::map<std::string, std::vector<const Surface*>> of_body;
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    if (!bodies[s].empty()) of_body[bodies[s]].push_back(&surfaces[s]);
  for (const auto& [body, own] : of_body)
    if (const auto at = given_twice(own))
      throw Error(
          fmt::format("two interfaces have the same part of the surface of '{}' in mesh '{}', near ({:.6g}): "
                      "what couples "
                      "there would count twice; let each have its own `boundaries`",
                      body, mesh.name(), fmt::join(at->begin(), at->begin() + mesh.dimension(), ", ")));
  if (of_body.size() < 2) return;
  double size = 0;
  for (int cell = 0; cell < mesh.owned_cells(); ++cell) size = std::max(size, mesh.diameter(cell));
  size = mesh.communicator().max(size);
  for (const auto& [body, own] : of_body) {
    if (std::ranges::all_of(own, &Surface::closed)) continue;
    for (const Vector& end : rim(own))
      for (const auto& [other, theirs] : of_body) {
        if (other == body) continue;
        const bool meets = std::ranges::any_of(theirs, [&](const Surface* surface) {
          for (int facet = 0; facet < surface->facet_count(); ++facet)
            if (distance(*surface, facet, end) < nearness * size) return true;
          return false;
        });
        if (!meets || !is_inside(mesh, end, 1e-3 * size)) continue;
        throw Error(fmt::format(
            "the surface of '{}' ends inside of mesh '{}' at ({:.6g}), on that of '{}': neither is closed "
            "once "
            "they part a little, as bonded bodies do; let the interfaces have the whole boundary of each, "
            "which is no "
            "boundary of the field where they meet, and let the nodes there have one motion by a constraint "
            "`tied`",
            body, mesh.name(), fmt::join(end.begin(), end.begin() + mesh.dimension(), ", "), other));
      }
  }
}

}  // namespace seam
