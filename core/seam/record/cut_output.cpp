// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/cut_output.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "seam/assembly/domains.hpp"
#include "seam/cut/cut_mesh.hpp"
#include "seam/field/field.hpp"

namespace seam {
namespace {

/// Appends a cell whose corners are new points.
/// @param geometry of a background cell
/// @param vertices of that cell
void add_cell(const double* geometry, const std::vector<int>& vertices, VtuPiece& piece) {
  const int dim = piece.dimension;
  for (const int v : vertices) {
    piece.connectivity.push_back(static_cast<int>(piece.points.size()) / dim);
    piece.points.insert(piece.points.end(), geometry + static_cast<std::ptrdiff_t>(v) * dim,
                        geometry + static_cast<std::ptrdiff_t>(v + 1) * dim);
  }
}

VtuPiece cells_piece(const Field& field) {
  const Mesh& mesh = field.mesh();
  const CutMesh& cut = *field.cut();
  VtuPiece piece;
  piece.dimension = mesh.dimension();
  piece.type = mesh.type();
  VtuArray cell{"cell", 1, {}, {}}, state{"state", 1, {}, {}}, wet{"wet", 1, {}, {}},
      parts{"parts", 1, {}, {}};
  std::vector<int> vertices(topology(mesh.type()).vertices);
  std::iota(vertices.begin(), vertices.end(), 0);
  for (int c = 0; c < mesh.owned_cells(); ++c) {
    add_cell(mesh.geometry(c), vertices, piece);
    cell.values.push_back(mesh.global_cell(c));
    const bool is_cut = field.is_cut(c), is_active = field.active_cells()[c] != 0;
    state.values.push_back(is_cut ? 1 : is_active ? 0 : 2);
    parts.values.push_back(is_active ? field.parts(c) : 0);
    wet.values.push_back(is_cut ? cut.wet_volume(c) / cut.cell_volume(c) : is_active ? 1 : 0);
  }
  piece.cell_arrays = {std::move(cell), std::move(state), std::move(wet), std::move(parts)};
  return piece;
}

VtuPiece interface_piece(const Field& field) {
  const Mesh& mesh = field.mesh();
  int degree = 2;
  for (const Block& block : field.blocks()) degree = std::max(degree, 2 * block.space->order());
  VtuPiece piece;
  piece.dimension = mesh.dimension();
  piece.type = CellType::point;
  VtuArray normal{"normal", mesh.dimension(), {}, {}}, weight{"weight", 1, {}, {}}, body{"body", 1, {}, {}},
      facet{"facet", 1, {}, {}}, cell{"cell", 1, {}, {}};
  InterfaceRule rule;
  for (const int c : field.cut()->cut_cells()) {
    if (c >= mesh.owned_cells() || !field.is_cut(c)) continue;
    field.cut()->interface_rule(c, degree, rule);
    piece.points.insert(piece.points.end(), rule.position.begin(), rule.position.end());
    normal.values.insert(normal.values.end(), rule.normal.begin(), rule.normal.end());
    weight.values.insert(weight.values.end(), rule.weight.begin(), rule.weight.end());
    body.values.insert(body.values.end(), rule.body.begin(), rule.body.end());
    facet.values.insert(facet.values.end(), rule.facet.begin(), rule.facet.end());
    cell.values.resize(weight.values.size(), mesh.global_cell(c));
  }
  for (std::size_t q = 0; q < weight.values.size(); ++q) piece.connectivity.push_back(static_cast<int>(q));
  piece.point_arrays = {std::move(normal), std::move(weight), std::move(body), std::move(facet),
                        std::move(cell)};
  return piece;
}

VtuPiece ghost_faces_piece(Field& field) {
  const Mesh& mesh = field.mesh();
  const CellTopology& shape = topology(mesh.type());
  using Faces = InteriorFaceDomain::Faces;
  const InteriorFaceDomain all(field, 1, Faces::ghost), wet(field, 1, Faces::wet_ghost);
  Element element;
  std::set<std::pair<int, int>> is_wet;
  for (int f = 0; f < wet.size(); ++f) {
    wet.fill(f, element);
    is_wet.emplace(element.sides[0].global_cell, element.sides[1].global_cell);
  }
  VtuPiece piece;
  piece.dimension = mesh.dimension();
  piece.type = shape.face_type;
  VtuArray wetness{"wet", 1, {}, {}}, first{"first_cell", 1, {}, {}}, second{"second_cell", 1, {}, {}};
  for (int f = 0; f < all.size(); ++f) {
    all.fill(f, element);
    const int cells[2] = {element.sides[0].global_cell, element.sides[1].global_cell};
    add_cell(element.sides[0].geometry, shape.faces[element.sides[0].face], piece);
    wetness.values.push_back(is_wet.contains({cells[0], cells[1]}) ? 1 : 0);
    first.values.push_back(cells[0]);
    second.values.push_back(cells[1]);
  }
  piece.cell_arrays = {std::move(wetness), std::move(first), std::move(second)};
  return piece;
}

}  // namespace

CutOutput::CutOutput(Problem& problem, ResultsFolder& folder, double resume_time)
    : communicator_(problem.communicator()) {
  const auto series = [&](const std::string& name) {
    return PieceSeries(communicator_, folder, name, resume_time);
  };
  for (const FieldEntry& entry : problem.fields())
    if (entry.cut)
      fields_.push_back({&entry, series(entry.name + "-cells"), series(entry.name + "-interface"),
                         series(entry.name + "-ghost_faces")});
}

void CutOutput::write(long step_number, const TimePoint& at) {
  MPI_Barrier(communicator_.handle());  // the folder is there
  for (Series& series : fields_) {
    Field& field = *series.entry->field;
    series.cells.write(step_number, at.time, cells_piece(field));
    series.interface.write(step_number, at.time, interface_piece(field));
    series.ghost_faces.write(step_number, at.time, ghost_faces_piece(field));
  }
  MPI_Barrier(communicator_.handle());
}

}  // namespace seam
