// SPDX-License-Identifier: BSD-3-Clause
#include "seam/assembly/element.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "seam/base/diagnostics.hpp"
#include "seam/field/field.hpp"
#include "seam/interface/cell_constant.hpp"
#include "seam/mesh/mesh.hpp"
#include "seam/term/tensor.hpp"

namespace seam {
namespace {

template <int dim>
void map_points(ElementSide& side, const ShapeTable& table) {
  for (int q = 0; q < table.points; ++q) {
    const double* value = table.value_at(q);
    const double* gradient = table.gradient_at(q);
    Mat<dim, dim, double> jacobian;  // dx_i / dxi_j
    double* position = &side.position[static_cast<std::size_t>(q) * dim];
    for (int i = 0; i < dim; ++i) position[i] = 0;
    for (int a = 0; a < table.nodes; ++a)
      for (int i = 0; i < dim; ++i) {
        const double x = side.geometry[a * dim + i];
        position[i] += value[a] * x;
        for (int j = 0; j < dim; ++j) jacobian(i, j) += gradient[j * table.stride + a] * x;
      }
    const auto cof = cofactor(jacobian);
    const double det = determinant(jacobian, cof);
    if (!(det > 0))
      throw Error(
          fmt::format("cell {} of field '{}' is turned inside out: Jacobian {:.3g} at a quadrature point",
                      side.global_cell, side.field->name(), det));
    side.determinant[q] = det;
    for (int j = 0; j < dim; ++j)
      for (int i = 0; i < dim; ++i)
        side.inverse_jacobian[static_cast<std::size_t>(q) * dim * dim + j * dim + i] = cof(i, j) / det;
  }
}

}  // namespace

void ElementSide::map_geometry() {
  const Mesh& mesh = field->mesh();
  const ShapeTable& shapes = *table[mesh.order() - 1];
  const int dim = mesh.dimension();
  position.resize(static_cast<std::size_t>(shapes.points) * dim);
  inverse_jacobian.resize(position.size() * dim);
  determinant.resize(shapes.points);
  if (mesh.type() == CellType::point) {
    determinant.assign(shapes.points, 1.0);
    position.assign(geometry, geometry + dim);
  } else if (dim == 2) {
    map_points<2>(*this, shapes);
  } else {
    map_points<3>(*this, shapes);
  }
}

void Element::measure_face(const CellTopology& cell, int face, const std::vector<double>& weights) {
  const int dim = dimension;
  // Area vector of the reference face: its edges' cross product (2D: the edge turned by -90 degrees).
  double edge[2][3] = {{0, 0, 0}, {0, 0, 0}}, area[3] = {0, 0, 0};
  const auto& vertices = cell.faces[face];
  const int last = static_cast<int>(vertices.size()) - 1;
  for (int d = 0; d < dim; ++d) {
    const auto x = [&](int a) {
      return cell.node_coordinates[static_cast<std::size_t>(vertices[a]) * dim + d];
    };
    edge[0][d] = x(1) - x(0);
    edge[1][d] = x(last) - x(0);
  }
  if (dim == 2) {
    area[0] = edge[0][1];
    area[1] = -edge[0][0];
  } else {
    for (int d = 0; d < 3; ++d)
      area[d] = edge[0][(d + 1) % 3] * edge[1][(d + 2) % 3] - edge[0][(d + 2) % 3] * edge[1][(d + 1) % 3];
  }
  // Nanson: n da = det(J) J^-T N dA.
  const ElementSide& side = sides[0];
  weight.resize(points);
  normal.resize(static_cast<std::size_t>(points) * dim);
  for (int q = 0; q < points; ++q) {
    double length = 0;
    for (int i = 0; i < dim; ++i) {
      double component = 0;
      for (int j = 0; j < dim; ++j)
        component += side.inverse_jacobian[(static_cast<std::size_t>(q) * dim + j) * dim + i] * area[j];
      normal[static_cast<std::size_t>(q) * dim + i] = component * side.determinant[q];
      length += std::pow(component * side.determinant[q], 2);
    }
    length = std::sqrt(length);
    for (int i = 0; i < dim; ++i) normal[static_cast<std::size_t>(q) * dim + i] /= length;
    weight[q] = weights[q] * length;
  }
}

const std::vector<Operand>& IntegrationDomain::movers() const {
  static const std::vector<Operand> none;
  return none;
}

// Overrides keep what they are given.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
int IntegrationDomain::add_constant(int, std::shared_ptr<const CellConstant>, int) {
  throw Error("a coupling needs constants of the body's cells, which " + description() +
              " do not keep; use an interface of type embedded or contact");
}

double Element::measure() const { return std::accumulate(weight.begin(), weight.end(), 0.0); }

void Element::set_sizes(double cell, double trace) {
  cell_size.assign(points, cell);
  trace_size.assign(points, trace);
}

}  // namespace seam
