// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/scene/parameters.hpp"
#include "seam/scene/schema.hpp"
#include "weak_boundary.hpp"

namespace seam::fluid {

/// Declares how a velocity is imposed weakly: slip_length, wall_traction, adjoint and penalty.
void declare_weak_condition(Schema& schema);

/// The kernel of these keys for a boundary with this velocity.
WeakVelocity weak_condition(const Parameters& parameters, const Flow& flow, std::vector<Expression> velocity);

/// A wall at rest that only keeps the fluid from passing: no tangential traction.
WeakVelocity weak_slip(const Flow& flow, int dimension);

}  // namespace seam::fluid
