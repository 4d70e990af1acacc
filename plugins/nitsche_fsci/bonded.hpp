// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/plugin/registry.hpp"

namespace seam::fsci {

/// Registers "bonded".
void declare_bonded(Registry& registry);

}  // namespace seam::fsci
