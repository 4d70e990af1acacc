// SPDX-License-Identifier: BSD-3-Clause
#include "seam/mesh/cell_type.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace seam {

namespace {

/// What distinguishes one shape from another; the rest follows from it.
struct Shape {
  CellType type;
  int dimension;
  std::vector<double> vertices;  ///< reference coordinates, `dimension` each
  std::vector<std::array<int, 2>> edges;
  CellType face_type;
  std::vector<std::vector<int>> faces;  ///< for the hexahedron in the order of VTK's face midpoints
};

Shape shape(CellType type) {
  switch (type) {
    case CellType::point:
      return {type, 0, {}, {}, CellType::point, {}};
    case CellType::segment:
      return {type, 1, {0, 1}, {{0, 1}}, CellType::point, {{0}, {1}}};
    case CellType::triangle:
      return {
          type, 2, {0, 0, 1, 0, 0, 1}, {{0, 1}, {1, 2}, {2, 0}}, CellType::segment, {{0, 1}, {1, 2}, {2, 0}}};
    case CellType::quadrilateral:
      return {type,
              2,
              {0, 0, 1, 0, 1, 1, 0, 1},
              {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
              CellType::segment,
              {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
    case CellType::tetrahedron:
      return {type,
              3,
              {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
              {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
              CellType::triangle,
              {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}}};
    case CellType::hexahedron:
      return {
          type,
          3,
          {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1},
          {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}},
          CellType::quadrilateral,
          {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};
  }
  throw std::logic_error("seam::topology: not a cell type");
}

bool is_tensor_cell(CellType type) {
  return type == CellType::segment || type == CellType::quadrilateral || type == CellType::hexahedron;
}

/// Appends the mean of some vertices as a further node.
template <class Vertices>
void append_midpoint(std::vector<double>& coordinates, const Vertices& vertices, int dimension) {
  for (int i = 0; i < dimension; ++i) {
    double sum = 0;
    for (const int v : vertices) sum += coordinates[static_cast<std::size_t>(v) * dimension + i];
    coordinates.push_back(sum / static_cast<double>(std::size(vertices)));
  }
}

std::vector<double> second_order_nodes(const Shape& s) {
  std::vector<double> coordinates = s.vertices;
  // The only node of a segment that is not a vertex is both the middle of its edge and its centre.
  for (const auto& edge : s.edges) append_midpoint(coordinates, edge, s.dimension);
  if (s.type == CellType::hexahedron)
    for (const auto& face : s.faces) append_midpoint(coordinates, face, s.dimension);
  if (is_tensor_cell(s.type) && s.dimension > 1) {
    std::vector<int> all(s.vertices.size() / s.dimension);
    for (std::size_t v = 0; v < all.size(); ++v) all[v] = static_cast<int>(v);
    append_midpoint(coordinates, all, s.dimension);
  }
  return coordinates;
}

/// The node in the middle of the edge between two vertices.
int edge_node(const Shape& s, int vertex_count, int a, int b) {
  const auto same = [&](const std::array<int, 2>& e) {
    return (e[0] == a && e[1] == b) || (e[0] == b && e[1] == a);
  };
  const auto edge = std::find_if(s.edges.begin(), s.edges.end(), same);
  return vertex_count + static_cast<int>(edge - s.edges.begin());
}

std::vector<int> nodes_of_face(const Shape& s, int vertex_count, int face) {
  std::vector<int> nodes = s.faces[face];
  const std::vector<int> vertices = nodes;
  if (s.dimension == 1) return nodes;
  for (const auto& e : topology(s.face_type).edges)
    nodes.push_back(edge_node(s, vertex_count, vertices[e[0]], vertices[e[1]]));
  if (s.face_type == CellType::quadrilateral)
    nodes.push_back(vertex_count + static_cast<int>(s.edges.size()) + face);
  return nodes;
}

CellTopology build(CellType type) {
  Shape s = shape(type);
  const int vertex_count = s.dimension == 0 ? 1 : static_cast<int>(s.vertices.size()) / s.dimension;
  CellTopology t;
  t.type = type;
  t.dimension = s.dimension;
  t.vertices = vertex_count;
  t.face_type = s.face_type;
  t.node_coordinates = second_order_nodes(s);
  for (int f = 0; f < static_cast<int>(s.faces.size()); ++f)
    t.face_nodes.push_back(nodes_of_face(s, vertex_count, f));
  t.edges = std::move(s.edges);
  t.faces = std::move(s.faces);
  return t;
}

/// One table per type, each built on first use: a hexahedron's build asks for the quadrilateral's.
template <CellType type>
const CellTopology& table() {
  static const CellTopology t = build(type);
  return t;
}

}  // namespace

int CellTopology::nodes(int order) const {
  if (order != 1 && order != 2) throw std::logic_error("CellTopology::nodes: only orders 1 and 2 exist");
  return order == 1 || dimension == 0 ? vertices : static_cast<int>(node_coordinates.size()) / dimension;
}

const CellTopology& topology(CellType type) {
  switch (type) {
    case CellType::point:
      return table<CellType::point>();
    case CellType::segment:
      return table<CellType::segment>();
    case CellType::triangle:
      return table<CellType::triangle>();
    case CellType::quadrilateral:
      return table<CellType::quadrilateral>();
    case CellType::tetrahedron:
      return table<CellType::tetrahedron>();
    case CellType::hexahedron:
      return table<CellType::hexahedron>();
  }
  throw std::logic_error("seam::topology: not a cell type");
}

std::string name(CellType type) {
  switch (type) {
    case CellType::point:
      return "point";
    case CellType::segment:
      return "segment";
    case CellType::triangle:
      return "triangle";
    case CellType::quadrilateral:
      return "quadrilateral";
    case CellType::tetrahedron:
      return "tetrahedron";
    case CellType::hexahedron:
      return "hexahedron";
  }
  throw std::logic_error("seam::name: not a cell type");
}

}  // namespace seam
