// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "seam/assembly/domains.hpp"
#include "seam/constraint/holds_field.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

/// A quantity of a field by its name: an unknown, or an output that the physics declares.
struct NamedQuantity {
  std::vector<BoundTerm> terms;  ///< see FieldQuantity
  int components = 1;
};
/// @param on_boundary whether it may be one that only boundaries have
/// @throws Error listing the quantities the field has
NamedQuantity find_quantity(const FieldEntry& entry, const std::string& name, bool on_boundary = false);

/// Values of a quantity at the nodes of a space of the field, averaged over the cells that meet there, [local
/// node][component]. The averages are complete on the nodes of owned cells.
std::vector<double> nodal_values(const FieldEntry& entry, const Space& space, const NamedQuantity& quantity,
                                 const TimePoint& at);

/// Integral of each component over the cells of the domain's field. Collective.
std::vector<double> cell_integral(const CellDomain& cells, const NamedQuantity& quantity,
                                  const TimePoint& at);
/// Integral of each component over boundaries, in the reference configuration. Collective.
std::vector<double> boundary_integral(const FieldEntry& entry, const std::vector<std::string>& boundaries,
                                      const NamedQuantity& quantity, const TimePoint& at);

/// Integral of each component of a quantity of side 0's field over an interface. Collective.
std::vector<double> interface_integral(const Problem& problem, const std::string& interface,
                                       const NamedQuantity& quantity, const TimePoint& at);
/// What the couplings on an interface exert, in sum, on whatever side 0's field meets there: the residual of
/// their terms tested with 1 in each component of one of its unknowns. For a velocity or a displacement it is
/// the force, in exact balance with the field's equations. Collective.
std::vector<double> interface_force(const Problem& problem, const std::string& interface,
                                    const std::string& unknown, const TimePoint& at);
/// The same for a rotation: the moment about a point of what is exerted in the equations of the field's first
/// unknown, one number in the plane, three in space. Arms are those of nodes where they are now. Collective.
/// @throws Error where the mesh moves by a displacement of another order than the unknown
std::vector<double> interface_moment(const Problem& problem, const std::string& interface,
                                     const FieldEntry& entry, const std::array<double, 3>& about,
                                     const TimePoint& at);

/// The number that a coupling wants recorded. Collective.
double interface_measure(const InterfaceMeasure& measure, const TimePoint& at,
                         const Communicator& communicator);

/// A point of a field: found once, evaluated often. Where cells meet at the point, what jumps between them,
/// as gradients do, is the mean of their values: whichever cell one took would be one by its number.
class ProbePoint {
 public:
  /// Collective. @throws Error when the point lies in no cell, with the distance to the nearest one
  ProbePoint(const FieldEntry& entry, const std::vector<double>& position, const Location& where);
  /// Collective: the same value on every rank.
  [[nodiscard]] std::vector<double> evaluate(const FieldEntry& entry, const NamedQuantity& quantity,
                                             const TimePoint& at) const;

 private:
  struct InCell {
    int cell;  ///< local, owned
    std::vector<double> reference;
  };
  std::vector<InCell> places_;
  std::array<double, 3> position_{};
};

/// Sum of the forces that hold the prescribed components of an unknown on boundaries. Collective.
std::vector<double> reaction(Problem& problem, const FieldEntry& entry, const std::string& unknown,
                             const std::vector<std::string>& boundaries);

/// The constraint that holds a field with a force of this name, or null.
const HoldsField* find_holding(const Problem& problem, const FieldEntry& entry, const std::string& name);
/// That force. Collective.
std::vector<double> holding_force(const Problem& problem, const HoldsField& holds, const std::string& name);

}  // namespace seam
