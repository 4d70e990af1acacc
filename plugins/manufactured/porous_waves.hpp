// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/plugin/registry.hpp"

namespace seam::manufactured {

/// Registers "porous_waves".
void declare_porous_waves(Registry& registry);

}  // namespace seam::manufactured
