// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "seam/assembly/bound_term.hpp"
#include "seam/assembly/entry_sums.hpp"
#include "seam/assembly/node_graph.hpp"
#include "seam/assembly/ties.hpp"
#include "seam/linear/equation_block.hpp"
#include "seam/linear/matrix.hpp"

namespace seam {

class ElementEvaluator;
class Field;
class IntegrationDomain;
class RowLaw;
struct Block;
struct TimePoint;

/// Turns fields and terms into one distributed nonlinear system. Unknowns are the active ones of all blocks
/// of all fields; those of a node are contiguous. The set of active unknowns, of elements and of prescribed
/// values may change at any time: call rebuild() afterwards. States live in the fields, not here, so nothing
/// is lost.
class Assembler {
 public:
  Assembler(std::vector<Field*> fields, const Communicator& communicator);
  ~Assembler();
  Assembler(const Assembler&) = delete;
  Assembler& operator=(const Assembler&) = delete;

  /// Adds terms to be integrated over a domain.
  void add(const std::shared_ptr<const IntegrationDomain>& domain, const std::vector<BoundTerm>& terms,
           ElementRole role = ElementRole::integrate);

  /// Ties unknowns from now on, in the place of those tied before. Collective.
  /// @return true when what is tied to what has changed: then rebuild() has to follow
  bool tie(std::vector<Ties::Resolved> ties, const std::vector<Ties::Axes>& axes = {});
  /// Keeps the residual of the last assembly, for leave_out().
  void keep_residual();
  /// From now on assemble() takes this part of the residual that was kept out of the present one.
  void leave_out(double part) { left_out_ = part; }
  /// Gives tied unknowns the values that follow from what they are tied to. Collective.
  void settle();
  /// Gives tied unknowns the rates that follow from those of what they are tied to. Collective.
  void settle_rates();
  /// The same of second rates, at the start. Collective.
  void settle_second_rates();
  /// The same where all that is followed is given; else the time scheme says second rates. Collective.
  void settle_given_second_rates();
  /// The change of all unknowns, or of the highest rates of those that have some, that that of those which
  /// are not tied brings. Collective.
  /// @param increment [owned row]
  [[nodiscard]] std::vector<double> with_tied(std::vector<double> increment) const;
  /// Whether an owned row's unknown is tied to others.
  [[nodiscard]] bool is_tied(int row) const { return relation_[row] >= 0; }
  /// Those of unknowns that this rank holds.
  [[nodiscard]] const std::vector<Ties::Resolved>& ties() const { return resolved_; }
  /// Lets unknowns that others are tied to begin a step with the momentum that these hand on, at the present
  /// states and relations. Collective.
  void begin_momentum(const TimePoint& at);
  /// The step has inertia as forces: the next one with momentum begins anew.
  void forget_momentum();
  /// Numbers the active unknowns and builds the pattern. Collective.
  void rebuild();
  /// Sets residual, magnitude and (with_tangent) matrix at the present states of the fields. Collective.
  /// @throws StepRefused on all ranks when a term refuses the step on one
  void assemble(const TimePoint& at, bool with_tangent);
  /// Whether all that was assembled last is: residual, magnitude and matrix. The same on all ranks.
  [[nodiscard]] bool is_finite() const { return is_finite_; }
  /// Says what is not finite at the present states: the term, what it speaks of, the cell and the point; ""
  /// when everything is. Evaluates terms one by one: not for every step. Collective.
  [[nodiscard]] std::string describe_not_finite(const TimePoint& at);
  /// What the rounding of unknowns makes of the residual, [owned row]: the matrix times the spacing of
  /// floating-point numbers at the unknowns, now or when the step began, added up as what goes up as often as
  /// down. Displacements count as no less than a cell is wide: what they are is seen beside the 1 of the
  /// deformation gradient. From the last matrix. Collective.
  [[nodiscard]] std::vector<double> rounding() const;
  /// A number for each unknown: a component of a block at a local node.
  using PerUnknown = std::function<double(const Field& field, const Block& block, int node, int component)>;
  /// The last matrix, each entry by its size, times sizes of the unknowns, [owned row]. What other ranks
  /// alone know of is left out.
  [[nodiscard]] std::vector<double> absolute_product(const PerUnknown& size) const;
  /// The largest size of a number in each kind of equations, which have units of their own: the components of
  /// each block. Collective. @param of_rows [owned row]
  [[nodiscard]] std::vector<double> largest_by_kind(const std::vector<double>& of_rows) const;

  [[nodiscard]] const Matrix& matrix() const { return matrix_; }
  /// [owned row]; zero where the unknown is prescribed or tied.
  [[nodiscard]] const std::vector<double>& residual() const { return residual_; }
  /// What the linear system is to be solved for: the residual, plus the tangent's action on the way that
  /// prescribed and tied unknowns have still to go. So a moved boundary takes the interior along in the first
  /// iteration.
  [[nodiscard]] const std::vector<double>& right_side() const { return right_side_; }
  /// True when some prescribed or tied unknown has not reached its value. Collective.
  [[nodiscard]] bool prescribed_pending() const;
  /// [owned row]; where an unknown is prescribed or tied, the force that holds it. What tied unknowns hand on
  /// is in it.
  [[nodiscard]] const std::vector<double>& full_residual() const { return full_residual_; }
  /// [owned row]; sum of the absolute contributions of all elements: what the residual's size is measured by.
  [[nodiscard]] const std::vector<double>& magnitude() const { return magnitude_; }

  /// states += factor * increment on all active unknowns; prescribed ones go that part of their way. Updates
  /// ghosts. Collective.
  /// @param increment [owned row]
  void add_increment(const std::vector<double>& increment, double factor);
  /// How far tied unknowns are from what relations say, zeros for those of other ranks.
  [[nodiscard]] std::vector<double> ways_of_ties() const;
  /// Whether coefficients of relations change with the state, on any rank.
  [[nodiscard]] bool has_turning_ties() const { return has_turning_ties_; }
  /// Lets tied unknowns follow, by relations as they are now, all but a rest of the way. Collective.
  /// @param remaining as ways_of_ties() has them
  /// @return whether some had to move by more than rounding
  bool follow_ties(const std::vector<double>& remaining);
  /// Row of an owned unknown, -1 when its node is inactive.
  [[nodiscard]] int row(const Field& field, int block, int node, int component) const;
  [[nodiscard]] const std::vector<Field*>& fields() const { return fields_; }
  /// One entry per block of each field, in the order of the rows.
  [[nodiscard]] std::vector<EquationBlock> equation_blocks() const;
  /// Seconds spent in element loops and in building patterns, for the report.
  [[nodiscard]] double assembly_seconds() const { return assembly_seconds_; }
  [[nodiscard]] double pattern_seconds() const { return pattern_seconds_; }

 private:
  struct Group {
    std::shared_ptr<const IntegrationDomain> domain;
    std::unique_ptr<ElementEvaluator> evaluator;
    std::vector<int> block_of_side_block;  ///< index into blocks_
  };
  struct NumberedBlock {
    Field* field;
    Block* block;
    std::vector<int> node_index;  ///< local node -> index of NodeGraph, -1 when inactive
  };

  struct LocalUnknown {
    int block;          ///< index into blocks_
    std::size_t state;  ///< index into the values of the block
    int unknown;        ///< local number, -1 where it is not active
  };
  /// A tie of an unknown of the system, in local numbers.
  struct Tie {
    UnknownPlace::Key key;
    LocalUnknown tied;
    double constant;
    double scale;      ///< size that its values have by nature, 0: none
    double by_itself;  ///< rate that it has with the clock
    struct To {
      LocalUnknown to;
      double coefficient, handed;
    };
    std::vector<To> to;
    struct Change {
      LocalUnknown row, with;  ///< not active: the clock
      double derivative, by_motion;
    };
    std::vector<Change> changes;
  };
  void number_unknowns();
  void name_unknowns();
  void number_ties();
  void number_changes(const Ties::Resolved& from, Tie& tie) const;
  [[nodiscard]] double rate_of(const LocalUnknown& unknown) const;
  [[nodiscard]] bool is_given(const Tie& tie) const;
  void settle_second_rate(const Tie& tie);
  [[nodiscard]] bool has_rate(const LocalUnknown& unknown, int order) const;
  [[nodiscard]] LocalUnknown find(const UnknownPlace& place) const;
  [[nodiscard]] double value_of(const LocalUnknown& unknown) const;
  void add_tied_nodes(NodeGraph::Elements& elements) const;
  [[nodiscard]] double tied_value(const Tie& tie) const;
  [[nodiscard]] double size_of(const Tie& tie) const;
  [[nodiscard]] double way_of(const Tie& tie) const;
  [[nodiscard]] bool ties_pending() const;
  [[nodiscard]] std::vector<double> scales(const NumberedBlock& b) const;
  void find_pending();
  void collect_elements(NodeGraph::Elements& elements) const;
  void assemble_group(Group& group, const TimePoint& at, bool with_tangent);
  void scatter_vector(const ElementEvaluator& element, bool with_tangent);
  void scatter_matrix(const ElementEvaluator& element);
  [[nodiscard]] bool element_turns() const;
  void scatter_rate_matrix(const ElementEvaluator& element, double rate_factor);
  template <class Use>
  void for_each_row(const ElementEvaluator& element, const double* column, const Use& use) const;
  /// The part of an element matrix that belongs to a pair of nodes.
  struct NodeBlock {
    const double* from;
    std::ptrdiff_t row_stride;
    int column_stride;
    int rows, columns;
  };
  void add_free_block(int row_node, int column_node, const NodeBlock& block);
  void add_related_block(int row_node, int column_node, const NodeBlock& block);
  /// The equations of an unknown with a law, at an owned node where none of its components is given or tied.
  struct LawRows {
    const RowLaw* law;
    int first;          ///< row
    std::size_t block;  ///< index into blocks_
    std::size_t state;  ///< index into the values of the block
    double share;
  };
  void number_laws();
  void apply_laws(bool with_tangent);
  void meet_laws_as_they_are();
  void hold_unreached(bool with_tangent);
  void add_to_row(int row, double entry, int column);
  void add_related_sums();
  void hand_on(const Tie& tie, double residual, double magnitude, bool with_tangent);
  void hold_related(bool with_tangent);
  void find_element_nodes(const Group& group, int element);
  template <class Use>
  void for_each_own(const Use& use) const;
  void take_out_kept();
  void assemble_momentum(Group& group, int element, const TimePoint& at, bool with_tangent);
  [[nodiscard]] double turned_part(const Tie& tie, const Tie::To& to) const;
  void hand_on_momentum(const ElementEvaluator& element, const Tie& tie, const double* row,
                        double rate_factor);
  void balance_momentum(const TimePoint& at);
  void in_axes_that_stay(std::vector<double>& local) const;
  void in_axes_that_turn(std::vector<double>& local) const;
  [[nodiscard]] std::vector<double> turned_on(const std::vector<double>& local) const;
  template <class Change>
  void change_at_axes(const std::vector<double>& from, std::vector<double>& to, const Change& change) const;
  void settle_ties(const std::vector<double>& remaining);
  /// Position of an entry among the values of the matrix.
  [[nodiscard]] double& value_at(int row, int column) {
    const int row_node = node_of_[row], column_node = node_of_[column];
    const NodeGraph::BlockEntries at = graph_.place(row_node, column_node);
    return matrix_.value
        .data[at.first + at.row_length * static_cast<std::size_t>(row - graph_.node(row_node).first) +
              static_cast<std::size_t>(column - graph_.node(column_node).first)];
  }
  [[nodiscard]] bool all_finite(bool with_tangent) const;
  /// Sum of term(entry, number) over each owned row.
  template <class Term>
  [[nodiscard]] std::vector<double> sum_rows(const PerUnknown& vector, const Term& term) const;

  std::vector<Field*> fields_;
  Communicator communicator_;
  std::vector<Group> groups_;
  std::vector<NumberedBlock> blocks_;
  NodeGraph graph_;
  Matrix matrix_;
  static constexpr int is_free = -1, is_prescribed = -2;
  std::vector<int> relation_;  ///< per local unknown (owned and ghost): one of these, or an index into ties_
  std::vector<char> node_has_relations_;
  std::vector<double> pending_;    ///< per local unknown with a relation: how far it has still to go
  bool has_given_ties_ = false;    ///< those that `is_given`, on any rank
  bool has_turning_ties_ = false;  ///< on any rank: coefficients change with the state
  std::vector<LawRows> laws_;
  /// [block][unknown of a local node]: of a surface, with no term that speaks of it. Whoever is numbered
  /// anew.
  std::vector<std::vector<char>> is_unreached_;
  std::vector<Ties::Resolved> resolved_;
  std::vector<Tie> ties_;
  std::vector<int> node_of_;                              ///< [local unknown]: node of the graph
  std::vector<int> first_of_node_;                        ///< [node of the graph]: its first local unknown
  bool has_ties_ = false;                                 ///< on any rank
  std::vector<double> local_residual_, local_magnitude_;  ///< owned and ghost unknowns
  /// What tied unknowns hand on to each local unknown: momentum, and the rate of it that second rates make.
  std::vector<double> local_momentum_, local_momentum_rate_;
  std::vector<Ties::Axes> axes_;
  std::vector<int> turn_of_;  ///< per local unknown: about which of three axes that turn, or -1
  double left_out_ = 0;       ///< part of `kept_residual_`
  std::vector<std::vector<double>> kept_residual_;      ///< [block][unknown of a local node]
  std::vector<std::vector<double>> momentum_at_start_;  ///< of the step, [block][unknown of a local node]
  std::vector<double> local_lift_;                      ///< the tangent's action on pending prescribed values
  std::vector<double> residual_, right_side_, full_residual_, magnitude_;
  std::vector<int> element_nodes_;
  EntrySums related_;  ///< of the element's matrix, what relations take to other rows and columns
  bool is_finite_ = true;
  double assembly_seconds_ = 0, pattern_seconds_ = 0;
};

/// Lets the tangent be the derivative by rates and second rates, times these, alone.
[[nodiscard]] TimePoint by_rates(TimePoint at, double rate_factor, double second_rate_factor);

}  // namespace seam
