// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/plugin/registry.hpp"

namespace seam::manufactured {

/// Registers "fsi_vortices".
void declare_fsi_vortices(Registry& registry);

}  // namespace seam::manufactured
