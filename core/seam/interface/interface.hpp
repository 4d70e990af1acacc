// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "seam/field/unknown.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/surface/body.hpp"
#include "seam/term/term.hpp"

namespace seam {

class CellConstant;
class Field;
class FieldCut;
class IntegrationDomain;
class Law;

/// What the core hands to an interface when a scene is built.
class InterfaceSetup {
 public:
  virtual ~InterfaceSetup() = default;
  /// The fields, in the order of Interface::fields().
  std::vector<Field*> sides;
  int degree = 2;  ///< polynomial degree of products of the unknowns' functions, as their cells count it
  int extra_degree = 0;  ///< what the couplings ask for beyond it
  /// The bodies that cut the mesh of a side's field; one can be added.
  [[nodiscard]] virtual FieldCut& cut(int side) = 0;
  /// Name of the unknown that displaces the mesh of a side's field, "" for none.
  [[nodiscard]] virtual std::string displacement(int side) = 0;
  /// A mesh of the scene.
  [[nodiscard]] virtual std::shared_ptr<const MeshData> mesh(const std::string& name) = 0;
};

/// Points of an interface that couplings treat alike.
struct InterfacePart {
  std::string name;  ///< "" where an interface has one part only
  std::shared_ptr<IntegrationDomain> domain;
  /// Whether side 0's field is met at the points themselves; else its trace is one from elsewhere.
  bool bounds_field = true;
};

/// Where two or more fields meet. A type of kind "interface": built from the scene, it yields the points on
/// which coupling terms are integrated, each with a trace (field, cell, reference coordinates) on every side.
class Interface {
 public:
  virtual ~Interface() = default;
  /// Names of the fields on its sides, side 0 first.
  [[nodiscard]] virtual std::vector<std::string> fields() const = 0;
  /// The surface of a body that the interface cuts out of the mesh of side 0, where it can be told before
  /// fields exist: meshes are distributed by what their cells will cost. The background of the setting is the
  /// whole mesh.
  [[nodiscard]] virtual std::optional<Surface> body(const BodySetting& setting, double time) const {
    (void)setting, (void)time;
    return std::nullopt;
  }
  /// Parts of the boundary of a side's mesh that are its surface on that side; empty for all of it.
  [[nodiscard]] virtual std::vector<std::string> boundaries(int side) const {
    (void)side;
    return {};
  }
  /// The interface's points, in one part or several. Points that move are asked to follow part by part, in
  /// this order. Collective.
  [[nodiscard]] virtual std::vector<InterfacePart> build(InterfaceSetup& setup) const = 0;
};

/// What a coupling may know of an interface: the names of its fields and of their unknowns, nothing of their
/// classes.
struct CouplingSides {
  std::vector<const Field*> fields;
  /// The region of each side's field that is meant (Field::region). Where physics tell regions apart, a
  /// coupling is asked for its terms and measures for each combination of them.
  std::vector<int> regions;
  /// A law of a side's field there (Field::law); null when it has none of this name.
  [[nodiscard]] std::shared_ptr<const Law> law(int side, const std::string& name) const;
};

/// How values at the points of a domain become one number.
enum class MeasureOf { norm, integral, least, greatest };

/// What happens where fields meet. A type of kind "coupling"; its schema must have the key `on`.
class Coupling {
 public:
  virtual ~Coupling() = default;
  struct SideConstant {
    int side;
    std::shared_ptr<const CellConstant> constant;
  };
  struct SideTerm {
    std::shared_ptr<const Term> term;
    std::vector<Operand> operands;
    /// What the term reads as Point::constant, two at most: numbers of the cells on a side.
    std::vector<SideConstant> constants = {};
    /// The part of the interface on which it is integrated, where that has several.
    std::string part = {};
  };
  /// How many degrees more than products of the unknowns' functions the interface should integrate exactly.
  [[nodiscard]] virtual int extra_degree(int /*dimension*/) const { return 0; }
  /// Unknowns that it brings: more of a side's field, on that side's part of the interface alone, as
  /// multipliers are. Their names are `interface.name`, as those of measures.
  /// @param of_field those that the side's physics has
  /// @return of each where it lives follows from the interface
  [[nodiscard]] virtual std::vector<Unknown> unknowns(int side, int dimension,
                                                      const std::vector<Unknown>& of_field) const {
    (void)side, (void)dimension, (void)of_field;
    return {};
  }
  /// @throws Error when the sides lack an unknown it needs, naming the field and the unknown
  [[nodiscard]] virtual std::vector<SideTerm> terms(const CouplingSides& sides) const = 0;
  /// A surface term of a side's physics (FieldSetup::add_surface_term) that the coupling brings at its own
  /// points: the physics leaves it out where the interface is, so that all sides see the same integral.
  struct Brought {
    int side;
    std::string term;
  };
  [[nodiscard]] virtual std::vector<Brought> brings(const CouplingSides& sides) const {
    (void)sides;
    return {};
  }
  /// What becomes of a quantity on the interface: one number, recorded at every step as the time series
  /// `interface.name`.
  struct Measure {
    std::string name;
    /// One for each part of the interface that counts; what they make up together is recorded.
    std::vector<SideTerm> quantities;
    /// The L2 norm over the interface, as of what vanishes where the conditions hold exactly; or, of a
    /// scalar, the integral or the extreme value at an integration point (where there is none: the least is
    /// infinite, the greatest 0).
    MeasureOf of = MeasureOf::norm;
  };
  [[nodiscard]] virtual std::vector<Measure> measures(const CouplingSides& sides) const {
    (void)sides;
    return {};
  }
  /// A coupling of the scene as others see it: what the scene says of it, and the fields of its interface.
  struct Neighbour {
    Parameters parameters;
    std::vector<std::string> fields;
  };
  /// Looks at all couplings of the scene, before any is asked for terms.
  /// @param self its own number among them
  /// @throws Error where it does not go together with one of them
  virtual void check_beside(const std::vector<Neighbour>& all, std::size_t self) const {
    (void)all;
    (void)self;
  }
};

}  // namespace seam
