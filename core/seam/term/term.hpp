// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace seam {

/// How an unknown (or a test function) enters at a point.
enum class Shape { value, gradient, normal_derivative, second_normal_derivative };

/// Which of an unknown's states enters. The differentiated ones depend on the unknown through the time
/// scheme; the old ones are those at the start of the step.
enum class Level { now, rate, second_rate, old, old_rate };

/// One of the unknowns a term speaks of, and where it lives.
struct Operand {
  int side = 0;  ///< 0 for cell and boundary terms; 0 or 1 on interior faces; the interface's side otherwise
  std::string unknown;
};

/// What a term reads (or, with Level::now, tests with) of one of its operands.
struct Slot {
  int operand = 0;
  Shape shape = Shape::value;
  Level level = Level::now;
  friend bool operator==(const Slot&, const Slot&) = default;
};

/// Number of operator rows of a shape: 1, or the space dimension for a gradient.
constexpr int rows(Shape shape, int dimension) { return shape == Shape::gradient ? dimension : 1; }

/// The interface of a term as the assembler sees it; made from the kernel's declarations by KernelTerm.
struct Signature {
  std::vector<int> components;  ///< of each operand; 0 of one that the kernel does not name
  std::vector<Slot> inputs;
  std::vector<Slot> outputs;
  /// Distinct (operand, shape) pairs of the differentiated inputs: the columns of the point tangent.
  std::vector<Slot> columns;
  /// For a quantity, which has no test functions: numbers per point.
  int values = 0;
  /// Whether the term can be differentiated with respect to where its points are, too.
  bool follows_motion = false;
  /// Whether the term depends on the start of a step in such a way that rates there have to follow from the
  /// balance at that instant, not, as the scheme with theta < 1 has it, from the step before.
  bool fresh_rates = false;

  [[nodiscard]] int input_size(int dim) const { return size(inputs, dim); }
  [[nodiscard]] int output_size(int dim) const { return size(outputs, dim); }
  [[nodiscard]] int column_size(int dim) const { return size(columns, dim); }

 private:
  [[nodiscard]] int size(const std::vector<Slot>& slots, int dim) const {
    int n = 0;
    for (const Slot& s : slots) n += components[s.operand] * rows(s.shape, dim);
    return n;
  }
};

/// A batch of quadrature points. All arrays are point-major.
struct PointBatch {
  int dimension = 2;
  int count = 0;
  const double* position = nullptr;    ///< [point][dimension], reference configuration of the side-0 mesh
  const double* normal = nullptr;      ///< [point][dimension], outward from side 0; null for cell terms
  const double* cell_size = nullptr;   ///< [point], diameter of side 0's cell
  const double* trace_size = nullptr;  ///< [point], see Point
  const double* partner_position = nullptr;        ///< [point][dimension], see Point; null without a side 1
  const double* constant[2] = {nullptr, nullptr};  ///< [point], see Point; null when the term has none
  const double* gap = nullptr;                     ///< [point], see Point; null where there is none
  const double* inputs = nullptr;  ///< [point][Signature::inputs], slot by slot: [component][row]
  double time = 0.0;               ///< the end of the step
  double step = 0.0;               ///< length of the step; 0 in a static problem
  double theta = 1.0;
  /// d(level)/d(now) of each operand for Level::now, rate, second_rate: what the time scheme makes of it.
  const double (*level_factor)[3] = nullptr;
  /// Where points move with the nodes of bodies and the tangent is to say how: the number of moves of a point
  /// (the dimension squared for each body), and the derivatives of what the term reads with respect to them.
  int moves = 0;
  const double* position_change = nullptr;  ///< [point][dimension][move]
  const double* normal_change = nullptr;    ///< [point][dimension][move]
  const double* partner_change = nullptr;   ///< [point][dimension][move]; null without a side 1
  const double* gap_change = nullptr;       ///< [point][move]
  const double* input_change = nullptr;     ///< [point][Signature::inputs][move]
};

/// An integrand: coefficients of the test functions at a point and their derivatives. Implement it by writing
/// a kernel and wrapping it in KernelTerm (seam/term/kernel_term.hpp).
class Term {
 public:
  virtual ~Term() = default;
  [[nodiscard]] virtual const Signature& signature(int dimension) const = 0;
  /// @param residual [point][outputs], overwritten
  /// @param tangent [point][outputs][columns + PointBatch::moves], overwritten; null when only the residual
  /// is wanted
  virtual void evaluate(const PointBatch& points, double* residual, double* tangent) const = 0;
  /// Polynomial degree the integrand adds to that of its shape functions; raises the quadrature.
  [[nodiscard]] virtual int extra_degree() const { return 0; }
};

}  // namespace seam
