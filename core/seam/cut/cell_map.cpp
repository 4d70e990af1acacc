// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/cell_map.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "seam/base/diagnostics.hpp"
#include "seam/mesh/lagrange.hpp"

namespace seam::cutting {

double invert(const std::array<Vector, 3>& columns, std::array<Vector, 3>& rows) {
  const double determinant = dot(columns[0], cross(columns[1], columns[2]));
  for (int i = 0; i < 3; ++i) rows[i] = 1 / determinant * cross(columns[(i + 1) % 3], columns[(i + 2) % 3]);
  return determinant;
}

CellMap::CellMap(const Mesh& mesh, int cell) : mesh_(&mesh), cell_(cell) { find_affine_map(); }

void CellMap::find_affine_map() {
  const CellTopology& shape = topology(mesh_->type());
  const int dim = mesh_->dimension();
  const double* x = mesh_->geometry(cell_);
  // The vertices one step from vertex 0 along each reference direction.
  const std::array<int, 3> corner = is_simplex(mesh_->type()) ? std::array{1, 2, 3} : std::array{1, 3, 4};
  column_ = {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};
  double largest = 0;
  for (int i = 0; i < dim; ++i) origin_[i] = x[i];
  for (int d = 0; d < dim; ++d)
    for (int i = 0; i < dim; ++i) column_[d][i] = x[corner[d] * dim + i] - x[i];
  determinant_ = invert(column_, inverse_);
  double off = 0;
  for (int a = 0; a < mesh_->geometry_nodes(); ++a)
    for (int i = 0; i < dim; ++i) {
      double value = origin_[i];
      for (int d = 0; d < dim; ++d) value += column_[d][i] * shape.node_coordinates[a * dim + d];
      off = std::max(off, std::abs(value - x[a * dim + i]));
      largest = std::max(largest, std::abs(x[a * dim + i]));
    }
  // Rounding of the coordinates does not make a cell curved.
  affine_ = off <= 16 * std::numeric_limits<double>::epsilon() * largest;
}

Vector CellMap::difference_to_reference(const Vector& d) const {
  return {dot(inverse_[0], d), dot(inverse_[1], d), dot(inverse_[2], d)};
}

Vector CellMap::to_reference(const Vector& position) const {
  const Vector guess = difference_to_reference(position - origin_);
  return affine_ ? guess : newton(position, guess);
}

Vector CellMap::to_space(const Vector& reference) const {
  if (affine_)
    return origin_ + reference[0] * column_[0] + reference[1] * column_[1] + reference[2] * column_[2];
  static thread_local ShapeTable shapes;
  const int dim = mesh_->dimension();
  tabulate(mesh_->type(), mesh_->order(), reference.data(), 1, false, shapes);
  Vector position{};
  for (int a = 0; a < shapes.nodes; ++a)
    for (int i = 0; i < dim; ++i) position[i] += shapes.value[a] * mesh_->geometry(cell_)[a * dim + i];
  return position;
}

CellMap CellMap::linearised() const {
  if (affine_) return *this;
  static thread_local ShapeTable shapes;
  const int dim = mesh_->dimension();
  const double* x = mesh_->geometry(cell_);
  const std::vector<double> middle(3, topology(mesh_->type()).vertices == dim + 1 ? 1.0 / (dim + 1) : 0.5);
  tabulate(mesh_->type(), mesh_->order(), middle.data(), 1, false, shapes);
  CellMap result = *this;
  result.affine_ = true;
  for (int i = 0; i < dim; ++i) {
    result.origin_[i] = 0;
    for (int a = 0; a < shapes.nodes; ++a) result.origin_[i] += shapes.value[a] * x[a * dim + i];
    for (int d = 0; d < dim; ++d) {
      double& slope = result.column_[d][i] = 0;
      for (int a = 0; a < shapes.nodes; ++a) slope += shapes.gradient[d * shapes.stride + a] * x[a * dim + i];
      result.origin_[i] -= middle[d] * slope;
    }
  }
  result.determinant_ = invert(result.column_, result.inverse_);
  return result;
}

Vector CellMap::newton(const Vector& position, Vector guess) const {
  static thread_local ShapeTable shapes;
  const int dim = mesh_->dimension();
  const double* x = mesh_->geometry(cell_);
  double last = std::numeric_limits<double>::max();
  for (int iteration = 0; iteration < 50; ++iteration) {
    tabulate(mesh_->type(), mesh_->order(), guess.data(), 1, false, shapes);
    Vector residual = position;
    std::array<Vector, 3> columns{Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}}, rows;
    for (int i = 0; i < dim; ++i) {
      for (int a = 0; a < shapes.nodes; ++a) residual[i] -= shapes.value[a] * x[a * dim + i];
      for (int d = 0; d < dim; ++d) {
        columns[d][i] = 0;
        for (int a = 0; a < shapes.nodes; ++a)
          columns[d][i] += shapes.gradient[d * shapes.stride + a] * x[a * dim + i];
      }
    }
    invert(columns, rows);
    double step = 0;
    for (int d = 0; d < dim; ++d) {
      const double update = dot(rows[d], residual);
      guess[d] += update;
      step = std::max(step, std::abs(update));
    }
    // Far from the origin the rounding of positions, not Newton's method, limits the step.
    if (step < 1e-14 || (step < 1e-6 && step > 0.1 * last)) return guess;
    last = step;
  }
  throw Error(
      fmt::format("cell {} of mesh '{}': a point of the cut at ({}) has no reference coordinates; the "
                  "cell is too distorted, refine or smooth the mesh there",
                  mesh_->global_cell(cell_), mesh_->name(), fmt::join(position, ", ")));
}

}  // namespace seam::cutting
