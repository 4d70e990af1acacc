// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/plugin/registry.hpp"

namespace seam::manufactured {

/// Registers "fpi_vortices".
void declare_fpi_vortices(Registry& registry);

}  // namespace seam::manufactured
