// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/field_cut.hpp"

#include <cmath>

namespace seam {
namespace {

/// In cells: parts of less volume are dropped.
constexpr double smallest_kept = 2;

}  // namespace

FieldCut::FieldCut(Field& field)
    : field_(&field), mesh_(field.mesh()), active_(field.mesh().cells(), 1), extension_(field) {}

int FieldCut::add_body(Body body) {
  bodies_.push_back(std::move(body));
  return static_cast<int>(bodies_.size()) - 1;
}

/// False after a failed step was rewound: then nodes known at its start may be inactive in the present cut.
bool FieldCut::states_match() const {
  bool match = true;
  for (const Block& block : field_->blocks()) match = match && (block.given || block.known == block.active);
  return !field_->mesh().communicator().any(!match);
}

bool FieldCut::update(double time) {
  std::vector<Surface> surfaces;
  for (const Body& body : bodies_) surfaces.push_back(body(time));
  if (time != time_) decided_ = false;
  time_ = time;
  const bool decides = !decided_;
  decided_ = true;
  if (surfaces == surfaces_ && (is_first_cut_ || !decides) && states_match()) return false;
  mesh_.cut(surfaces);
  surfaces_ = std::move(surfaces);
  is_first_cut_ = decides;
  dropped_volume_ = mesh_.drop(decides ? decide() : follow_decision());
  if (decides) area_.clear();
  for (const int c : mesh_.cut_cells()) area_.try_emplace(c, mesh_.interface_area(c));
  for (int c = 0; c < field_->mesh().cells(); ++c) active_[c] = mesh_.state(c) != CellState::body ? 1 : 0;
  field_->occupy(active_, &mesh_);
  extension_.extend();
  return true;
}

double FieldCut::trace_size(int cell) const {
  constexpr double least_area = 0.25;  // of a cell's face
  const double volume = mesh_.cell_volume(cell), dim = field_->mesh().dimension();
  return volume / std::max(area_.at(cell), least_area * std::pow(volume, (dim - 1) / dim));
}

/// Per part.
std::vector<char> FieldCut::open_parts(const FluidParts& parts) const {
  std::vector<double> faces(parts.volume.size(), 0.0);
  CutRule rule;
  for (const std::string& name : open_boundaries_)
    for (const CellFace& face : field_->mesh().boundary(name)) {
      const int part = parts.part[face.cell];
      if (part < 0 || face.cell >= field_->mesh().owned_cells()) continue;
      if (mesh_.state(face.cell) == CellState::cut) {
        mesh_.face_rule(face.cell, face.face, 1, rule);
        if (rule.count() == 0) continue;
      }
      ++faces[part];
    }
  field_->mesh().communicator().sum(faces);
  std::vector<char> open;
  for (const double count : faces) open.push_back(count > 0 ? 1 : 0);
  return open;
}

/// The cells to be dropped, and for later cuts what becomes of all others.
std::vector<int> FieldCut::decide() {
  const FluidParts parts = mesh_.find_parts();
  const std::vector<char> open = open_parts(parts);
  std::vector<int> cells;
  decision_.assign(field_->mesh().cells(), Decision::body);
  for (int c = 0; c < field_->mesh().cells(); ++c) {
    const int part = parts.part[c];
    if (part < 0) continue;
    const bool is_small = parts.cells[part] < smallest_kept && !open[part];
    decision_[c] = is_small ? Decision::dropped : Decision::kept;
    if (is_small) cells.push_back(c);
  }
  return cells;
}

/// Cells that were dropped, also where a body has opened them to a kept part; and all of a part that has
/// moved on from dropped cells, or is new and small. No known state would reach it.
std::vector<int> FieldCut::follow_decision() const {
  const FluidParts parts = mesh_.find_parts();
  const std::vector<char> open = open_parts(parts);
  std::vector<double> kept(parts.volume.size(), 0.0), dropped(parts.volume.size(), 0.0);
  for (int c = 0; c < field_->mesh().owned_cells(); ++c) {
    if (parts.part[c] < 0) continue;
    if (decision_[c] == Decision::kept) ++kept[parts.part[c]];
    if (decision_[c] == Decision::dropped) ++dropped[parts.part[c]];
  }
  field_->mesh().communicator().sum(kept);
  field_->mesh().communicator().sum(dropped);
  std::vector<int> cells;
  for (int c = 0; c < field_->mesh().cells(); ++c) {
    const int part = parts.part[c];
    if (part < 0) continue;
    const bool is_small = parts.cells[part] < smallest_kept && !open[part];
    if (decision_[c] == Decision::dropped || (kept[part] == 0 && (dropped[part] > 0 || is_small)))
      cells.push_back(c);
  }
  return cells;
}

}  // namespace seam
