// SPDX-License-Identifier: BSD-3-Clause
#include "seam/plugin/plugin.hpp"

// Each source file declares its own types.
void declare_mooney_rivlin(seam::Registry& registry);
void declare_heat(seam::Registry& registry);
void declare_heat_transfer(seam::Registry& registry);

SEAM_PLUGIN(registry) {
  declare_mooney_rivlin(registry);
  declare_heat(registry);
  declare_heat_transfer(registry);
}
