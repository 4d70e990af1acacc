// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/plugin/registry.hpp"

namespace seam::fsci {

/// Registers "fsi".
void declare_fsi(Registry& registry);

}  // namespace seam::fsci
