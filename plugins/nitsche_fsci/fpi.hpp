// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/plugin/registry.hpp"

namespace seam::fsci {

/// Registers the coupling "fpi".
void declare_fpi(Registry& registry);

}  // namespace seam::fsci
