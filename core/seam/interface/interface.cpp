// SPDX-License-Identifier: BSD-3-Clause
#include "seam/interface/interface.hpp"

#include "seam/field/field.hpp"

namespace seam {

std::shared_ptr<const Law> CouplingSides::law(int side, const std::string& name) const {
  return fields.at(side)->law(name, regions.at(side));
}

}  // namespace seam
