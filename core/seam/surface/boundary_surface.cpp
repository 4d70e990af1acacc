// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>

#include "seam/base/diagnostics.hpp"
#include "seam/surface/body.hpp"

namespace seam {
namespace {

const int* cell_nodes(const MeshData& mesh, int cell) {
  return &mesh.cells[static_cast<std::size_t>(cell) * mesh.nodes_per_cell()];
}

/// Faces that belong to one cell only.
std::vector<CellFace> outer_faces(const MeshData& mesh) {
  const CellTopology& cell = topology(mesh.type);
  std::map<std::vector<int>, std::vector<CellFace>> by_vertices;
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int f = 0; f < static_cast<int>(cell.faces.size()); ++f) {
      std::vector<int> vertices;
      for (const int v : cell.faces[f]) vertices.push_back(cell_nodes(mesh, c)[v]);
      std::sort(vertices.begin(), vertices.end());
      by_vertices[vertices].push_back({c, f});
    }
  std::vector<CellFace> faces;
  for (const auto& [vertices, owners] : by_vertices)
    if (owners.size() == 1) faces.push_back(owners.front());
  std::sort(faces.begin(), faces.end(), [](const CellFace& a, const CellFace& b) {
    return std::pair(a.cell, a.face) < std::pair(b.cell, b.face);
  });
  return faces;
}

/// Local nodes of the planar facets that make up a face. Curved edges follow their middle nodes; a
/// quadrilateral is split along the diagonal from its lowest node, so that the split does not depend on the
/// cell.
std::vector<std::vector<int>> facets_of(const MeshData& mesh, const CellFace& face) {
  const CellTopology& cell = topology(mesh.type);
  const auto& nodes = cell.face_nodes[face.face];
  const bool curved = mesh.order == 2;
  if (cell.dimension == 2) {
    if (!curved) return {{nodes[0], nodes[1]}};
    return {{nodes[0], nodes[2]}, {nodes[2], nodes[1]}};
  }
  if (cell.face_type == CellType::triangle) {
    if (!curved) return {{nodes[0], nodes[1], nodes[2]}};
    return {{nodes[0], nodes[3], nodes[5]},
            {nodes[3], nodes[1], nodes[4]},
            {nodes[5], nodes[4], nodes[2]},
            {nodes[3], nodes[4], nodes[5]}};
  }
  std::vector<std::vector<int>> facets;
  if (curved) {
    const int ring[8] = {nodes[0], nodes[4], nodes[1], nodes[5], nodes[2], nodes[6], nodes[3], nodes[7]};
    for (int k = 0; k < 8; ++k) facets.push_back({ring[k], ring[(k + 1) % 8], nodes[8]});
    return facets;
  }
  const int* global = cell_nodes(mesh, face.cell);
  int lowest = 0;
  for (int k = 1; k < 4; ++k)
    if (global[nodes[k]] < global[nodes[lowest]]) lowest = k;
  const auto corner = [&](int k) { return nodes[(lowest + k) % 4]; };
  return {{corner(0), corner(1), corner(2)}, {corner(0), corner(2), corner(3)}};
}

}  // namespace

BodyBoundary body_boundary(const MeshData& mesh, const std::vector<std::string>& boundaries) {
  std::vector<CellFace> faces;
  for (const std::string& name : boundaries) {
    const auto found = mesh.boundaries.find(name);
    if (found == mesh.boundaries.end()) throw Error("the body's mesh has no boundary '" + name + "'");
    faces.insert(faces.end(), found->second.begin(), found->second.end());
  }
  if (boundaries.empty()) faces = outer_faces(mesh);
  BodyBoundary result;
  Surface& surface = result.surface;
  surface.dimension = mesh.dimension;
  surface.closed = boundaries.empty();
  std::map<int, int> number;  // of a mesh node among the surface's points
  for (const CellFace& face : faces)
    for (const auto& facet : facets_of(mesh, face)) {
      result.parent.push_back(face);
      for (const int local : facet) {
        const int node = cell_nodes(mesh, face.cell)[local];
        const auto [found, is_new] = number.emplace(node, surface.point_count());
        if (is_new) {
          result.node.push_back(node);
          for (int d = 0; d < mesh.dimension; ++d)
            surface.points.push_back(mesh.coordinates[static_cast<std::size_t>(node) * mesh.dimension + d]);
        }
        surface.facets.push_back(found->second);
        result.local.push_back(local);
      }
    }
  return result;
}

}  // namespace seam
