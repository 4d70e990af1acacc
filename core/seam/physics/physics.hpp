// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "seam/base/diagnostics.hpp"
#include "seam/field/unknown.hpp"
#include "seam/scene/expression.hpp"
#include "seam/term/term.hpp"

namespace seam {

class Law;

/// Volume, centre and second moments about the centre of a body, from its mesh.
struct Moments {
  double volume = 0;         ///< m^3 (2D: m^2)
  double centre[3] = {};     ///< m
  double second[3][3] = {};  ///< integral of (x - centre)_i (x - centre)_j, m^5 (2D: m^4)
};

/// Which faces carry a ghost penalty (thesis (3.5), Remark 3.3): those between two active cells of which at
/// least one is cut; `wet` leaves out faces that lie inside a body altogether.
enum class GhostFaces { all, wet };

/// What a physics hands to the core when a scene is built. Names of unknowns are the field's own; names of
/// boundaries are the mesh's.
class FieldSetup {
 public:
  virtual ~FieldSetup() = default;
  [[nodiscard]] virtual int dimension() const = 0;
  [[nodiscard]] virtual const std::string& field_name() const = 0;

  /// Names of the mesh's boundaries.
  [[nodiscard]] virtual std::vector<std::string> boundaries() const = 0;
  /// The coordinate (0, 1, 2) that is constant on a boundary; -1 when there is none.
  [[nodiscard]] virtual int boundary_axis(const std::string& boundary) const = 0;
  /// Makes a constant of the physics known to couplings (Field::constant): a density, a viscosity.
  virtual void publish(const std::string& constant, double value) = 0;
  /// Makes a law of the physics known to couplings (Field::law), under one of the names that Law lists.
  virtual void publish(const std::string& name, std::shared_ptr<const Law> law) = 0;

  /// Tells regions of the mesh apart, in which the body is of different material. Before anything else is
  /// said.
  /// @param names of regions of the mesh that make up each of them, with where the scene names them
  /// @throws Error when a cell lies in none of them, or in two
  virtual void divide(const std::vector<std::pair<std::vector<std::string>, Location>>& names) = 0;
  /// What `add` adds, terms, laws, outputs and integrals, holds in one of these regions only, terms on
  /// interior faces where both cells lie in it. Of a field that is not divided region 0 is the whole.
  virtual void within(int region, const std::function<void()>& add) = 0;

  /// Adds a term over all cells. @param operands the unknowns the kernel's operands 0, 1, ... stand for
  virtual void add_cell_term(std::shared_ptr<const Term> term, std::vector<std::string> operands) = 0;
  /// The same, only over cells that no body cuts: for residual-based stabilisation.
  virtual void add_uncut_cell_term(std::shared_ptr<const Term> term, std::vector<std::string> operands) = 0;
  virtual void add_boundary_term(const std::string& boundary, std::shared_ptr<const Term> term,
                                 std::vector<std::string> operands) = 0;
  /// The same over the whole outer surface of the mesh, whether or not its parts have names.
  /// @param name by which couplings may bring the term at their own points, see Coupling::brings
  virtual void add_surface_term(std::shared_ptr<const Term> term, std::vector<std::string> operands,
                                const std::string& name = {}) = 0;
  /// Adds a term over the faces between two cells; its operands name a side (0 or 1) each.
  virtual void add_interior_face_term(std::shared_ptr<const Term> term, std::vector<Operand> operands) = 0;
  /// The same over the faces of cut cells only, for ghost penalties.
  virtual void add_ghost_face_term(GhostFaces faces, std::shared_ptr<const Term> term,
                                   std::vector<Operand> operands) = 0;
  /// Fixes the level of a scalar unknown that the equations determine only up to a constant: gives it this
  /// value at one node of each connected part of the domain that does not reach one of these boundaries.
  virtual void fix_level(const std::string& unknown, double value,
                         std::vector<std::string> open_boundaries) = 0;
  /// Prescribes a component of an unknown on a boundary, at all times.
  /// @param where place in the scene, for the error when two conditions claim the same unknown
  virtual void prescribe(const std::string& boundary, const std::string& unknown, int component,
                         Expression value, const Location& where) = 0;
  /// Says what a component of a given unknown is, at the nodes and at all times.
  virtual void give(const std::string& unknown, int component, Expression value) = 0;
  virtual void set_initial(const std::string& unknown, int component, Expression value) = 0;
  virtual void set_initial_rate(const std::string& unknown, int component, Expression value) = 0;

  /// A quantity for pictures and probes, evaluated at nodes (averaged over the cells that meet there).
  virtual void add_output(const std::string& name, std::shared_ptr<const Term> quantity,
                          std::vector<std::string> operands) = 0;
  /// A quantity integrated over the field and written as a time series: an energy, a mass, a flow.
  virtual void add_integral(const std::string& name, std::shared_ptr<const Term> quantity,
                            std::vector<std::string> operands) = 0;
  /// A quantity that needs a boundary's normal, as what flows out: for probes, integrated over boundaries at
  /// rest.
  virtual void add_boundary_quantity(const std::string& name, std::shared_ptr<const Term> quantity,
                                     std::vector<std::string> operands) = 0;
  /// Geometry of the body, for a physics with Support::point.
  [[nodiscard]] virtual Moments moments() const = 0;
};

/// Where a field's unknowns live.
enum class Support {
  mesh,   ///< on the nodes of its mesh
  point,  ///< on one point, the centre of its mesh: a rigid body
};

/// A physics: what a plugin registers under the kind "field". Its schema must have the key `mesh`.
class Physics {
 public:
  virtual ~Physics() = default;
  [[nodiscard]] virtual Support support() const { return Support::mesh; }
  /// Whether the field on two sides of a thin body has unknowns of its own on each
  /// (PartLayout).
  [[nodiscard]] virtual bool separates_parts() const { return false; }
  /// May be empty: a body with given motion.
  [[nodiscard]] virtual std::vector<Unknown> unknowns(int dimension) const = 0;
  virtual void build(FieldSetup& setup) const = 0;
  /// Name of the unknown or output that displaces the mesh in pictures, "" for none.
  [[nodiscard]] virtual std::string displacement() const { return ""; }
  /// Whether the unknowns are functions of where the displaced mesh is now, as a fluid's on a moving mesh,
  /// and not of where it was, as a solid's. Known solutions are compared with them there.
  [[nodiscard]] virtual bool moves_through_space() const { return false; }
  /// For Support::point: how a point of the body moves.
  /// @param motion the unknowns of the point, in the order of unknowns()
  /// @param arm reference position relative to the body's centre, [dimension]
  /// @param displacement result, [dimension]
  virtual void displace(int dimension, const double* motion, const double* arm, double* displacement) const {
    (void)motion, (void)arm;
    for (int d = 0; d < dimension; ++d) displacement[d] = 0;
  }
};

}  // namespace seam
