// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "seam/assembly/domains.hpp"
#include "seam/cut/cut_mesh.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/quadrature.hpp"

namespace seam {

BoundaryDomain::BoundaryDomain(Field& field, const std::string& boundary, int degree)
    : field_(&field), boundary_(boundary), degree_(degree), tables_(field, degree, true) {
  BoundaryDomain::update(field);
}

void BoundaryDomain::leave_out(const std::vector<std::string>& boundaries) {
  const Mesh& mesh = field_->mesh();
  const auto add = [&](const std::vector<CellFace>& faces) {
    for (const CellFace& face : faces) left_out_.emplace(face.cell, face.face);
  };
  for (const std::string& boundary : boundaries) add(mesh.boundary(boundary));
  if (boundaries.empty()) add(mesh.outer_faces());
  update(*field_);
}

void BoundaryDomain::update(const Field& field) {
  if (&field != field_) return;
  whole_.clear();
  cut_.clear();
  CutRule rule;
  const Mesh& mesh = field.mesh();
  for (const CellFace& face : boundary_.empty() ? mesh.outer_faces() : mesh.boundary(boundary_)) {
    if (face.cell >= mesh.owned_cells() || !field.active_cells()[face.cell]) continue;
    if (left_out_.contains({face.cell, face.face})) continue;
    if (!field.is_cut(face.cell)) {
      whole_.push_back(face);
      continue;
    }
    for (int p = 0; p < field.parts(face.cell); ++p) {
      field.cut()->face_rule(face.cell, face.face, degree_, rule, p);
      if (rule.count() == 0) continue;
      CutPoints& part = cut_.emplace_back();
      part.cell = face.cell;
      part.part = p;
      part.face = face.face;
      part.weight = rule.weight;
      part.reference = rule.reference;
    }
  }
}

void BoundaryDomain::fill(int index, Element& element) const {
  const Mesh& mesh = field_->mesh();
  const int whole = static_cast<int>(whole_.size());
  element.dimension = mesh.dimension();
  element.sides.resize(1);
  ElementSide& side = element.sides[0];
  const CutPoints* part = index < whole ? nullptr : &cut_[index - whole];
  const CellFace face = part ? CellFace{part->cell, part->face} : whole_[index];
  attach_cell(side, *field_, face.cell, part ? part->part : 0);
  side.face = face.face;
  if (part)
    part->attach(side, true);
  else
    tables_.attach(side);
  element.points = part ? static_cast<int>(part->weight.size()) : tables_.rule().count();
  side.map_geometry();
  const CellTopology& cell = topology(mesh.type());
  // For the normals' sake also where the weights of a wet part replace those of the face.
  element.measure_face(cell, side.face, part ? part->weight : tables_.rule().weights);
  if (part) element.weight = part->weight;
  element.set_sizes(side.diameter, mesh.volume(face.cell) / element.measure());
}

const int* BoundaryDomain::nodes(int index, int, int block) const {
  const int whole = static_cast<int>(whole_.size());
  if (index < whole) return field_->cell_nodes(block, whole_[index].cell);
  return field_->cell_nodes(block, cut_[index - whole].cell, cut_[index - whole].part);
}

std::string BoundaryDomain::description() const {
  if (boundary_.empty()) return fmt::format("surface of field '{}'", field_->name());
  return fmt::format("boundary '{}' of field '{}'", boundary_, field_->name());
}

}  // namespace seam
