// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/plugin/registry.hpp"

namespace seam::fsci {

/// Registers the coupling "porous_contact_in_fluid".
void declare_porous_contact(Registry& registry);

}  // namespace seam::fsci
