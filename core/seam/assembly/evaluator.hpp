// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "seam/assembly/bound_term.hpp"
#include "seam/assembly/contraction.hpp"
#include "seam/assembly/element.hpp"
#include "seam/assembly/time_point.hpp"
#include "seam/term/term.hpp"

namespace seam {

class Field;
struct Block;

/// Computes element vectors and matrices of all terms of a domain. Rows and columns of an element are ordered
/// by part (one per side and block in use), then component, then node, padded: component-major, so that the
/// inner loops run over nodes in full vector registers.
///
/// Where the domain's points move with a body, the tangent says how the integrals change with them: points,
/// weights, normals and the traces of all sides there are differentiated with respect to the body's nodes.
class ElementEvaluator {
 public:
  using Role = ElementRole;
  ElementEvaluator(const IntegrationDomain& domain, const std::vector<BoundTerm>& terms,
                   Role role = Role::integrate);
  ~ElementEvaluator();
  ElementEvaluator(const ElementEvaluator&) = delete;
  ElementEvaluator& operator=(const ElementEvaluator&) = delete;

  /// One block on one side.
  struct SideBlock {
    int side;
    int block;
    Block* states;
    int nodes;   ///< per element
    int stride;  ///< nodes, padded to a multiple of 4: components are so far apart
    int components;
    int offset;  ///< first row
  };
  [[nodiscard]] const std::vector<SideBlock>& side_blocks() const { return side_blocks_; }
  [[nodiscard]] int size() const { return size_; }
  /// Whether a term reads second rates.
  [[nodiscard]] bool has_inertia() const { return level_used_[static_cast<int>(Level::second_rate)]; }

  /// Evaluates element `index` at the present states.
  void compute(int index, const TimePoint& at, bool with_tangent);
  /// Evaluates a quantity at the points of element `index`: the first of the terms that holds there.
  /// @return [point][Signature::values]; empty where none does
  const std::vector<double>& compute_values(int index, const TimePoint& at);
  /// Names the first term of element `index` that reads or gives what is no finite number at the present
  /// states, with its unknowns, cell and point; "" where all is finite.
  [[nodiscard]] std::string describe_not_finite(int index, const TimePoint& at);
  [[nodiscard]] const Element& element() const { return element_; }
  /// [row]
  [[nodiscard]] const std::vector<double>& residual() const { return residual_; }
  /// What the residual's size is measured by, [row]: the sum of the absolute contributions of all terms and
  /// points and, with the tangent, |K| |change since the start of the step|, which sees forces that cancel
  /// within a term.
  [[nodiscard]] const std::vector<double>& magnitude() const { return magnitude_; }
  /// [row][column]
  [[nodiscard]] const std::vector<double>& matrix() const { return matrix_; }

 private:
  struct BoundOperand {
    int side_block;
    int offset;  ///< first component within the block
    int components;
  };
  struct Compiled {
    BoundTerm bound;
    const Signature* signature;
    std::vector<BoundOperand> operands;
    int inputs, outputs, columns;
  };
  /// Shape operators of a part at the element's points.
  struct Operators {
    const double* value = nullptr;  ///< [point][stride]
    std::vector<double> gradient;   ///< [point][direction][stride]
    std::vector<double> normal;     ///< [point][stride]
    std::vector<double> second_normal;
    /// Derivatives of the gradient with respect to the reference coordinates of the point,
    /// [point][reference direction][direction][stride].
    std::vector<double> gradient_change;
    bool needs_gradient = false, needs_normal = false, needs_second_normal = false;
    [[nodiscard]] const double* of(Shape shape) const;
  };

  void find_side_blocks(const IntegrationDomain& domain, const std::vector<BoundTerm>& terms);
  int add_side_block(Field& field, const Operand& operand);
  void compute_operators();
  void compute_normal_operators(int side_block);
  void gather();
  void add_change_to_magnitude();
  [[nodiscard]] std::string describe_not_finite(const Compiled& term) const;
  [[nodiscard]] std::string place_of(int point) const;
  void compute_inputs(const Compiled& term);
  void evaluate(const Compiled& term, const TimePoint& at, bool with_tangent);
  void add_residual(const Compiled& term);
  void add_tangent(const Compiled& term);

  // What moving points add (evaluator_motion.cpp).
  void compute_gradient_change(int side_block);
  void compute_reference_motion();
  void compute_partner_motion();
  void compute_input_change(const Compiled& term);
  /// Derivative of row i of a slot's shape functions with respect to reference coordinate j, [stride].
  [[nodiscard]] const double* shape_change(const Slot& slot, int side_block, int point, int j, int i) const;
  /// One direction of one component of a slot's test functions at a point.
  struct TestRow {
    const Slot* slot;
    int side_block;
    std::size_t point;
    int direction;
    std::size_t output;   ///< its coefficient, in all points' outputs
    const double* shape;  ///< [node]
    int nodes;            ///< padded
  };
  template <class Add>
  void add_moves(const Compiled& term, const Add& add);
  void add_outer(const TestRow& row, const double* shape, const double* change);
  void add_motion_tangent(const Compiled& term);
  void add_sweep(const Compiled& term);
  void scatter_moves(int q, int row, int count, const double* rows);

  const IntegrationDomain* domain_;
  int dim_ = 2;
  std::vector<SideBlock> side_blocks_;
  std::vector<Compiled> terms_;
  std::vector<Operators> operators_;
  int size_ = 0;
  Element element_;
  /// Nodal values of every level, [level][row].
  std::vector<double> local_[5];
  bool level_used_[5] = {true, false, false, false, false};
  std::vector<double> inputs_, point_residual_, point_tangent_, scratch_, change_;
  Contraction work_;
  Role role_;
  bool moves_now_ = false;  ///< the element under work is differentiated with respect to its points' motion
  struct Mover {
    int side_block, offset;
  };
  std::vector<Mover> movers_;                          ///< where the unknowns that move the points are
  int moves_ = 0;                                      ///< of each point
  std::vector<std::vector<double>> reference_motion_;  ///< [side][point][reference direction][move]
  std::vector<double> input_change_, partner_motion_, moved_;
  std::vector<double> residual_, magnitude_, matrix_;
};

}  // namespace seam
