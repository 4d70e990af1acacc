// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/conformance/check.hpp"
#include "seam/physics/potential.hpp"

namespace seam {

/// Checks a material of the kind "hyperelastic" (a strain energy of I1, I2, J): gradient and Hessian against
/// finite differences at random deformations, no energy, no stress and a positive shear modulus in the
/// undeformed state. Objectivity needs no check: the invariants have it.
std::vector<ConformanceCheck> check_hyperelastic(const Potential& material);

}  // namespace seam
