// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "seam/assembly/ties.hpp"
#include "seam/assembly/time_point.hpp"

namespace seam {

class Field;
class Registry;

/// The fields of a scene while its constraints are built.
class ConstraintSetup {
 public:
  virtual ~ConstraintSetup() = default;
  /// @throws Error listing the scene's fields
  [[nodiscard]] virtual Field& field(const std::string& name) const = 0;
  /// Local nodes of a block that lie on a boundary of the field's mesh.
  [[nodiscard]] virtual std::vector<int> boundary_nodes(const Field& field, int block,
                                                        const std::string& boundary) const = 0;
  /// Nothing leaves the field at a boundary any more, though no condition says so: the level of a pressure is
  /// not held there.
  virtual void close(const Field& field, const std::string& boundary) = 0;
};

/// Ties unknowns to each other. A type of kind "constraint".
class Constraint {
 public:
  virtual ~Constraint() = default;
  /// Collective, once, when all fields are there.
  virtual void build(ConstraintSetup& setup) = 0;
  /// Adds the ties as they are at the present states; called before each iteration. Collective.
  virtual void tie(Ties& ties, const TimePoint& at) const = 0;
};

/// Registers "periodic", "tied" and "symmetry".
void register_constraints(Registry& registry);

}  // namespace seam
