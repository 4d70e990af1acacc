// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/plugin/registry.hpp"

namespace seam::fluid {

/// Registers what can be given on the boundary of a fluid that a body cuts out: `fluid_wall` (its velocity,
/// with slip) and `fluid_traction`.
void declare_couplings(Registry& registry);

}  // namespace seam::fluid
