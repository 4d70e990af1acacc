// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/field_cut.hpp"

namespace seam {

FieldCut::FieldCut(Field& field)
    : field_(&field), mesh_(field.mesh()), active_(field.mesh().cells(), 1), extension_(field) {}

int FieldCut::add_body(Body body) {
  bodies_.push_back(std::move(body));
  return static_cast<int>(bodies_.size()) - 1;
}

/// False after a failed step was rewound: then nodes known at its start may be inactive in the present cut.
bool FieldCut::states_match() const {
  bool match = true;
  for (const Block& block : field_->blocks()) match = match && block.known == block.active;
  return !field_->mesh().communicator().any(!match);
}

bool FieldCut::update(double time) {
  std::vector<Surface> surfaces;
  for (const Body& body : bodies_) surfaces.push_back(body(time));
  if (surfaces == surfaces_ && states_match()) return false;
  mesh_.cut(surfaces);
  surfaces_ = std::move(surfaces);
  for (int c = 0; c < field_->mesh().cells(); ++c) active_[c] = mesh_.state(c) != CellState::body ? 1 : 0;
  field_->occupy(active_, &mesh_);
  extension_.extend();
  return true;
}

}  // namespace seam
