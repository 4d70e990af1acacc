// SPDX-License-Identifier: BSD-3-Clause
#include "rigid_motion.hpp"

#include <algorithm>

#include "seam/constraint/node_selection.hpp"

namespace seam::solid {

RigidUnknowns::RigidUnknowns(const Field& field)
    : field_(&field), translation_(field.place("translation")), rotation_(field.place("rotation")) {
  if (first_axis() == 0) orientation_ = field.place("orientation").offset;
}

RigidPosition RigidUnknowns::present(Ties& ties) const {
  std::vector<RigidPosition> own;
  if (owned()) {
    RigidPosition& at = own.emplace_back();
    const Block& b = block();
    at.centre = ties.place(*field_, translation_.block, 0, 0);
    at.in_space = orientation_ >= 0;
    std::copy_n(b.now.value.begin() + translation_.offset, translation_.components, at.translation.begin());
    std::copy_n(b.old.value.begin() + translation_.offset, translation_.components,
                at.old_translation.begin());
    for (int c = 0; c < rotation_.components; ++c) {
      at.rotation[first_axis() + c] = b.now.value[rotation_.offset + c];
      at.old_rotation[first_axis() + c] = b.old.value[rotation_.offset + c];
    }
    if (at.in_space) std::copy_n(b.old.value.begin() + orientation_, 4, at.old_orientation.c.begin());
    // Where no initial state has been set yet.
    if (dot(at.old_orientation, at.old_orientation) == 0) at.old_orientation = no_rotation;
  }
  const RigidPosition at = field_->mesh().communicator().gather_all(own).at(0);
  if (at.in_space) ties.set_axes(place(at, 3), at.turn(Vec<3, double>{at.rotation}));
  return at;
}

UnknownPlace RigidUnknowns::place(const RigidPosition& at, int number) const {
  UnknownPlace place = at.centre;
  place.component = component(number);
  return place;
}

bool RigidUnknowns::free(int number) const {
  return exists(number) && is_free(block(), 0, component(number));
}

}  // namespace seam::solid
