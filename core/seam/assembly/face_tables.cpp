// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "seam/assembly/domains.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/quadrature.hpp"

namespace seam {
namespace {

/// Which vertex of the second cell's face is the first cell's a-th.
int partner_vertex(int orientation, int vertices, int a) {
  const int first = orientation / 2;
  return (orientation % 2 == 0 ? first + a : first - a + vertices) % vertices;
}

}  // namespace

FaceTables::FaceTables(const Field& field, int degree, bool with_hessian) : type_(field.mesh().type()) {
  const CellTopology& cell = topology(type_);
  rule_ = &quadrature(cell.face_type, degree);
  std::vector<double> points(static_cast<std::size_t>(rule_->count()) * cell.dimension);
  for (int f = 0; f < static_cast<int>(cell.faces.size()); ++f) {
    for (int q = 0; q < rule_->count(); ++q)
      face_to_cell(cell, f, &rule_->points[static_cast<std::size_t>(q) * (cell.dimension - 1)],
                   &points[static_cast<std::size_t>(q) * cell.dimension]);
    for (int order = 1; order <= 2; ++order)
      if (uses_order(field, order))
        tabulate(type_, order, points.data(), rule_->count(), with_hessian,
                 tables_[order - 1].emplace_back());
  }
  tabulate_partners(field, with_hessian);
}

void FaceTables::tabulate_partners(const Field& field, bool with_hessian) {
  const CellTopology& cell = topology(type_);
  const int dim = cell.dimension;
  // Reference faces map onto each other linearly: the vertices' shape functions carry the points over.
  ShapeTable corners;
  tabulate(cell.face_type, 1, rule_->points.data(), rule_->count(), false, corners);
  std::vector<double> points(static_cast<std::size_t>(rule_->count()) * dim);
  for (auto& partners : partners_) partners.resize(cell.faces.size());
  for (std::size_t f = 0; f < cell.faces.size(); ++f) {
    const int vertices = static_cast<int>(cell.faces[f].size());
    for (int orientation = 0; orientation < 2 * vertices; ++orientation) {
      std::fill(points.begin(), points.end(), 0.0);
      for (int q = 0; q < rule_->count(); ++q)
        for (int a = 0; a < vertices; ++a) {
          const int vertex = cell.faces[f][partner_vertex(orientation, vertices, a)];
          for (int d = 0; d < dim; ++d)
            points[static_cast<std::size_t>(q) * dim + d] +=
                corners.value_at(q)[a] * cell.node_coordinates[static_cast<std::size_t>(vertex) * dim + d];
        }
      for (int order = 1; order <= 2; ++order)
        if (uses_order(field, order))
          tabulate(type_, order, points.data(), rule_->count(), with_hessian,
                   partners_[order - 1][f].emplace_back());
    }
  }
}

int FaceTables::orientation(const CellTopology& cell, const int* first, int first_face, const int* second,
                            int second_face) {
  const auto& own = cell.faces[first_face];
  const auto& other = cell.faces[second_face];
  const int vertices = static_cast<int>(own.size());
  const auto place_of = [&](int vertex) {
    int k = 0;
    while (k + 1 < vertices && second[other[k]] != first[vertex]) ++k;
    return k;
  };
  const int start = place_of(own[0]);
  return 2 * start + (place_of(own[1]) == (start + 1) % vertices ? 0 : 1);
}

void FaceTables::attach(ElementSide& side) const {
  for (int o = 0; o < 2; ++o) side.table[o] = tables_[o].empty() ? nullptr : &tables_[o][side.face];
}

void FaceTables::attach_partner(ElementSide& side, int orientation) const {
  for (int o = 0; o < 2; ++o)
    side.table[o] = tables_[o].empty() ? nullptr : &partners_[o][side.face][orientation];
}

}  // namespace seam
