// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/plugin/registry.hpp"

/// Each source file declares its own types.
namespace example {

void declare_mooney_rivlin(seam::Registry& registry);
void declare_heat(seam::Registry& registry);
void declare_heat_transfer(seam::Registry& registry);

}  // namespace example
