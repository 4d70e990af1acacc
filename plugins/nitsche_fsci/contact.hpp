// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/plugin/registry.hpp"

namespace seam::fsci {

/// Declares the coupling "contact".
void declare_contact(Registry& registry);

}  // namespace seam::fsci
