// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "seam/field/field.hpp"
#include "seam/field/unknown.hpp"
#include "seam/interface/interface.hpp"

/// What the plugin's couplings have in common: unknowns on the surface of side 0, the slave side.
namespace seam::mortar {

/// The unknown on the slave's surface, of the order of its displacement or lower. @param side that is asked
/// for
inline std::vector<Unknown> multiplier(const std::string& name, int components, int highest_order, int side,
                                       const std::vector<Unknown>& of_field) {
  const auto displacement = std::ranges::find(of_field, "displacement", &Unknown::name);
  if (side != 0 || displacement == of_field.end()) return {};
  return {{name, components, std::min(displacement->order, highest_order), 0, "Pa", UnknownRole::constraint}};
}

/// @throws Error where a side has no displacement, naming the field
inline void require_displacements(const CouplingSides& sides) {
  for (const Field* field : sides.fields) static_cast<void>(field->place("displacement"));
}

}  // namespace seam::mortar
