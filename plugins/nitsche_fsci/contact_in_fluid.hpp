// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/plugin/registry.hpp"

namespace seam::fsci {

/// Declares the coupling "contact_in_fluid".
void declare_contact_in_fluid(Registry& registry);

}  // namespace seam::fsci
