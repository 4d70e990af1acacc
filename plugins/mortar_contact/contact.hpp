// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/plugin/registry.hpp"

namespace seam::mortar {

/// The coupling `mortar_contact`.
void declare_contact(Registry& registry);

}  // namespace seam::mortar
