// SPDX-License-Identifier: BSD-3-Clause
#include "seam/interface/cell_constants.hpp"

#include <algorithm>
#include <cmath>

#include "seam/assembly/element.hpp"
#include "seam/assembly/remote_cells.hpp"
#include "seam/field/field.hpp"
#include "seam/interface/cell_constant.hpp"
#include "seam/mesh/lagrange.hpp"
#include "seam/mesh/quadrature.hpp"
#include "seam/term/tensor.hpp"

namespace seam {
namespace {

/// Displacements of the cell's nodes, [node][dimension], in the state that a policy asks for.
std::vector<double> displacements(const Block& block, const Field::ComponentRange& place,
                                  const std::vector<int>& nodes, CellConstant::Refresh policy) {
  std::vector<double> u(nodes.size() * place.components, 0.0);
  if (policy == CellConstant::Refresh::once) return u;
  const auto& values = policy == CellConstant::Refresh::step ? block.old.value : block.now.value;
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (int i = 0; i < place.components; ++i)
      u[a * place.components + i] =
          values[static_cast<std::size_t>(nodes[a]) * block.size + place.offset + i];
  return u;
}

/// Appends the element's points: gradients of shape functions and displacement.
void add_points(const Element& element, const ShapeTable& table, const std::vector<double>& u,
                CellPoints& points) {
  const int dim = element.dimension;
  const ElementSide& side = element.sides[0];
  for (int q = 0; q < element.points; ++q) {
    points.weight.push_back(element.weight[q]);
    std::vector<double> gradient(static_cast<std::size_t>(dim) * dim, 0.0);
    for (int a = 0; a < table.nodes; ++a)
      for (int j = 0; j < dim; ++j) {
        double slope = 0;
        for (int k = 0; k < dim; ++k)
          slope += side.inverse_jacobian[(static_cast<std::size_t>(q) * dim + k) * dim + j] *
                   table.gradient_at(q)[k * table.stride + a];
        points.shape_gradient.push_back(slope);
        for (int i = 0; i < dim; ++i) gradient[i * dim + j] += u[a * dim + i] * slope;
      }
    points.gradient.insert(points.gradient.end(), gradient.begin(), gradient.end());
  }
}

/// Reference normals and weights of the last points become current ones: n da = cof(F) N dA.
template <int dim>
void deform(const Element& element, CellPoints& points) {
  const std::size_t first = points.weight.size() - static_cast<std::size_t>(element.points);
  for (std::size_t q = first; q < points.weight.size(); ++q) {
    Mat<dim, dim, double> f = identity<dim>();
    Vec<dim, double> normal;
    for (int k = 0; k < dim * dim; ++k) f.c[k] += points.gradient[q * dim * dim + k];
    for (int i = 0; i < dim; ++i) normal[i] = element.normal[(q - first) * dim + i];
    normal = cofactor(f) * normal;
    const double stretch = std::sqrt(dot(normal, normal));
    points.weight[q] *= stretch;
    for (int i = 0; i < dim; ++i) points.normal.push_back(normal[i] / stretch);
  }
}

}  // namespace

int CellConstants::add(std::shared_ptr<const CellConstant> constant, int region) {
  constants_.push_back({std::move(constant), region, {}, {}});
  return count() - 1;
}

void CellConstants::forget(CellConstant::Refresh policy) {
  for (Request& entry : constants_)
    if (entry.constant->refresh() == policy) std::fill(entry.known.begin(), entry.known.end(), 0);
}

double CellConstants::value(int number, int index, const RemoteCell& cell, const std::vector<int>& faces) {
  Request& entry = constants_[number];
  if (body_->region(cell.global_cell) != entry.region) return 0;
  const auto i = static_cast<std::size_t>(index);
  if (i >= entry.known.size()) {
    entry.known.resize(i + 1, 0);
    entry.value.resize(i + 1, 0.0);
  }
  if (!entry.known[i]) {
    entry.value[i] = entry.constant->compute(trace(cell, faces, entry.constant->refresh()));
    entry.known[i] = 1;
  }
  return entry.value[i];
}

CellTrace CellConstants::trace(const RemoteCell& cell, const std::vector<int>& faces,
                               CellConstant::Refresh policy) const {
  const Block& block = body_->blocks()[place_.block];
  const CellTopology& type = topology(body_->mesh().type());
  const int dim = type.dimension, order = block.space->order();
  const std::vector<double> u = displacements(block, place_, cell.nodes[place_.block], policy);
  CellTrace result;
  result.dimension = dim;
  result.nodes = type.nodes(order);
  for (const int node : cell.nodes[place_.block])
    result.position.insert(result.position.end(), block.space->position(node),
                           block.space->position(node) + dim);
  for (std::size_t k = 0; k < u.size(); ++k) result.position[k] += u[k];
  ShapeTable table, geometry;
  Element element;
  element.dimension = dim;
  element.sides.resize(1);
  ElementSide& side = element.sides[0];
  cell.attach(side, *body_);
  const auto place_points = [&](const std::vector<double>& reference, int count) {
    tabulate(type.type, order, reference.data(), count, false, table);
    tabulate(type.type, body_->mesh().order(), reference.data(), count, false, geometry);
    side.table[body_->mesh().order() - 1] = &geometry;
    side.map_geometry();
    element.points = count;
  };
  const Quadrature& volume = quadrature(type.type, 2 * order);
  place_points(volume.points, volume.count());
  element.weight = volume.weights;
  for (int q = 0; q < volume.count(); ++q) element.weight[q] *= side.determinant[q];
  add_points(element, table, u, result.volume);

  const Quadrature& rule = quadrature(type.face_type, 2 * order);
  std::vector<double> on_face(static_cast<std::size_t>(rule.count()) * dim);
  for (const int face : faces) {
    for (int q = 0; q < rule.count(); ++q)
      face_to_cell(type, face, &rule.points[static_cast<std::size_t>(q) * (dim - 1)],
                   &on_face[static_cast<std::size_t>(q) * dim]);
    place_points(on_face, rule.count());
    element.measure_face(type, face, rule.weights);
    add_points(element, table, u, result.faces);
    if (dim == 2)
      deform<2>(element, result.faces);
    else
      deform<3>(element, result.faces);
  }
  return result;
}

}  // namespace seam
