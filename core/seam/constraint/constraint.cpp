// SPDX-License-Identifier: BSD-3-Clause
#include "seam/constraint/constraint.hpp"

#include "seam/constraint/types.hpp"
#include "seam/plugin/registry.hpp"

namespace seam {

void register_constraints(Registry& registry) {
  register_periodic(registry);
  register_symmetry(registry);
  register_tied(registry);
}

}  // namespace seam
