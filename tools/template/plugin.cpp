// SPDX-License-Identifier: BSD-3-Clause
#include "plugin.hpp"

#include "seam/plugin/plugin.hpp"

SEAM_PLUGIN(registry) {
  example::declare_mooney_rivlin(registry);
  example::declare_heat(registry);
  example::declare_heat_transfer(registry);
}
