// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace seam {

class RowLaw;

/// What an unknown is among those of its field.
enum class UnknownRole {
  plain,
  /// Its equations constrain the field's other unknowns, as those of the pressure of an incompressible flow
  /// do: of themselves they may say nothing about it.
  constraint,
  /// It displaces points, which positions are added to: the mesh, a body.
  motion,
  /// Its equations say what it is by others and constrain none of them: an orientation that angles have led
  /// to.
  derived
};

/// Changes of an unknown that its equations hardly resist, which multigrid has to know.
enum class NearNullspace {
  constants,      ///< of each component
  rigid_motions,  ///< of a vector as long as the mesh has dimensions: translations and rotations
};

/// What a physics declares of one of its unknowns.
struct Unknown {
  std::string name;
  int components = 1;
  int order = 1;       ///< of the Lagrange space: 1 or 2
  int time_order = 0;  ///< highest rate that the physics reads: 0 (pressure), 1 (velocity), 2 (displacement)
  std::string unit;
  UnknownRole role = UnknownRole::plain;
  NearNullspace near_nullspace = NearNullspace::constants;
  /// Size that its values have by their nature, as 1 of an angle; 0: there is none. A change beside which
  /// this is large counts as none, and equations are weighed by it. Of what displaces points it is at least
  /// the size of a cell.
  double scale = 0;
  /// Nodal data instead of an unknown of the system: terms read it as any other, its values follow from
  /// FieldSetup::give at each step.
  bool given = false;
  /// Where it lives: on all of the mesh, or on the nodes of these parts of its boundary alone, of its whole
  /// outer surface where the list is empty. Terms read it as any other; its functions are those of the mesh's
  /// Lagrange space that do not vanish there.
  std::optional<std::vector<std::string>> boundaries = {};
  /// Unknown of its field that its equations hold, if they do: where a component of this is given already,
  /// where parts of the boundary with such multipliers meet, or one of another field holds it, nodes have
  /// none of it, and those beside them take over their functions. One with fewer components than what it
  /// holds, as a pressure, stays but where all of them are given and nothing opposite moves.
  std::string multiplier_of = {};
  /// What becomes of its equations; null: what terms assemble is zero.
  std::shared_ptr<const RowLaw> law = {};
};

}  // namespace seam
