// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace seam::cutting {
namespace {

/// Whether four points lie in one plane up to the rounding of their coordinates. Only a choice of the
/// subdivision: both sides of a face get the same answer, since the corners come in a common order.
bool coplanar(const std::array<Vector, 4>& x) {
  double largest = 0;
  for (const Vector& p : x)
    for (const double c : p) largest = std::max(largest, std::abs(c));
  const Vector a = x[1] - x[0], b = x[2] - x[0], normal = cross(a, b);
  return std::abs(dot(normal, x[3] - x[0])) <=
         16 * std::numeric_limits<double>::epsilon() * largest * std::sqrt(dot(normal, normal));
}

}  // namespace

Outline::Outline(const Mesh& mesh) : dimension(mesh.dimension()), nodes_per_cell_(mesh.geometry_nodes()) {
  number_vertices(mesh);
  for (int c = 0; c < mesh.cells(); ++c) {
    first_side.push_back(static_cast<int>(sides.size()));
    add_sides(mesh, c);
  }
  first_side.push_back(static_cast<int>(sides.size()));
  middles_.clear();
  number_edges();
  find_neighbours(mesh);
  const Communicator& communicator = mesh.communicator();
  for (int i = 0; i < dimension; ++i) {
    low[i] = std::numeric_limits<double>::max();
    high[i] = std::numeric_limits<double>::lowest();
    for (const Vector& x : position) {
      low[i] = std::min(low[i], x[i]);
      high[i] = std::max(high[i], x[i]);
    }
    low[i] = communicator.min(low[i]);
    high[i] = communicator.max(high[i]);
  }
}

void Outline::number_vertices(const Mesh& mesh) {
  std::unordered_map<int, int> local;
  cell_vertex_.reserve(static_cast<std::size_t>(mesh.cells()) * nodes_per_cell_);
  for (int c = 0; c < mesh.cells(); ++c)
    for (int a = 0; a < nodes_per_cell_; ++a) {
      const int node =
          mesh.whole().cells[static_cast<std::size_t>(mesh.global_cell(c)) * nodes_per_cell_ + a];
      const auto [entry, is_new] = local.try_emplace(node, static_cast<int>(global_.size()));
      if (is_new) {
        global_.push_back(node);
        Vector x{};
        for (int i = 0; i < dimension; ++i) x[i] = mesh.geometry(c)[a * dimension + i];
        position.push_back(x);
      }
      cell_vertex_.push_back(entry->second);
    }
}

void Outline::add_side(int face, const std::array<int, 3>& vertices) {
  Side side;
  side.vertex = vertices;
  side.face = face;
  sides.push_back(side);
}

void Outline::add_sides(const Mesh& mesh, int cell) {
  const CellTopology& shape = topology(mesh.type());
  const bool second_order = mesh.order() == 2;
  for (int f = 0; f < static_cast<int>(shape.faces.size()); ++f) {
    std::vector<int> v;
    const auto& nodes = second_order ? shape.face_nodes[f] : shape.faces[f];
    for (const int node : nodes) v.push_back(vertex_of(cell, node));
    if (shape.face_type == CellType::segment) {
      const int end = v.size() == 3 ? v[2] : v[1];
      add_side(f, {v[0], end, 0});
      if (second_order) add_side(f, {end, v[1], 0});
    } else if (shape.face_type == CellType::triangle) {
      if (second_order) {
        for (const auto& t : {std::array{v[0], v[3], v[5]}, std::array{v[3], v[1], v[4]},
                              std::array{v[5], v[4], v[2]}, std::array{v[3], v[4], v[5]}})
          add_side(f, t);
      } else {
        add_side(f, {v[0], v[1], v[2]});
      }
    } else if (second_order) {
      for (int k = 0; k < 4; ++k) {
        add_side(f, {v[k], v[4 + k], v[8]});
        add_side(f, {v[4 + k], v[(k + 1) % 4], v[8]});
      }
    } else {
      split_quadrilateral(mesh, cell, f);
    }
  }
}

void Outline::split_quadrilateral(const Mesh& mesh, int cell, int face) {
  const auto& corners = topology(mesh.type()).faces[face];
  std::array<int, 4> v{};
  for (int k = 0; k < 4; ++k) v[k] = vertex_of(cell, corners[k]);
  const auto less = [&](int a, int b) { return global_[a] < global_[b]; };
  std::rotate(v.begin(), std::min_element(v.begin(), v.end(), less), v.end());
  std::array<int, 4> sorted = v;
  std::sort(sorted.begin(), sorted.end(), less);
  std::array<Vector, 4> x;
  for (int k = 0; k < 4; ++k) x[k] = position[sorted[k]];
  if (coplanar(x)) {
    add_side(face, {v[0], v[1], v[2]});
    add_side(face, {v[0], v[2], v[3]});
    return;
  }
  const auto [middle, is_new] = middles_.try_emplace(sorted, vertex_count());
  if (is_new) {
    position.push_back(0.25 * ((x[0] + x[1]) + (x[2] + x[3])));
    global_.push_back(-1);
  }
  for (int k = 0; k < 4; ++k) add_side(face, {v[k], v[(k + 1) % 4], middle->second});
}

void Outline::number_edges() {
  struct Use {
    std::array<int, 2> vertices;
    int side, place;
  };
  const int per_side = dimension == 2 ? 1 : 3;
  std::vector<Use> uses;
  uses.reserve(sides.size() * per_side);
  for (int s = 0; s < static_cast<int>(sides.size()); ++s)
    for (int k = 0; k < per_side; ++k) {
      const int a = sides[s].vertex[k], b = sides[s].vertex[(k + 1) % 3];
      uses.push_back({{std::min(a, b), std::max(a, b)}, s, k});
    }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.vertices < b.vertices; });
  for (const Use& use : uses) {
    if (edges.empty() || edges.back() != use.vertices) edges.push_back(use.vertices);
    Side& side = sides[use.side];
    side.edge[use.place] = static_cast<int>(edges.size()) - 1;
    side.forward[use.place] = side.vertex[use.place] == use.vertices[0] ? 1 : -1;
  }
  first_edge_of_vertex.assign(position.size() + 1, 0);
  for (const auto& e : edges)
    for (const int v : e) ++first_edge_of_vertex[v + 1];
  for (std::size_t v = 0; v < position.size(); ++v) first_edge_of_vertex[v + 1] += first_edge_of_vertex[v];
  edges_of_vertex.resize(edges.size() * 2);
  std::vector<int> next(first_edge_of_vertex.begin(), first_edge_of_vertex.end() - 1);
  for (int e = 0; e < edge_count(); ++e)
    for (const int v : edges[e]) edges_of_vertex[next[v]++] = e;
}

void Outline::find_neighbours(const Mesh& mesh) {
  const CellTopology& shape = topology(mesh.type());
  struct Use {
    std::array<int, 4> corners;
    CellFace face;
  };
  std::vector<Use> uses;
  for (int c = 0; c < mesh.cells(); ++c)
    for (int f = 0; f < static_cast<int>(shape.faces.size()); ++f) {
      Use use{{-1, -1, -1, -1}, {c, f}};
      for (std::size_t a = 0; a < shape.faces[f].size(); ++a)
        use.corners[a] = vertex_of(c, shape.faces[f][a]);
      std::sort(use.corners.begin(), use.corners.end());
      uses.push_back(use);
    }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.corners < b.corners; });
  neighbour.resize(mesh.cells());
  for (auto& faces : neighbour) faces.fill(-1);
  for (std::size_t k = 0; k + 1 < uses.size(); ++k) {
    if (uses[k].corners != uses[k + 1].corners) continue;
    const CellFace a = uses[k].face, b = uses[k + 1].face;
    neighbour[a.cell][a.face] = b.cell;
    neighbour[b.cell][b.face] = a.cell;
  }
}

Vector Outline::centre(int cell) const {
  Vector sum{};
  const int first = first_side[cell], last = first_side[cell + 1];
  for (int s = first; s < last; ++s)
    for (int k = 0; k < dimension; ++k) sum = sum + position[sides[s].vertex[k]];
  return 1.0 / (dimension * (last - first)) * sum;
}

double Outline::volume(int cell) const {
  const Vector c = centre(cell);
  double sum = 0;
  for (int s = first_side[cell]; s < first_side[cell + 1]; ++s) {
    const auto& v = sides[s].vertex;
    const Vector a = position[v[0]] - c, b = position[v[1]] - c;
    sum += dimension == 2 ? 0.5 * (a[0] * b[1] - a[1] * b[0]) : dot(cross(a, b), position[v[2]] - c) / 6;
  }
  return sum;
}

Vector side_normal(const Outline& outline, const Side& side) {
  const Vector &a = outline.position[side.vertex[0]], &b = outline.position[side.vertex[1]];
  const Vector normal = outline.dimension == 2 ? Vector{b[1] - a[1], a[0] - b[0], 0}
                                               : cross(b - a, outline.position[side.vertex[2]] - a);
  return 1 / std::sqrt(dot(normal, normal)) * normal;
}

}  // namespace seam::cutting
