// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "seam/assembly/bound_term.hpp"
#include "seam/constraint/constraint.hpp"
#include "seam/interface/interface.hpp"
#include "seam/physics/physics.hpp"
#include "seam/state/state_store.hpp"

namespace seam {

class Assembler;
class BoundaryDomain;
class JoinsFields;
class CutMesh;
class Field;
class FieldCut;
class Mesh;

/// A quantity of a field, for pictures, probes or time series.
struct FieldQuantity {
  std::string name;
  std::vector<BoundTerm> terms;  ///< one, or one for each region that the field's physics tells apart
};

/// A prescribed component of an unknown on a boundary.
struct PrescribedCondition {
  std::string boundary;
  std::string unknown;
  int block;
  int component;  ///< within the block
  std::vector<int> nodes;
  Expression value;
  Location where;
};

/// An unknown whose level is fixed at one node of each connected part of the field that does not reach an
/// open boundary.
struct LevelCondition {
  std::string unknown;
  int block, component;
  double value;
  std::vector<std::string> open_boundaries;
  std::vector<int> nodes;  ///< the local nodes that hold it at present
};

/// A field with its physics.
struct FieldEntry {
  FieldEntry();
  ~FieldEntry();
  FieldEntry(FieldEntry&&) noexcept;
  FieldEntry& operator=(FieldEntry&&) noexcept;
  std::string name;
  Location where = {};                ///< in the scene
  std::shared_ptr<const Mesh> shape;  ///< the mesh the scene gives it
  std::shared_ptr<const Mesh> mesh;   ///< the mesh its unknowns live on
  std::unique_ptr<Physics> physics;
  std::unique_ptr<Field> field;
  std::vector<PrescribedCondition> conditions;
  struct Initial {
    int block, component;
    Expression value;
    bool rate;
  };
  struct Given {
    int block, component;
    Expression value;
  };
  std::vector<Given> given;
  std::vector<Initial> initial;
  std::vector<LevelCondition> levels;
  /// Of each term on a boundary: its name, and the unknowns on whose equations it acts.
  std::vector<std::pair<std::string, std::set<std::string>>> loads;
  /// A term on all of the mesh's surface.
  struct SurfaceTerm {
    std::vector<std::shared_ptr<BoundaryDomain>> faces;
    std::set<std::string> unknowns;  ///< that it speaks of, but for the motion
  };
  std::map<std::string, SurfaceTerm> surfaces;  ///< by name
  std::unique_ptr<FieldCut> cut;                ///< null when nothing cuts the field's mesh
  std::vector<FieldQuantity> outputs, integrals, boundary_quantities;
};

/// A number that a coupling wants recorded.
struct InterfaceMeasure {
  std::string interface, name;  ///< recorded as the series "interface.name"
  struct PartIntegral {
    std::shared_ptr<const IntegrationDomain> domain;
    BoundTerm quantity;
  };
  std::vector<PartIntegral> integrals;  ///< one for each part of the interface that counts
  MeasureOf of;
};

/// What happened to the spaces of a problem.
enum class SpaceChange {
  none,
  geometry,  ///< elements or their points moved; unknowns and their numbers stayed
  unknowns   ///< unknowns came or went, or their numbers changed
};

/// All fields and terms of a scene as one nonlinear system, and the states they are in.
class Problem {
 public:
  explicit Problem(const Communicator& communicator);
  ~Problem();
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;

  /// Adds a field and lets its physics declare its terms. Collective.
  /// @param brought unknowns that couplings bring to it
  /// @throws Error when two conditions claim the same unknown on the same boundary
  /// @throws PluginFault when what the physics declares cannot be
  Field& add_field(const std::string& name, const std::shared_ptr<const Mesh>& mesh,
                   std::unique_ptr<Physics> physics, const Location& where = {},
                   const std::vector<Unknown>& brought = {});
  /// Adds terms on an interface between fields.
  void add_coupling(std::shared_ptr<IntegrationDomain> interface, std::vector<BoundTerm> terms);
  /// Leaves a surface term of a field out where a coupling brings it.
  /// @param boundaries of the field's mesh; empty for all @param who brings it
  /// @throws Error when the field has no such term, or a condition on one of the boundaries speaks of the
  /// same unknowns
  void leave_out(const std::string& field, const std::string& term,
                 const std::vector<std::string>& boundaries, const std::string& who);
  void add_measure(InterfaceMeasure measure) { measures_.push_back(std::move(measure)); }
  [[nodiscard]] const std::vector<InterfaceMeasure>& measures() const { return measures_; }
  /// Builds a constraint and ties unknowns as it says. When all fields are there, before finish().
  /// Collective.
  /// @throws Error when it does not go with the fields
  void add_constraint(std::unique_ptr<Constraint> constraint, const Location& where = {});
  [[nodiscard]] std::vector<const Constraint*> constraints() const;
  /// Lets the interface be found by its name in the scene.
  /// @param where it stands there, for messages
  void name_interface(const std::string& name, std::vector<InterfacePart> parts, const Location& where = {}) {
    interfaces_[name] = std::move(parts);
    interface_places_[name] = where;
  }
  [[nodiscard]] const std::map<std::string, std::vector<InterfacePart>>& interfaces() const {
    return interfaces_;
  }
  /// Called before each Newton iteration; returns true when it changed active unknowns, domains or prescribed
  /// values, after which the system is rebuilt. The return value must be the same on all ranks.
  using SpaceUpdate = std::function<bool(const TimePoint&)>;
  void add_space_update(SpaceUpdate update) { space_updates_.push_back(std::move(update)); }

  /// What is tied to what at the present states. Collective.
  [[nodiscard]] std::vector<Ties::Resolved> ties(const TimePoint& at);

  /// Restricts a field to some of its cells: terms on others are left out, and nodes that only those have
  /// carry no unknowns. Collective; rebuild the system afterwards (a SpaceUpdate returns true).
  /// @param active per local cell of the field's mesh, ghosts included
  void occupy(FieldEntry& entry, const std::vector<char>& active, const CutMesh* cut = nullptr);
  /// The bodies that cut a field's mesh: to add one, before finish().
  FieldCut& cut(FieldEntry& entry);

  /// Call once everything is added. Collective.
  /// @param time at which bodies cut meshes first
  /// @param shape_derivatives the tangent says how interfaces move with bodies; without, the cut counts as
  /// fixed in each iteration
  void finish(double time = 0, bool shape_derivatives = true);

  [[nodiscard]] Assembler& assembler() { return *assembler_; }
  [[nodiscard]] const Assembler& assembler() const { return *assembler_; }
  [[nodiscard]] const Communicator& communicator() const { return communicator_; }
  [[nodiscard]] std::vector<FieldEntry>& fields() { return fields_; }
  [[nodiscard]] const std::vector<FieldEntry>& fields() const { return fields_; }
  [[nodiscard]] FieldEntry& field(const std::string& name);
  /// What is integrated where.
  using DomainTerms = std::pair<std::shared_ptr<IntegrationDomain>, std::vector<BoundTerm>>;
  [[nodiscard]] const std::vector<DomainTerms>& domains() const { return domains_; }
  /// Whether bodies cut the mesh of some field.
  [[nodiscard]] bool is_cut() const {
    return std::ranges::any_of(fields_, [](const FieldEntry& entry) { return entry.cut != nullptr; });
  }
  /// Diameter of the smallest cell of the meshes that bodies cut, m. Collective.
  [[nodiscard]] double smallest_cut_cell() const;
  /// Seconds spent in cutting meshes and in carrying states over, for the report.
  [[nodiscard]] double cut_seconds() const { return cut_seconds_; }
  /// True when some unknown has a rate, so that time matters.
  [[nodiscard]] bool has_rates() const;

  /// A warning for each two boundaries that prescribe different values of an unknown at a node which both
  /// have: that of the condition added last counts. Collective, the same on all ranks.
  [[nodiscard]] std::vector<Diagnostic> find_conflicts(double time) const;
  /// Sets the initial values and rates.
  /// @param impose_prescribed let prescribed unknowns start at their value. Without it, as in a static
  /// problem, they go there in the first step and take the interior along, so that a sudden displacement
  /// crushes no cell.
  void initialise(double time, bool impose_prescribed = true);
  /// True when the scheme needs rates at the start that the scene does not give.
  [[nodiscard]] bool needs_initial_rates(double theta) const {
    return theta < 1 && has_rates() && !constrains_rates();
  }
  /// True when a field has an unknown with a first rate beside one without any: velocity and pressure of
  /// incompressible flow. Initial rates must then satisfy the constraint, too, which the balance at the start
  /// does not say: the first step is taken with theta = 1 instead and brings them.
  [[nodiscard]] bool constrains_rates() const;
  /// True when a term wants the rates at the start of each step to follow from the balance there.
  /// @throws Error when that cannot be, see constrains_rates()
  [[nodiscard]] bool needs_fresh_rates(double theta) const;
  /// Adds an increment of the highest rates (of the value, where an unknown has none): the solution of the
  /// system assembled with TimePoint::initial_rates.
  void add_initial_rates(const std::vector<double>& increment);
  /// Makes the present state the old one, predicts, and sets the prescribed values at the end of the step.
  /// @param from the time of the present state; a static problem's steps have no length that would tell
  void begin_step(const TimePoint& at, double from);
  void begin_step(const TimePoint& at) { begin_step(at, at.time - at.step); }
  /// Adds a part of an increment to the unknowns. What is tied goes that part of its way, on the relations as
  /// they are where the others have come to: in arcs around what turns. Collective.
  /// @param increment [owned row]
  /// @throws StepRefused when a relation does not bear it
  void add_increment(const std::vector<double>& increment, double part, const TimePoint& at);
  /// From now on states keep mean rates, and rates follow from them: with two_step_theta() the backward
  /// difference formula of second order (BDF2). Before the first step.
  void keep_mean_rates();
  /// Lets rates follow the values as the time scheme says, and those of what is tied from the others.
  /// @param relations whether what is tied counts: without, the scheme says all rates
  void update_rates(const TimePoint& at, bool relations = true);
  /// Cuts meshes anew, runs the space updates and rebuilds where needed. Collective.
  /// @throws StepRefused when a body moved further than states can be carried
  SpaceChange update_spaces(const TimePoint& at);
  /// The same of relations between unknowns alone, where cuts stay as they are. Collective.
  /// @return whether unknowns were numbered anew
  bool update_relations(const TimePoint& at);
  /// Where the level of an unknown is fixed at a node, as that of the pressure in a closed part of a fluid,
  /// the node's equation is given up for it. It holds all the same if what is prescribed goes together: what
  /// is left of it flows in or out at that node, where there is nothing. From the last assembly, with its
  /// tangent. Collective. @throws Error where this is more than a part of what flows anywhere
  void check_levels();
  /// From now to the end of the step unknowns of fields that bodies cut may come but not go.
  void hold_spaces();

  /// All that a step depends on and leaves behind: what a failed one is rewound to, to the bit. Those of the
  /// fields are in it.
  [[nodiscard]] StateStore& state() { return state_; }
  [[nodiscard]] const StateStore& state() const { return state_; }
  /// Of the present iteration within a step: without the states at the step's start, but where the sets of
  /// nodes may change, which reorders states.
  [[nodiscard]] StateStore::Snapshot iterate(const TimePoint& at) const;

 private:
  void set_prescribed(double time);
  void settle_start(double time);
  static void set_given(FieldEntry& entry, double time);
  SpaceChange update_cuts(const TimePoint& at);
  void add_swept_volumes();
  Ties ask_constraints(const TimePoint& at);
  bool update_ties(const TimePoint& at);
  void follow_relations(const std::vector<double>& remaining, const TimePoint& at);
  void carry_rates();
  void carry_rates(const std::vector<Ties::Resolved>& ties);
  void update_second_rates(const TimePoint& at, bool relations = true);
  void settle_rates(const TimePoint& at);
  Communicator communicator_;
  StateStore state_;
  std::vector<FieldEntry> fields_;
  std::vector<DomainTerms> domains_;
  std::map<std::string, std::vector<InterfacePart>> interfaces_;
  std::map<std::string, Location> interface_places_;
  std::vector<InterfaceMeasure> measures_;
  std::vector<std::pair<std::unique_ptr<Constraint>, Location>> constraints_;
  std::vector<const JoinsFields*> joins_;  ///< those of the constraints that are such
  std::vector<SpaceUpdate> space_updates_;
  SpaceChange unfinished_ = SpaceChange::none;  ///< of an update of spaces that was refused
  std::unique_ptr<Assembler> assembler_;
  double cut_seconds_ = 0;
};

/// The one-step-theta scheme at the end of a step; step 0 means a static problem.
TimePoint time_point(double time, double step, double theta);
/// Theta with which mean rates of the step before make the backward difference formula of second order
/// (BDF2).
/// @param previous length of the step before, s; 0 when there is none: then it is implicit Euler
double two_step_theta(double step, double previous);

}  // namespace seam
