// SPDX-License-Identifier: BSD-3-Clause
#include "seam/field/surface_nodes.hpp"

#include <array>
#include <cmath>

#include "seam/space/space.hpp"

namespace seam {
namespace {

/// Calls back with each face, and with the places of its nodes in its cell.
template <class Use>
void for_each_face(const Space& space, const std::vector<std::string>& boundaries, const Use& use) {
  const Mesh& mesh = space.mesh();
  const CellTopology& cell = topology(mesh.type());
  const auto per_face = static_cast<std::ptrdiff_t>(topology(cell.face_type).nodes(space.order()));
  const auto all = [&](const std::vector<CellFace>& faces) {
    for (const CellFace& face : faces) {
      const auto& places = cell.face_nodes[face.face];
      use(face, std::vector<int>(places.begin(), places.begin() + per_face));
    }
  };
  for (const std::string& boundary : boundaries) all(mesh.boundary(boundary));
  if (boundaries.empty()) all(mesh.outer_faces());
}

}  // namespace

double face_area(const CellTopology& cell, int face, const double* x) {
  const int dim = cell.dimension;
  const auto& vertices = cell.faces[face];
  // Of the fan of triangles about vertex 0, in the plane of the way to vertex 1.
  std::array<double, 3> area{};
  const auto way = [&](std::size_t to, int d) {
    return d < dim ? x[vertices[to] * dim + d] - x[vertices[0] * dim + d] : 0.0;
  };
  if (dim == 2) return std::hypot(way(1, 0), way(1, 1));
  for (std::size_t k = 1; k + 1 < vertices.size(); ++k)
    for (int d = 0; d < 3; ++d)
      area[d] += 0.5 * (way(k, (d + 1) % 3) * way(k + 1, (d + 2) % 3) -
                        way(k, (d + 2) % 3) * way(k + 1, (d + 1) % 3));
  return std::hypot(area[0], area[1], area[2]);
}

std::vector<double> surface_shares(const Space& space, const std::vector<std::string>& boundaries) {
  std::vector<double> shares(space.nodes(), 0.0);
  for_each_face(space, boundaries, [&](const CellFace& face, const std::vector<int>& places) {
    const double share =
        face_area(topology(space.mesh().type()), face.face, space.mesh().geometry(face.cell)) /
        static_cast<double>(places.size());
    for (const int place : places)
      for (int set = 0; set < space.sets(); ++set)
        shares[space.in_set(space.cell_nodes(face.cell)[place], set)] += share;
  });
  // The owner holds every cell of its nodes; what others have added up is not all.
  space.halo().update(shares, 1);
  return shares;
}

std::vector<std::vector<int>> nodes_beside(const Space& space, const std::vector<std::string>& boundaries,
                                           const std::vector<char>& asked_for) {
  std::vector<std::vector<int>> beside(space.owned_nodes());
  for_each_face(space, boundaries, [&](const CellFace& face, const std::vector<int>& places) {
    const int* nodes = space.cell_nodes(face.cell);
    for (const int place : places)
      if (const int node = nodes[place]; node < space.owned_nodes() && asked_for[node] != 0)
        for (const int other : places)
          if (asked_for[nodes[other]] == 0) beside[node].push_back(nodes[other]);
  });
  return beside;
}

}  // namespace seam
