// SPDX-License-Identifier: BSD-3-Clause
#include "seam/plugin/plugin.hpp"

#include "bonded.hpp"
#include "contact.hpp"
#include "contact_in_fluid.hpp"
#include "fpi.hpp"
#include "fsi.hpp"
#include "porous_contact.hpp"

SEAM_PLUGIN(registry) {
  seam::fsci::declare_fsi(registry);
  seam::fsci::declare_fpi(registry);
  seam::fsci::declare_bonded(registry);
  seam::fsci::declare_contact(registry);
  seam::fsci::declare_contact_in_fluid(registry);
  seam::fsci::declare_porous_contact(registry);
}
