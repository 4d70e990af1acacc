// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/plugin/registry.hpp"

namespace seam::solid {

/// Registers the interface `link` and the couplings `spring` and `torsional_spring` on it.
void declare_springs(Registry& registry);

}  // namespace seam::solid
