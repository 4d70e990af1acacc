// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/cut_boundary.hpp"

#include <fmt/format.h>

#include <map>

#include "seam/cut/interface_motion.hpp"

namespace seam {

CutBoundary::CutBoundary(Field& field, const FieldCut& cut, int body, int degree)
    : field_(&field), cut_(&cut), body_(body), degree_(degree) {}

// In space two directions count: that is exact for all products of one function with a linear one, at 6
// points a piece, not 16.
int facet_degree(const InterfaceSetup& setup, int side) {
  const CellType type = setup.sides[side]->mesh().type();
  const bool tensor = type == CellType::quadrilateral || type == CellType::hexahedron;
  return (tensor ? 2 : 1) * setup.degree + setup.extra_degree;
}

void CutBoundary::update(const Field& field) {
  if (&field != field_) return;
  groups_.clear();
  if (!field.cut()) return;
  InterfaceRule rule;
  InterfaceMotion motion;
  for (const int cell : field.cut()->cut_cells()) {
    if (cell >= field.mesh().owned_cells() || !field.active_cells()[cell]) continue;
    for (int part = 0; part < field.parts(cell); ++part) {
      field.cut()->interface_rule(cell, degree_, rule, !movers().empty() ? &motion : nullptr, part);
      add_groups(cell, part, rule, motion);
    }
  }
}

void CutBoundary::add_groups(int cell, int part, const InterfaceRule& rule, const InterfaceMotion& motion) {
  const auto dim = static_cast<std::size_t>(field_->mesh().dimension());
  std::map<int, std::vector<int>> points;  // by group
  for (int q = 0; q < rule.count(); ++q)
    if (rule.body[q] == body_) points[group(rule.facet[q])].push_back(q);
  for (const auto& [group, of_group] : points) {
    PointGroup& piece = groups_.emplace_back();
    piece.cell = cell;
    piece.part = part;
    piece.group = group;
    piece.trace_size = cut_->trace_size(cell);
    for (const int q : of_group) {
      piece.weight.push_back(rule.weight[q]);
      const std::size_t at = static_cast<std::size_t>(q) * dim;
      for (std::size_t d = 0; d < dim; ++d) {
        piece.reference.push_back(rule.reference[at + d]);
        piece.normal.push_back(rule.normal[at + d]);
      }
    }
    add_partner(piece, rule, motion, of_group);
  }
}

void CutBoundary::fill(int index, Element& element) const {
  const PointGroup& piece = groups_[index];
  element.dimension = field_->mesh().dimension();
  element.points = static_cast<int>(piece.weight.size());
  if (element.sides.empty()) element.sides.resize(1);
  ElementSide& side = element.sides[0];
  attach_cell(side, *field_, piece.cell, piece.part);
  piece.attach(side, true);
  side.map_geometry();
  element.weight = piece.weight;
  element.normal = piece.normal;
  element.set_sizes(side.diameter, piece.trace_size);
  element.motion = !movers().empty() ? &piece.motion : nullptr;
}

const int* CutBoundary::nodes(int index, int, int block) const {
  return field_->cell_nodes(block, groups_[index].cell, groups_[index].part);
}

std::string CutBoundary::description() const {
  return fmt::format("the boundary of a body in field '{}'", field_->name());
}

}  // namespace seam
