// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "seam/assembly/domains.hpp"
#include "seam/cut/cut_mesh.hpp"
#include "seam/field/field.hpp"
#include "seam/mesh/quadrature.hpp"

namespace seam {

InteriorFaceDomain::InteriorFaceDomain(Field& field, int degree, Faces faces)
    : field_(&field), choice_(faces), tables_(field, degree, true) {
  InteriorFaceDomain::update(field);
}

bool InteriorFaceDomain::belongs(const Mesh::InteriorFace& face, bool belonged) const {
  const int cells[2] = {face.side[0].cell, face.side[1].cell};
  if (!field_->active_cells()[cells[0]] || !field_->active_cells()[cells[1]]) return false;
  if (choice_ == Faces::all || (belonged && field_->keeps_cut_faces())) return true;
  const bool is_cut[2] = {field_->is_cut(cells[0]), field_->is_cut(cells[1])};
  if (!is_cut[0] && !is_cut[1]) return false;
  // Next to a whole cell the face is wet, at least in part.
  if (choice_ == Faces::ghost || !is_cut[0] || !is_cut[1]) return true;
  // Nothing else holds the unknowns of a cell that a body has covered.
  if (field_->is_covered(cells[0]) || field_->is_covered(cells[1])) return true;
  static thread_local CutRule rule;
  field_->cut()->face_rule(cells[0], face.side[0].face, 1, rule);
  return rule.count() > 0;
}

void InteriorFaceDomain::update(const Field& field) {
  if (&field != field_) return;
  faces_.clear();
  const auto& faces = field.mesh().interior_faces();
  std::vector<char>* before =
      choice_ == Faces::all ? nullptr : field_->cut_faces(choice_ == Faces::wet_ghost);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const bool belongs_now = belongs(faces[k], before != nullptr && (*before)[k] != 0);
    if (before != nullptr) (*before)[k] = belongs_now ? 1 : 0;
    if (belongs_now) add(faces[k]);
  }
}

void InteriorFaceDomain::add(const Mesh::InteriorFace& face) {
  const Space& space = *field_->blocks().front().space;
  const CellFace &first = face.side[0], &second = face.side[1];
  const int orientation =
      FaceTables::orientation(topology(field_->mesh().type()), space.cell_nodes(first.cell), first.face,
                              space.cell_nodes(second.cell), second.face);
  if (field_->layout() == nullptr || (!field_->is_cut(first.cell) && !field_->is_cut(second.cell))) {
    faces_.push_back({{first, second}, {0, 0}, orientation});
    return;
  }
  for (const auto& [part, other] : field_->cut()->joined(first.cell, first.face))
    faces_.push_back({{first, second}, {part, other}, orientation});
}

void InteriorFaceDomain::fill(int index, Element& element) const {
  const OrientedFace& face = faces_[index];
  element.dimension = field_->mesh().dimension();
  element.points = tables_.rule().count();
  element.sides.resize(2);
  for (int s = 0; s < 2; ++s) {
    attach_cell(element.sides[s], *field_, face.side[s].cell, face.part[s]);
    element.sides[s].face = face.side[s].face;
  }
  ElementSide &first = element.sides[0], &second = element.sides[1];
  tables_.attach(first);
  tables_.attach_partner(second, face.orientation);
  first.map_geometry();
  second.map_geometry();
  element.measure_face(topology(field_->mesh().type()), first.face, tables_.rule().weights);
  const double size = std::max(first.diameter, second.diameter);
  const Mesh& mesh = field_->mesh();
  element.set_sizes(
      size, std::max(mesh.volume(face.side[0].cell), mesh.volume(face.side[1].cell)) / element.measure());
}

const int* InteriorFaceDomain::nodes(int index, int side, int block) const {
  return field_->cell_nodes(block, faces_[index].side[side].cell, faces_[index].part[side]);
}

std::string InteriorFaceDomain::description() const {
  return fmt::format("interior faces of field '{}'", field_->name());
}

}  // namespace seam
