// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/field_output.hpp"

#include <algorithm>

#include "seam/record/clipped_cells.hpp"
#include "seam/record/evaluate.hpp"

namespace seam {
namespace {

const Space* finest_space(const FieldEntry& entry) {
  const Space* finest = nullptr;
  for (const Block& block : entry.field->blocks())
    if (!finest || block.space->order() > finest->order()) finest = block.space.get();
  return finest;
}

/// Cells and nodes of a space; the piece holds the cells this rank owns.
/// @param shown per local cell; empty when all are
/// @param field whose space it is, where it is one of a field's
VtuPiece piece_of(const Space& space, const std::vector<char>& shown, const Field* field = nullptr) {
  const Mesh& mesh = space.mesh();
  VtuPiece piece;
  piece.dimension = mesh.dimension();
  piece.type = mesh.type();
  piece.order = space.order();
  for (int n = 0; n < space.nodes(); ++n)
    piece.points.insert(piece.points.end(), space.position(n), space.position(n) + piece.dimension);
  for (int c = 0; c < mesh.owned_cells(); ++c) {
    if (!shown.empty() && !shown[c]) continue;
    const int* nodes = field ? field->cell_nodes(space, c) : space.cell_nodes(c);
    piece.connectivity.insert(piece.connectivity.end(), nodes, nodes + space.nodes_per_cell());
  }
  return piece;
}

void add_quantities(const FieldEntry& entry, const Space& space, const TimePoint& at,
                    const ClippedCells* clipped, VtuPiece& piece) {
  std::vector<std::string> names;
  for (const Unknown& unknown : entry.field->unknowns()) names.push_back(unknown.name);
  for (const FieldQuantity& output : entry.outputs) names.push_back(output.name);
  for (const std::string& name : names) {
    const NamedQuantity quantity = find_quantity(entry, name);
    VtuArray array{name, quantity.components, nodal_values(entry, space, quantity, at), {}};
    if (clipped) clipped->append_values(quantity.components, array.values);
    if (quantity.components == 6) array.component_names = {"xx", "yy", "zz", "xy", "yz", "xz"};
    piece.point_arrays.push_back(std::move(array));
  }
}

/// Nodes of bodies and of other ranks would be points of no cell, with values that mean nothing.
void leave_out_unused_points(VtuPiece& piece) {
  const std::size_t dim = piece.dimension, count = piece.points.size() / dim;
  std::vector<int> number(count, -1);
  for (auto* list : {&piece.connectivity, &piece.simplices})
    for (const int point : *list) number[point] = 0;
  int used = 0;
  for (int& n : number)
    if (n == 0) n = used++;
  for (auto* list : {&piece.connectivity, &piece.simplices})
    for (int& point : *list) point = number[point];
  const auto keep = [&](std::vector<double>& values, std::size_t components) {
    for (std::size_t p = 0; p < count; ++p)
      if (number[p] >= 0) std::copy_n(&values[p * components], components, &values[number[p] * components]);
    values.resize(used * components);
  };
  keep(piece.points, dim);
  for (VtuArray& array : piece.point_arrays) keep(array.values, array.components);
}

/// The active cells: whole ones, and the wet parts of cut ones. The array "cell" tells which parts belong
/// together.
VtuPiece field_piece(const FieldEntry& entry, const Space& space, const TimePoint& at) {
  const Field& field = *entry.field;
  if (!field.cut()) {
    VtuPiece piece = piece_of(space, field.active_cells());
    add_quantities(entry, space, at, nullptr, piece);
    return piece;
  }
  const Mesh& mesh = field.mesh();
  const ClippedCells clipped(field, space);
  std::vector<char> whole = field.active_cells();
  for (int c = 0; c < mesh.cells(); ++c)
    if (field.is_cut(c)) whole[c] = 0;
  VtuPiece piece = piece_of(space, whole, &field);
  piece.points.insert(piece.points.end(), clipped.points.begin(), clipped.points.end());
  piece.simplices = clipped.simplices;
  add_quantities(entry, space, at, &clipped, piece);
  VtuArray background{"cell", 1, {}, {}};
  for (int c = 0; c < mesh.owned_cells(); ++c)
    if (whole[c]) background.values.push_back(mesh.global_cell(c));
  for (const int c : clipped.background) background.values.push_back(mesh.global_cell(c));
  piece.cell_arrays.push_back(std::move(background));
  leave_out_unused_points(piece);
  return piece;
}

/// A rigid body is shown by its mesh, moved as its point says.
VtuPiece rigid_piece(const FieldEntry& entry, const Space& shape) {
  VtuPiece piece = piece_of(shape, {});
  const int dim = piece.dimension;
  VtuArray array{entry.physics->displacement(), dim, std::vector<double>(piece.points.size()), {}};
  const Block& block = entry.field->blocks().front();
  std::vector<double> motion(block.size, 0.0), centre(dim, 0.0);
  if (block.space->owned_nodes() > 0) {
    std::copy_n(block.now.value.begin(), block.size, motion.begin());
    std::copy_n(block.space->position(0), dim, centre.begin());
  }
  entry.mesh->communicator().sum(motion);
  entry.mesh->communicator().sum(centre);
  for (int n = 0; n < shape.nodes(); ++n) {
    std::vector<double> arm(dim);
    for (int d = 0; d < dim; ++d) arm[d] = shape.position(n)[d] - centre[d];
    entry.physics->displace(dim, motion.data(), arm.data(), &array.values[static_cast<std::size_t>(n) * dim]);
  }
  piece.point_arrays.push_back(std::move(array));
  return piece;
}

}  // namespace

FieldOutput::FieldOutput(Problem& problem, ResultsFolder& folder, double resume_time) : problem_(problem) {
  for (const FieldEntry& entry : problem_.fields())
    series_.emplace_back(problem_.communicator(), folder, entry.name, resume_time);
  MPI_Barrier(problem_.communicator().handle());
}

void FieldOutput::write(long step_number, const TimePoint& at) {
  for (std::size_t f = 0; f < problem_.fields().size(); ++f) {
    const FieldEntry& entry = problem_.fields()[f];
    const bool rigid = entry.physics->support() == Support::point;
    const Space* space = finest_space(entry);
    std::unique_ptr<Space> shape;
    if (rigid || !space) shape = std::make_unique<Space>(*entry.shape, entry.shape->order());
    series_[f].write(step_number, at.time,
                     rigid   ? rigid_piece(entry, *shape)
                     : space ? field_piece(entry, *space, at)
                             : piece_of(*shape, {}));
  }
  MPI_Barrier(problem_.communicator().handle());
}

}  // namespace seam
