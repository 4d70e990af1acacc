// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/plugin/registry.hpp"

namespace seam_test {

/// What the types below build: the tests ask for their parameters only.
struct Thing {
  virtual ~Thing() = default;
};

/// Registers a field "bar", materials, an interface "tie", a coupling "glue" and the linear solver "direct".
void register_test_types(seam::Registry& registry);
/// Registers an interface "coat", whose list `parts` names boundaries of the field that its key `body` names.
void register_coat(seam::Registry& registry);

}  // namespace seam_test
