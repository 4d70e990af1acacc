// SPDX-License-Identifier: BSD-3-Clause
#include "seam/assembly/domains.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "seam/base/diagnostics.hpp"

namespace seam {
namespace {

/// Orders whose shape functions an element of this field needs.
bool uses_order(const Field& field, int order) {
  if (field.mesh().order() == order) return true;
  for (const Block& block : field.blocks())
    if (block.space->order() == order) return true;
  return false;
}

}  // namespace

void attach_cell(ElementSide& side, const Field& field, int cell) {
  side.field = &field;
  side.global_cell = field.mesh().global_cell(cell);
  side.geometry = field.mesh().geometry(cell);
  side.diameter = field.mesh().diameter(cell);
  side.nodes.resize(field.blocks().size());
  for (std::size_t b = 0; b < side.nodes.size(); ++b)
    side.nodes[b] = field.blocks()[b].space->cell_nodes(cell);
}

CellDomain::CellDomain(Field& field, int degree)
    : field_(&field), rule_(&quadrature(field.mesh().type(), degree)) {
  cells_.resize(field.mesh().owned_cells());
  std::iota(cells_.begin(), cells_.end(), 0);
  for (int order = 1; order <= 2; ++order)
    if (uses_order(field, order))
      tabulate(field.mesh().type(), order, rule_->points.data(), rule_->count(), false, tables_[order - 1]);
}

void CellDomain::fill(int index, Element& element) const {
  element.dimension = field_->mesh().dimension();
  element.points = rule_->count();
  element.sides.resize(1);
  ElementSide& side = element.sides[0];
  attach_cell(side, *field_, cells_[index]);
  for (int order = 1; order <= 2; ++order)
    side.table[order - 1] = tables_[order - 1].points > 0 ? &tables_[order - 1] : nullptr;
  side.map_geometry();
  element.weight.resize(element.points);
  for (int q = 0; q < element.points; ++q) element.weight[q] = rule_->weights[q] * side.determinant[q];
  element.normal.clear();
  element.cell_size.assign(element.points, side.diameter);
}

const int* CellDomain::nodes(int index, int, int block) const {
  return field_->blocks()[block].space->cell_nodes(cells_[index]);
}

void CellDomain::restrict_to(const Field& field, const std::vector<char>& active) {
  if (&field != field_) return;
  cells_.clear();
  for (int c = 0; c < field.mesh().owned_cells(); ++c)
    if (active[c]) cells_.push_back(c);
}

std::string CellDomain::description() const { return fmt::format("cells of field '{}'", field_->name()); }

FaceTables::FaceTables(const Field& field, int degree, bool with_hessian) {
  const CellTopology& cell = topology(field.mesh().type());
  rule_ = &quadrature(cell.face_type, degree);
  std::vector<double> points(static_cast<std::size_t>(rule_->count()) * cell.dimension);
  for (int f = 0; f < static_cast<int>(cell.faces.size()); ++f) {
    for (int q = 0; q < rule_->count(); ++q)
      face_to_cell(cell, f, &rule_->points[static_cast<std::size_t>(q) * (cell.dimension - 1)],
                   &points[static_cast<std::size_t>(q) * cell.dimension]);
    for (int order = 1; order <= 2; ++order)
      if (uses_order(field, order))
        tabulate(cell.type, order, points.data(), rule_->count(), with_hessian,
                 tables_[order - 1].emplace_back());
  }
}

void FaceTables::attach(ElementSide& side) const {
  for (int o = 0; o < 2; ++o) side.table[o] = tables_[o].empty() ? nullptr : &tables_[o][side.face];
}

BoundaryDomain::BoundaryDomain(Field& field, const std::string& boundary, int degree)
    : field_(&field), boundary_(boundary), tables_(field, degree, false) {
  for (const CellFace& face : field.mesh().boundary(boundary))
    if (face.cell < field.mesh().owned_cells()) all_faces_.push_back(face);
  faces_ = all_faces_;
}

void BoundaryDomain::restrict_to(const Field& field, const std::vector<char>& active) {
  if (&field != field_) return;
  faces_.clear();
  for (const CellFace& face : all_faces_)
    if (active[face.cell]) faces_.push_back(face);
}

void BoundaryDomain::fill(int index, Element& element) const {
  element.dimension = field_->mesh().dimension();
  element.points = tables_.rule().count();
  element.sides.resize(1);
  ElementSide& side = element.sides[0];
  attach_cell(side, *field_, faces_[index].cell);
  side.face = faces_[index].face;
  tables_.attach(side);
  side.map_geometry();
  element.measure_face(topology(field_->mesh().type()), side.face, tables_.rule());
  element.cell_size.assign(element.points, side.diameter);
}

const int* BoundaryDomain::nodes(int index, int, int block) const {
  return field_->blocks()[block].space->cell_nodes(faces_[index].cell);
}

std::string BoundaryDomain::description() const {
  return fmt::format("boundary '{}' of field '{}'", boundary_, field_->name());
}

InteriorFaceDomain::InteriorFaceDomain(Field& field, int degree)
    : field_(&field), faces_(field.mesh().interior_faces()), tables_(field, degree, true) {}

void InteriorFaceDomain::fill(int index, Element& element) const {
  const Mesh& mesh = field_->mesh();
  const int dim = mesh.dimension();
  element.dimension = dim;
  element.points = tables_.rule().count();
  element.sides.resize(2);
  for (int s = 0; s < 2; ++s) {
    attach_cell(element.sides[s], *field_, faces_[index].side[s].cell);
    element.sides[s].face = faces_[index].side[s].face;
  }
  ElementSide &first = element.sides[0], &second = element.sides[1];
  tables_.attach(first);
  first.map_geometry();
  element.measure_face(topology(mesh.type()), first.face, tables_.rule());

  // The partner sees the same points in an orientation of its own: find them by inverting its map.
  std::vector<double> reference(static_cast<std::size_t>(element.points) * dim);
  tables_.attach(second);
  const CellTopology& cell = topology(mesh.type());
  for (int q = 0; q < element.points; ++q) {
    double* guess = &reference[static_cast<std::size_t>(q) * dim];
    face_to_cell(cell, second.face, &tables_.rule().points[static_cast<std::size_t>(q) * (dim - 1)], guess);
    invert_map(second, &first.position[static_cast<std::size_t>(q) * dim], guess);
  }
  for (int o = 0; o < 2; ++o) {
    if (!second.table[o]) continue;
    tabulate(mesh.type(), o + 1, reference.data(), element.points, true, partner_[o]);
    second.table[o] = &partner_[o];
  }
  second.map_geometry();
  element.cell_size.assign(element.points, std::max(first.diameter, second.diameter));
}

const int* InteriorFaceDomain::nodes(int index, int side, int block) const {
  return field_->blocks()[block].space->cell_nodes(faces_[index].side[side].cell);
}

void InteriorFaceDomain::restrict_to(const Field& field, const std::vector<char>& active) {
  if (&field != field_) return;
  faces_.clear();
  for (const Mesh::InteriorFace& face : field.mesh().interior_faces())
    if (active[face.side[0].cell] && active[face.side[1].cell]) faces_.push_back(face);
}

std::string InteriorFaceDomain::description() const {
  return fmt::format("interior faces of field '{}'", field_->name());
}

void invert_map(const ElementSide& side, const double* position, double* guess) {
  const Mesh& mesh = side.field->mesh();
  const int dim = mesh.dimension();
  static thread_local ElementSide probe;
  static thread_local ShapeTable table;
  probe.field = side.field;
  probe.global_cell = side.global_cell;
  probe.geometry = side.geometry;
  double last = 1e300;
  for (int iteration = 0; iteration < 30; ++iteration) {
    tabulate(mesh.type(), mesh.order(), guess, 1, false, table);
    probe.table[mesh.order() - 1] = &table;
    probe.map_geometry();
    double step = 0;
    for (int j = 0; j < dim; ++j) {
      double update = 0;
      for (int i = 0; i < dim; ++i)
        update += probe.inverse_jacobian[j * dim + i] * (position[i] - probe.position[i]);
      guess[j] += update;
      step = std::max(step, std::abs(update));
    }
    // Far from the origin the positions' rounding, not Newton's method, limits the step.
    if (step < 1e-14 || (step < 1e-6 && step > 0.1 * last)) return;
    last = step;
  }
  throw Error(fmt::format("no reference coordinates found for a point on a face of cell {} of mesh '{}'",
                          side.global_cell, mesh.name()));
}

}  // namespace seam
