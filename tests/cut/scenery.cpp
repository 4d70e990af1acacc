// SPDX-License-Identifier: BSD-3-Clause
// Meshes, bodies and sums that tests of cuts use.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>

#include "cut/cut_test.hpp"
#include "seam/mesh/lagrange.hpp"
#include "seam/mesh/quadrature.hpp"

using namespace seam;

namespace {

/// Corners of the cells of one grid cell, as offsets in (x, y, z).
std::vector<std::vector<std::array<int, 3>>> corners_of(CellType type) {
  using C = std::vector<std::array<int, 3>>;
  switch (type) {
    case CellType::quadrilateral:
      return {C{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    case CellType::triangle:
      return {C{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, C{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    case CellType::hexahedron:
      return {C{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    default:
      return {C{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, C{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 1, 1}},
              C{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {1, 1, 1}}, C{{0, 0, 0}, {0, 1, 1}, {0, 0, 1}, {1, 1, 1}},
              C{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}}, C{{0, 0, 0}, {1, 0, 1}, {1, 0, 0}, {1, 1, 1}}};
  }
}

Surface empty_surface(int dimension) {
  Surface s;
  s.dimension = dimension;
  return s;
}

void add_quadrilateral(Surface& s, int a, int b, int c, int d) {
  s.facets.insert(s.facets.end(), {a, b, c, a, c, d});
}

}  // namespace

bool has_flat_sides(const Mesh& mesh, int cell) {
  const CellTopology& shape = topology(mesh.type());
  const int dim = mesh.dimension();
  const double* x = mesh.geometry(cell);
  const auto off = [&](int node, const auto& weights) {
    double distance = 0;
    for (int i = 0; i < dim; ++i) {
      double value = x[node * dim + i];
      for (const auto& [v, w] : weights) value -= w * x[v * dim + i];
      distance = std::max(distance, std::abs(value));
    }
    return distance > 1e-12;
  };
  using Weights = std::vector<std::pair<int, double>>;
  for (std::size_t e = 0; mesh.order() == 2 && e < shape.edges.size(); ++e)
    if (off(shape.vertices + static_cast<int>(e),
            Weights{{shape.edges[e][0], 0.5}, {shape.edges[e][1], 0.5}}))
      return false;
  // Parallelograms, which is enough for the meshes here.
  return std::none_of(shape.faces.begin(), shape.faces.end(), [&](const auto& f) {
    return f.size() == 4 && off(f[3], Weights{{f[0], 1.0}, {f[1], -1.0}, {f[2], 1.0}});
  });
}

namespace {

/// Unit normal of a flat face, that of its corners.
Point face_normal(const Mesh& mesh, int cell, int f) {
  const CellTopology& shape = topology(mesh.type());
  const int dim = mesh.dimension(), last = static_cast<int>(shape.faces[f].size()) - 1;
  const auto corner = [&](int k, int i) { return mesh.geometry(cell)[shape.faces[f][k] * dim + i]; };
  Point a{}, b{}, n{};
  for (int i = 0; i < dim; ++i) {
    a[i] = corner(1, i) - corner(0, i);
    b[i] = corner(last, i) - corner(0, i);
  }
  if (dim == 2)
    n = {a[1], -a[0], 0};
  else
    for (int i = 0; i < 3; ++i) n[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (double& x : n) x /= length;
  return n;
}

}  // namespace

Point closure(const CutMesh& cut, int cell) {
  const Mesh& mesh = cut.mesh();
  const CellTopology& shape = topology(mesh.type());
  const int dim = mesh.dimension();
  static CutRule rule;
  static InterfaceRule interface;
  static ShapeTable table;
  Point sum{};
  cut.interface_rule(cell, 1, interface);
  for (int q = 0; q < interface.count(); ++q)
    for (int i = 0; i < dim; ++i) sum[i] += interface.weight[q] * interface.normal[q * dim + i];
  for (int f = 0; f < static_cast<int>(shape.faces.size()); ++f) {
    cut.face_rule(cell, f, 1, rule);
    if (rule.count() == 0) continue;
    const Point n = face_normal(mesh, cell, f);
    for (const double w : rule.weight)
      for (int i = 0; i < dim; ++i) sum[i] += w * n[i];
  }
  return sum;
}

double flux_of_position(const CutMesh& cut, int cell) {
  const Mesh& mesh = cut.mesh();
  const CellTopology& shape = topology(mesh.type());
  const int dim = mesh.dimension();
  const Point middle = cut.cell_centre(cell);
  static CutRule rule;
  static InterfaceRule interface;
  double sum = 0;
  cut.interface_rule(cell, 1, interface);
  for (int q = 0; q < interface.count(); ++q)
    for (int i = 0; i < dim; ++i)
      sum +=
          interface.weight[q] * interface.normal[q * dim + i] * (interface.position[q * dim + i] - middle[i]);
  for (int f = 0; f < static_cast<int>(shape.faces.size()); ++f) {
    cut.face_rule(cell, f, 1, rule);
    if (rule.count() == 0) continue;
    const Point normal = face_normal(mesh, cell, f);
    const double* corner = &mesh.geometry(cell)[shape.faces[f][0] * dim];
    double height = 0, area = 0;
    for (int i = 0; i < dim; ++i) height += normal[i] * (corner[i] - middle[i]);
    for (const double w : rule.weight) area += w;
    sum += area * height;
  }
  return sum;
}

int effort() {
  const char* text = std::getenv("SEAM_CUT_TEST_FACTOR");
  return text == nullptr ? 1 : std::max(1, std::atoi(text));
}

Placement unmoved() {
  return [](const Point& x) { return x; };
}

Placement rotated(int dimension, double angle, Point stretch, Point shift) {
  return [=](const Point& x) {
    Point y{stretch[0] * x[0], stretch[1] * x[1], stretch[2] * x[2]};
    const auto turn = [&](int i, int j, double by) {
      const double a = y[i], b = y[j];
      y[i] = std::cos(by) * a - std::sin(by) * b;
      y[j] = std::sin(by) * a + std::cos(by) * b;
    };
    turn(0, 1, angle);
    if (dimension == 3) {
      turn(1, 2, 0.7 * angle);
      turn(2, 0, 1.3 * angle);
    }
    for (int i = 0; i < dimension; ++i) y[i] += shift[i];
    return y;
  };
}

Mesh grid(CellType type, std::array<int, 3> n, const Placement& placement, int order) {
  const CellTopology& shape = topology(type);
  const int dim = shape.dimension, nodes = shape.nodes(order);
  if (dim == 2) n[2] = 0;
  auto data = std::make_shared<MeshData>();
  data->dimension = dim;
  data->type = type;
  data->order = order;
  // Numbered on the grid of half cells, so that middle nodes have a place; unused numbers are left out.
  const std::array<int, 3> m{2 * n[0] + 1, 2 * n[1] + 1, 2 * n[2] + 1};
  std::vector<int> number(static_cast<std::size_t>(m[0]) * m[1] * m[2], -1);
  const auto node = [&](const std::array<int, 3>& at) {
    int& id =
        number[at[0] + static_cast<std::size_t>(m[0]) * (at[1] + static_cast<std::size_t>(m[1]) * at[2])];
    if (id < 0) {
      id = data->node_count();
      const Point x =
          placement({at[0] / (2.0 * n[0]), at[1] / (2.0 * n[1]), dim == 3 ? at[2] / (2.0 * n[2]) : 0});
      data->coordinates.insert(data->coordinates.end(), x.begin(), x.begin() + dim);
    }
    return id;
  };
  for (int z = 0; z < std::max(1, n[2]); ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x)
        for (const auto& corners : corners_of(type))
          for (int a = 0; a < nodes; ++a) {
            // The map from reference coordinates to the grid of half cells is linear on simplices as well.
            ShapeTable table;
            tabulate(type, 1, &shape.node_coordinates[a * dim], 1, false, table);
            std::array<double, 3> at{};
            for (int v = 0; v < shape.vertices; ++v)
              for (int i = 0; i < 3; ++i) at[i] += table.value[v] * corners[v][i];
            node({2 * x + static_cast<int>(std::lround(2 * at[0])),
                  2 * y + static_cast<int>(std::lround(2 * at[1])),
                  2 * z + static_cast<int>(std::lround(2 * at[2]))});
            data->cells.push_back(node({2 * x + static_cast<int>(std::lround(2 * at[0])),
                                        2 * y + static_cast<int>(std::lround(2 * at[1])),
                                        2 * z + static_cast<int>(std::lround(2 * at[2]))}));
          }
  return {"grid", data, Communicator()};
}

Surface polygon(const std::vector<Point>& points) {
  Surface s = empty_surface(2);
  const int n = static_cast<int>(points.size());
  for (int k = 0; k < n; ++k) {
    s.points.insert(s.points.end(), {points[k][0], points[k][1]});
    s.facets.insert(s.facets.end(), {k, (k + 1) % n});
  }
  return s;
}

Surface circle(Point centre, double radius, int facets, double phase) {
  std::vector<Point> points;
  for (int k = 0; k < facets; ++k) {
    const double t = phase + 2 * std::numbers::pi * k / facets;
    points.push_back({centre[0] + radius * std::cos(t), centre[1] + radius * std::sin(t), 0});
  }
  return polygon(points);
}

Surface star(std::mt19937& random, Point centre, double radius, int facets) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Point> points;
  const double phase = 2 * std::numbers::pi * unit(random);
  for (int k = 0; k < facets; ++k) {
    const double t = phase + 2 * std::numbers::pi * k / facets, r = radius * (0.3 + 0.7 * unit(random));
    points.push_back({centre[0] + r * std::cos(t), centre[1] + r * std::sin(t), 0});
  }
  return polygon(points);
}

Surface box(Point low, Point high) {
  Surface s = empty_surface(3);
  for (int k = 0; k < 8; ++k)
    for (int i = 0; i < 3; ++i) s.points.push_back((k >> i & 1) != 0 ? high[i] : low[i]);
  add_quadrilateral(s, 0, 4, 6, 2);
  add_quadrilateral(s, 1, 3, 7, 5);
  add_quadrilateral(s, 0, 1, 5, 4);
  add_quadrilateral(s, 2, 6, 7, 3);
  add_quadrilateral(s, 0, 2, 3, 1);
  add_quadrilateral(s, 4, 5, 7, 6);
  return s;
}

Surface sphere(Point centre, double radius, int refinements) {
  Surface s = empty_surface(3);
  s.points = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
  s.facets = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  for (int r = 0; r < refinements; ++r) {
    std::map<std::pair<int, int>, int> middle;
    const auto split = [&](int a, int b) {
      const auto [entry, is_new] = middle.try_emplace(std::minmax(a, b), s.point_count());
      if (is_new)
        for (int i = 0; i < 3; ++i) s.points.push_back(0.5 * (s.points[a * 3 + i] + s.points[b * 3 + i]));
      return entry->second;
    };
    std::vector<int> facets;
    for (int f = 0; f < s.facet_count(); ++f) {
      const int a = s.facets[3 * f], b = s.facets[3 * f + 1], c = s.facets[3 * f + 2];
      const int ab = split(a, b), bc = split(b, c), ca = split(c, a);
      facets.insert(facets.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    s.facets = std::move(facets);
  }
  for (int v = 0; v < s.point_count(); ++v) {
    double* x = &s.points[3 * v];
    const double scale = radius / std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (int i = 0; i < 3; ++i) x[i] = centre[i] + scale * x[i];
  }
  return s;
}

Surface moved(Surface surface, const Placement& placement) {
  for (int v = 0; v < surface.point_count(); ++v) {
    Point x{};
    double* at = &surface.points[v * surface.dimension];
    std::copy(at, at + surface.dimension, x.begin());
    x = placement(x);
    std::copy(x.begin(), x.begin() + surface.dimension, at);
  }
  return surface;
}

Surface reversed(Surface surface) {
  for (int f = 0; f < surface.facet_count(); ++f)
    std::swap(surface.facets[f * surface.dimension], surface.facets[f * surface.dimension + 1]);
  return surface;
}

Point position(const Mesh& mesh, int cell, const double* reference) {
  static ShapeTable table;
  const int dim = mesh.dimension();
  tabulate(mesh.type(), mesh.order(), reference, 1, false, table);
  Point x{};
  for (int a = 0; a < table.nodes; ++a)
    for (int i = 0; i < dim; ++i) x[i] += table.value[a] * mesh.geometry(cell)[a * dim + i];
  return x;
}

double whole_volume(const Mesh& mesh, int cell) {
  const Quadrature& rule = quadrature(mesh.type(), 6);
  const int dim = mesh.dimension();
  ShapeTable table;
  tabulate(mesh.type(), mesh.order(), rule.points.data(), rule.count(), false, table);
  double sum = 0;
  for (int q = 0; q < rule.count(); ++q) {
    double j[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int d = 0; d < dim; ++d)
      for (int i = 0; i < dim; ++i) {
        j[d][i] = 0;
        for (int a = 0; a < table.nodes; ++a)
          j[d][i] += table.gradient_at(q)[d * table.stride + a] * mesh.geometry(cell)[a * dim + i];
      }
    sum += rule.weights[q] * (j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
                              j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
                              j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]));
  }
  return sum;
}

double total_fluid(const CutMesh& cut) {
  double sum = 0;
  for (int c = 0; c < cut.mesh().cells(); ++c)
    if (cut.state(c) != CellState::body)
      sum += cut.state(c) == CellState::cut ? cut.wet_volume(c) : whole_volume(cut.mesh(), c);
  return sum;
}

double total_interface(const CutMesh& cut) {
  double sum = 0;
  for (const int c : cut.cut_cells()) sum += cut.interface_area(c);
  return sum;
}
