// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/sound_surfaces.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "seam/base/diagnostics.hpp"
#include "seam/cut/cell_map.hpp"
#include "seam/cut/cell_search.hpp"
#include "seam/cut/facet_vertices.hpp"
#include "seam/mesh/mesh.hpp"

namespace seam {

using namespace cutting;

namespace {

constexpr double nearness = 1e-6;  ///< of a cell's diameter

constexpr const char* given_twice =
    "two interfaces have the same part of the surface of '{}' in mesh '{}', near ({:.6g}): what couples "
    "there "
    "would count twice; let each have its own `boundaries`";
constexpr const char* shared_end =
    "the surface of '{}' ends inside of mesh '{}' at ({:.6g}), on that of '{}': neither is closed once they "
    "part a little, as bonded bodies do; let the interfaces have the whole boundary of each, which is no "
    "boundary of the field where they meet, and let the nodes there have one motion by a constraint `tied`";

/// Where the surfaces of one body end together: parts that it gives one by one share their vertices.
std::set<Vector> rim(const std::vector<const Surface*>& surfaces) {
  std::map<std::vector<Vector>, int> count;  // of the facets at a vertex, in space at an edge
  for (const Surface* surface : surfaces)
    for (int facet = 0; facet < surface->facet_count(); ++facet) {
      const std::array<Vector, 3> corner = facet_vertices(*surface, facet);
      for (int k = 0; k < surface->dimension; ++k) {
        std::vector<Vector> end{corner[k]};
        if (surface->dimension == 3) end.push_back(corner[(k + 1) % 3]);
        std::ranges::sort(end);
        ++count[end];
      }
    }
  std::set<Vector> result;
  for (const auto& [end, facets] : count)
    if (facets == 1) result.insert(end.begin(), end.end());
  return result;
}

/// A place on a facet that the surfaces of one body give twice.
std::optional<Vector> find_twice(const std::vector<const Surface*>& surfaces) {
  std::set<std::array<Vector, 3>> seen;
  for (const Surface* surface : surfaces)
    for (int facet = 0; facet < surface->facet_count(); ++facet) {
      const std::array<Vector, 3> corner = facet_vertices(*surface, facet);
      std::array<Vector, 3> sorted = corner;
      std::ranges::sort(sorted);
      if (!seen.insert(sorted).second) return corner[0];
    }
  return std::nullopt;
}

/// From a point to a segment, or a triangle's plane where the point is over it, else to its edges.
double distance(const Surface& surface, int facet, const Vector& x) {
  const auto [a, b, c] = facet_vertices(surface, facet);
  const auto to_segment = [&](const Vector& from, const Vector& to) {
    const Vector along = to - from;
    const double share = std::clamp(dot(x - from, along) / dot(along, along), 0.0, 1.0);
    const Vector way = x - (from + share * along);
    return std::sqrt(dot(way, way));
  };
  if (surface.dimension == 2) return to_segment(a, b);
  const Vector normal = cross(b - a, c - a);
  const auto is_left_of = [&](const Vector& from, const Vector& to) {
    return dot(cross(to - from, x - from), normal) >= 0;
  };
  if (is_left_of(a, b) && is_left_of(b, c) && is_left_of(c, a))
    return std::abs(dot(x - a, normal)) / std::sqrt(dot(normal, normal));
  return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

/// Finds what of a body's surfaces a point lies on.
class BodyFacets {
 public:
  /// @param reach m
  BodyFacets(const std::vector<const Surface*>& surfaces, double reach)
      : reach_(reach), search_(boxes(surfaces)) {
    for (const Surface* surface : surfaces)
      for (int facet = 0; facet < surface->facet_count(); ++facet) all_.emplace_back(surface, facet);
  }
  [[nodiscard]] bool meet(const Vector& x) const {
    const Vector margin{reach_, reach_, reach_};
    std::vector<int> near;
    search_.find(x - margin, x + margin, near);
    return std::ranges::any_of(near, [&](int number) {
      const auto& [surface, facet] = all_[static_cast<std::size_t>(number)];
      return distance(*surface, facet, x) < reach_;
    });
  }

 private:
  static std::vector<std::pair<Vector, Vector>> boxes(const std::vector<const Surface*>& surfaces) {
    std::vector<std::pair<Vector, Vector>> result;
    for (const Surface* surface : surfaces)
      for (int facet = 0; facet < surface->facet_count(); ++facet) {
        const std::array<Vector, 3> corner = facet_vertices(*surface, facet);
        auto& [low, high] = result.emplace_back(corner[0], corner[0]);
        for (int k = 1; k < surface->dimension; ++k)
          for (int d = 0; d < 3; ++d) {
            low[d] = std::min(low[d], corner[k][d]);
            high[d] = std::max(high[d], corner[k][d]);
          }
      }
    return result;
  }
  double reach_;
  CellSearch search_;
  std::vector<std::pair<const Surface*, int>> all_;
};

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
    if (const auto at = find_twice(own))
      throw Error(fmt::format(given_twice, body, mesh.name(),
                              fmt::join(at->begin(), at->begin() + mesh.dimension(), ", ")));
  if (of_body.size() < 2) return;
  double size = 0;
  for (int cell = 0; cell < mesh.owned_cells(); ++cell) size = std::max(size, mesh.diameter(cell));
  size = mesh.communicator().max(size);
  std::map<std::string, BodyFacets> facets;
  for (const auto& [body, own] : of_body) facets.try_emplace(body, own, nearness * size);
  for (const auto& [body, own] : of_body) {
    if (std::ranges::all_of(own, &Surface::closed)) continue;
    for (const Vector& end : rim(own))
      for (const auto& [other, theirs] : facets)
        if (other != body && theirs.meet(end) && is_inside(mesh, end, 1e-3 * size))
          throw Error(fmt::format(shared_end, body, mesh.name(),
                                  fmt::join(end.begin(), end.begin() + mesh.dimension(), ", "), other));
  }
}

}  // namespace seam
