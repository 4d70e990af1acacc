// SPDX-License-Identifier: BSD-3-Clause
#include "seam/plugin/plugin.hpp"

#include "fpi_vortices.hpp"
#include "fsi_vortices.hpp"
#include "porous_waves.hpp"

SEAM_PLUGIN(registry) {
  seam::manufactured::declare_fsi_vortices(registry);
  seam::manufactured::declare_fpi_vortices(registry);
  seam::manufactured::declare_porous_waves(registry);
}
