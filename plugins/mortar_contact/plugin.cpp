// SPDX-License-Identifier: BSD-3-Clause
#include "seam/plugin/plugin.hpp"

#include "contact.hpp"
#include "tie.hpp"

SEAM_PLUGIN(registry) {
  seam::mortar::declare_tie(registry);
  seam::mortar::declare_contact(registry);
}
