// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/plugin/registry.hpp"

namespace seam::solid {

/// Registers the constraint `joint`.
void declare_joint(Registry& registry);

}  // namespace seam::solid
