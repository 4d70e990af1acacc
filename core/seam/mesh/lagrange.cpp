// SPDX-License-Identifier: BSD-3-Clause
#include "seam/mesh/lagrange.hpp"

#include <array>
#include <cmath>
#include <map>

#include "seam/mesh/quadrature.hpp"
#include "seam/term/tensor.hpp"

namespace seam {
namespace {

/// Value, first and second derivative of a polynomial at one coordinate.
using Jet = std::array<double, 3>;

/// One-dimensional Lagrange functions on [0,1]; for order 2 the nodes are 0, 1, 1/2.
Jet line_function(int order, int node, double x) {
  if (order == 1) return node == 0 ? Jet{1 - x, -1, 0} : Jet{x, 1, 0};
  if (node == 0) return {(1 - x) * (1 - 2 * x), 4 * x - 3, 4};
  if (node == 1) return {x * (2 * x - 1), 4 * x - 1, 4};
  return {4 * x * (1 - x), 4 - 8 * x, -8};
}

/// Which one-dimensional node a node of a tensor cell uses in a direction, read off its coordinate.
int line_node(double coordinate) { return coordinate < 0.25 ? 0 : coordinate > 0.75 ? 1 : 2; }

struct Sink {
  ShapeTable& table;
  int q;
  bool with_hessian;
  void put(int a, double value) const { table.value[static_cast<std::size_t>(q) * table.stride + a] = value; }
  void put(int a, int i, double value) const {
    table.gradient[(static_cast<std::size_t>(q) * table.dimension + i) * table.stride + a] = value;
  }
  void put(int a, int i, int j, double value) const {
    if (!with_hessian) return;
    const std::size_t row = (static_cast<std::size_t>(q) * table.dimension + i) * table.dimension + j;
    table.hessian[row * table.stride + a] = value;
  }
};

void tensor_shapes(const CellTopology& cell, int order, const double* x, const Sink& sink) {
  const int dim = cell.dimension;
  for (int a = 0; a < sink.table.nodes; ++a) {
    std::array<Jet, 3> jet{};
    for (int d = 0; d < dim; ++d)
      jet[d] =
          line_function(order, line_node(cell.node_coordinates[static_cast<std::size_t>(a) * dim + d]), x[d]);
    // The derivative of order k[d] in each direction is the product of the one-dimensional ones.
    const auto product = [&](const std::array<int, 3>& k) {
      double value = 1.0;
      for (int d = 0; d < dim; ++d) value *= jet[d][k[d]];
      return value;
    };
    sink.put(a, product({0, 0, 0}));
    for (int i = 0; i < dim; ++i) {
      std::array<int, 3> k{};
      ++k[i];
      sink.put(a, i, product(k));
      for (int j = 0; j < dim; ++j) {
        auto second = k;
        ++second[j];
        sink.put(a, i, j, product(second));
      }
    }
  }
}

void simplex_shapes(const CellTopology& cell, int order, const double* x, const Sink& sink) {
  const int dim = cell.dimension;
  std::array<double, 4> lambda{1, 0, 0, 0};
  for (int d = 0; d < dim; ++d) {
    lambda[d + 1] = x[d];
    lambda[0] -= x[d];
  }
  const auto slope = [](int vertex, int direction) {
    return vertex == 0 ? -1.0 : vertex == direction + 1 ? 1.0 : 0.0;
  };
  for (int v = 0; v <= dim; ++v) {
    const double l = lambda[v];
    sink.put(v, order == 1 ? l : l * (2 * l - 1));
    for (int i = 0; i < dim; ++i) {
      sink.put(v, i, (order == 1 ? 1 : 4 * l - 1) * slope(v, i));
      for (int j = 0; j < dim; ++j) sink.put(v, i, j, order == 1 ? 0 : 4 * slope(v, i) * slope(v, j));
    }
  }
  if (order == 1) return;
  for (int e = 0; e < static_cast<int>(cell.edges.size()); ++e) {
    const auto [v, w] = cell.edges[e];
    const int a = dim + 1 + e;
    sink.put(a, 4 * lambda[v] * lambda[w]);
    for (int i = 0; i < dim; ++i) {
      sink.put(a, i, 4 * (lambda[v] * slope(w, i) + lambda[w] * slope(v, i)));
      for (int j = 0; j < dim; ++j)
        sink.put(a, i, j, 4 * (slope(v, j) * slope(w, i) + slope(w, j) * slope(v, i)));
    }
  }
}

}  // namespace

void tabulate(CellType type, int order, const double* points, int count, bool with_hessian,
              ShapeTable& table) {
  const CellTopology& cell = topology(type);
  const int dim = cell.dimension;
  table.dimension = dim;
  table.nodes = cell.nodes(order);
  table.points = count;
  table.stride = (table.nodes + 3) / 4 * 4;
  table.value.assign(static_cast<std::size_t>(count) * table.stride, 0.0);
  table.gradient.assign(table.value.size() * dim, 0.0);
  table.hessian.assign(with_hessian ? table.gradient.size() * dim : 0, 0.0);
  const bool simplex = is_simplex(type);
  for (int q = 0; q < count; ++q) {
    const Sink sink{table, q, with_hessian};
    const double* x = points + static_cast<std::size_t>(q) * dim;
    if (type == CellType::point)
      sink.put(0, 1.0);
    else if (simplex)
      simplex_shapes(cell, order, x, sink);
    else
      tensor_shapes(cell, order, x, sink);
  }
}

void face_to_cell(const CellTopology& cell, int face, const double* on_face, double* in_cell) {
  static thread_local ShapeTable shapes;
  tabulate(cell.face_type, 1, on_face, 1, false, shapes);
  for (int d = 0; d < cell.dimension; ++d) {
    in_cell[d] = 0;
    for (int a = 0; a < shapes.nodes; ++a)
      in_cell[d] += shapes.value[a] *
                    cell.node_coordinates[static_cast<std::size_t>(cell.faces[face][a]) * cell.dimension + d];
  }
}

namespace {

template <int dim>
double integrate_jacobian(const Quadrature& rule, const ShapeTable& table, const double* nodes) {
  double volume = 0;
  for (int q = 0; q < table.points; ++q) {
    Mat<dim, dim, double> jacobian;
    for (int a = 0; a < table.nodes; ++a)
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          jacobian(i, j) += table.gradient_at(q)[j * table.stride + a] * nodes[a * dim + i];
    volume += rule.weights[q] * determinant(jacobian);
  }
  return volume;
}

/// Shape functions at the points of a rule that integrates the Jacobian of a cell exactly.
const ShapeTable& jacobian_table(CellType type, int order) {
  static thread_local std::map<std::pair<CellType, int>, ShapeTable> tables;
  ShapeTable& table = tables[{type, order}];
  const Quadrature& rule = quadrature(type, 3 * order);
  if (table.points == 0) tabulate(type, order, rule.points.data(), rule.count(), false, table);
  return table;
}

}  // namespace

double cell_volume(CellType type, int order, const double* nodes) {
  if (type == CellType::point) return 0;
  const Quadrature& rule = quadrature(type, 3 * order);
  const ShapeTable& table = jacobian_table(type, order);
  return table.dimension == 2 ? integrate_jacobian<2>(rule, table, nodes)
                              : integrate_jacobian<3>(rule, table, nodes);
}

}  // namespace seam
