// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "seam/assembly/domains.hpp"
#include "seam/cut/cut_mesh.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/quadrature.hpp"

namespace seam {

bool uses_order(const Field& field, int order) {
  if (field.mesh().order() == order) return true;
  for (const Block& block : field.blocks())
    if (block.space->order() == order) return true;
  return false;
}

void CutPoints::attach(ElementSide& side, bool with_hessian) const {
  for (int order = 1; order <= 2; ++order) {
    std::unique_ptr<ShapeTable>& table = side.own_table[order - 1];
    side.table[order - 1] = nullptr;
    if (!uses_order(*side.field, order)) continue;
    if (!table) table = std::make_unique<ShapeTable>();
    tabulate(side.field->mesh().type(), order, reference.data(), static_cast<int>(weight.size()),
             with_hessian, *table);
    side.table[order - 1] = table.get();
  }
}

CellDomain::CellDomain(Field& field, int degree, Cells cells)
    : field_(&field), degree_(degree), cells_(cells), rule_(&quadrature(field.mesh().type(), degree)) {
  for (int order = 1; order <= 2; ++order)
    if (uses_order(field, order))
      tabulate(field.mesh().type(), order, rule_->points.data(), rule_->count(), false, tables_[order - 1]);
  CellDomain::update(field);
}

void CellDomain::update(const Field& field) {
  if (&field != field_) return;
  whole_.clear();
  cut_.clear();
  CutRule rule;
  for (int c = 0; c < field.mesh().owned_cells(); ++c) {
    if (!field.active_cells()[c]) continue;
    if (!field.is_cut(c)) {
      whole_.push_back(c);
    } else if (cells_ == Cells::all) {
      for (int p = 0; p < field.parts(c); ++p) {
        field.cut()->volume_rule(c, degree_, rule, p);
        if (rule.count() == 0) continue;
        CutPoints& part = cut_.emplace_back();
        part.cell = c;
        part.part = p;
        part.weight = rule.weight;
        part.reference = rule.reference;
      }
    }
  }
}

void CellDomain::fill(int index, Element& element) const {
  const int whole = static_cast<int>(whole_.size());
  element.dimension = field_->mesh().dimension();
  element.sides.resize(1);
  ElementSide& side = element.sides[0];
  if (index < whole) {
    attach_cell(side, *field_, whole_[index]);
    element.points = rule_->count();
    for (int o = 0; o < 2; ++o) side.table[o] = tables_[o].points > 0 ? &tables_[o] : nullptr;
    side.map_geometry();
    element.weight.resize(element.points);
    for (int q = 0; q < element.points; ++q) element.weight[q] = rule_->weights[q] * side.determinant[q];
  } else {
    const CutPoints& part = cut_[index - whole];
    element.points = static_cast<int>(part.weight.size());
    attach_cell(side, *field_, part.cell, part.part);
    part.attach(side, false);
    side.map_geometry();
    element.weight = part.weight;
  }
  element.normal.clear();
  element.set_sizes(side.diameter, side.diameter);
}

const int* CellDomain::nodes(int index, int, int block) const {
  const int whole = static_cast<int>(whole_.size());
  if (index < whole) return field_->cell_nodes(block, whole_[index]);
  return field_->cell_nodes(block, cut_[index - whole].cell, cut_[index - whole].part);
}

std::string CellDomain::description() const { return fmt::format("cells of field '{}'", field_->name()); }

}  // namespace seam
