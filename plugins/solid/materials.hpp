// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/plugin/registry.hpp"

namespace seam::solid {

/// Registers the materials of this plugin under the kind "hyperelastic". Such a potential is a strain energy
/// per reference volume, Pa, of three arguments: I1 = tr C, I2 = (I1^2 - tr C^2)/2 and J = det F of the
/// three-dimensional deformation gradient (in plane strain F33 = 1). Other plugins may add to the kind.
void declare_materials(Registry& registry);

}  // namespace seam::solid
