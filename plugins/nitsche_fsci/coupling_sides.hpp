// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "body_pull.hpp"
#include "seam/interface/adjoint.hpp"
#include "seam/interface/interface.hpp"

/// What the plugin's couplings have in common.
namespace seam::fsci {

/// What a coupling needs to know of the fluid on side 0.
Flow flow_of(const CouplingSides& sides);

/// From the keys `adjoint` and `penalty`.
Ties ties_of(const Parameters& parameters);

/// A jump that a manufactured solution has between the sides, as a key of a schema of jumps.
/// @param tensor its entries are a tensor's, row by row
void declare_jump(Schema& jumps, const std::string& key, const std::string& of, const std::string& unit,
                  bool tensor);
/// @throws Error when it has another number of entries
Jump jump_of(const Parameters& jumps, const std::string& key, bool tensor);

/// The stress law of the body on a side.
/// @throws Error when the body has none, naming the field
std::shared_ptr<const Law> law_of(const CouplingSides& sides, int side);

/// Whether the body on a side makes known the stress of a mixture.
bool is_porous(const CouplingSides& sides, int side);

/// lambda_e of the cells on a side, by the key `scaling`; of a rigid body the key `surface_stiffness`.
std::shared_ptr<const CellConstant> scale_of(const Parameters& parameters, const CouplingSides& sides,
                                             int side);

/// Adds the key `stress`: whose stress stands for that between the bodies.
void declare_stress(Schema& schema);
/// Of two looks of a pair of surfaces at each other, each of which says whose stress counts, or how stiff
/// rigid surfaces are.
/// @throws Error where forces do not balance: both say `own`, or `other`, or stiffnesses differ
void check_looks(const std::vector<Coupling::Neighbour>& all, std::size_t self);
/// Adds the key `surface_stiffness` of two rigid bodies.
void declare_surface_stiffness(Schema& schema);
/// Of a body beside an obstacle, or of two, of which a rigid one has no stress.
/// @param other the side of the other body, -1 for an obstacle @param penalty gamma_0
/// @throws Error where both are rigid and the scene gives no stiffness, or gives one where they are not
BodyPull body_pull(const Parameters& parameters, const CouplingSides& sides, int own, int other,
                   double penalty);

}  // namespace seam::fsci
