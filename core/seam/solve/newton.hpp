// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "seam/linear/linear_solver.hpp"
#include "seam/solve/problem.hpp"

namespace seam {

struct NewtonOptions {
  /// On each unknown's residual, relative to Assembler::magnitude.
  double tolerance = 1e-8;
  /// On what is left to add to each unknown, relative to its change in the step. A slender body bends with
  /// forces that are small beside those it would stretch with: there the residual alone says little.
  double increment_tolerance = 1e-5;
  int maximum_iterations = 25;
  bool damping = true;  ///< shorten steps that lead to an inadmissible state or a much larger residual
};

/// A system in which something may change as it likes, by the scene: what() names the fields.
class NothingHolds : public SingularMatrix {
 public:
  using SingularMatrix::SingularMatrix;
};

/// One iteration, as it is written to the summary.
struct NewtonIteration {
  double residual = 0;   ///< largest of the unknowns' relative residuals
  std::string worst;     ///< "field.unknown" it belongs to
  double increment = 0;  ///< largest of the unknowns' relative increments that led here
  double damping = 1;    ///< part of the increment that was taken to get here
  int linear_iterations = 0;
  double linear_residual = 0;
  bool space_changed = false;
};

struct NewtonReport {
  bool converged = false;
  std::string reason;   ///< when not converged, or why what acts was raised in shares
  bool frozen = false;  ///< the cut was not updated in the last iterations, see Newton::solve
  std::vector<NewtonIteration> history;
  double linear_seconds = 0;
  int shares = 0;  ///< in which what acts was raised, see LoadShare; 0: it acted at once
  /// Adds an attempt at a share of what acts, as converged as that is.
  void add(const NewtonReport& share);
  /// Linear systems solved on the way to the last state.
  [[nodiscard]] int iterations() const { return history.empty() ? 0 : static_cast<int>(history.size()) - 1; }
};

/// Newton's method for one step, with an exact tangent (thesis 2.3, (2.126)-(2.128)).
///
/// What a body exerts on a field jumps a little where its surface crosses sides of the field's cells, all
/// along a side that it happens to be parallel to. A solution may lie in such a jump: then there is none, and
/// iterations cycle. When they do the cut is frozen, which makes the problem smooth (thesis 6.3.1, where it
/// always is), and once that is solved it is freed again, since cycles have other reasons, too. Where they
/// come back it stays frozen; the step is taken when bodies have moved by no more than a hundredth of a cell
/// since.
class Newton {
 public:
  Newton(Problem& problem, LinearSolver& solver, NewtonOptions options)
      : problem_(problem), solver_(solver), options_(options) {}

  /// Begins a step whose states the problem has predicted.
  void begin(const TimePoint& step);
  /// Takes one iteration. On failure the states are left as they are: rewind them.
  /// @return true while there is something left to do; then report() says how it went
  /// @throws SingularMatrix when the system is singular: NothingHolds where it names the field that is not
  /// held
  /// @throws StepRefused when bodies move too far for the step
  bool iterate();
  [[nodiscard]] const NewtonReport& report() const { return report_; }
  /// Iterates to the end of the step.
  NewtonReport solve(const TimePoint& step);
  /// Solves for the rates that the initial values imply (needed by theta < 1).
  void solve_initial_rates(double time);

 private:
  struct Size {
    double residual = 0;  ///< largest of the unknowns' relative residuals; not finite if something is not
    std::string worst;
    double increment = 0;
    bool at_rounding = false;  ///< every unknown's residual is what the rounding of its equations leaves
  };
  /// @param increment what was added last, times `factor`; empty at the start of a step
  /// @param rounding [owned row], see Assembler::rounding(); empty: not looked at
  [[nodiscard]] Size measure(const std::vector<double>& increment, double factor,
                             const std::vector<double>& rounding = {}) const;
  Size measure_with_rounding(const NewtonIteration& entry);
  bool fail(std::string reason);
  [[nodiscard]] std::string refusal() const;
  [[nodiscard]] bool converged(const NewtonIteration& entry, const Size& last) const;
  bool finish();
  bool take(NewtonIteration& entry);
  bool follow(NewtonIteration& entry);
  void solve_linear(std::vector<double>& increment, SolveReport& report);
  void require_sense(const std::vector<double>& increment) const;
  /// Whether iterations repeat themselves instead of converging.
  [[nodiscard]] bool cycles() const;
  void freeze(bool frozen);
  /// How far the last increment moved anything, m.
  [[nodiscard]] std::vector<double> motions() const;
  [[nodiscard]] double way_since_freezing() const;
  Problem& problem_;
  LinearSolver& solver_;
  NewtonOptions options_;

  // Of the step under way.
  TimePoint at_;
  NewtonReport report_;
  std::vector<double> increment_;
  Size size_;
  int iteration_ = 0;
  bool starts_ = true;  ///< at states without an increment that led there
  int stuck_ = 0;       ///< iterations in a row in which the residual has not fallen
  int shortened_ = 0;   ///< increments in a row that were not taken whole
  bool frozen_ = false;
  int freezes_ = 0;
  std::size_t freed_ = 0;          ///< the iteration from which on the cut has followed
  std::vector<double> frozen_at_;  ///< motions() when the cut was frozen
  double far_ = 0;                 ///< how far it may, m
  long long held_ = -1;            ///< pattern for which it is known that nothing changes without resistance
  std::string not_finite_;         ///< what was not in the last state that was tried
  std::string refused_;            ///< why a part of an increment of this step was, last; "" if none was
};

/// Part of its size that is left of a sum of some hundred terms that ought to be zero, and somewhat more.
inline constexpr double no_resistance = 1e-13;
/// Fields of which a connected part can change without more than some resistance in the present matrix.
struct FreeModes {
  std::string text;  ///< names them, one line each; "" if there is none
  bool of_bodies =
      false;  ///< all of them are bodies without deformation, which stand as long as nothing acts
};
/// @param resistance as a part of what a field's equations are made of
/// @param levels_only looks at constants of scalars alone, as of a pressure. Collective.
FreeModes describe_free_modes(Problem& problem, double resistance, bool levels_only = false);

/// Names the fields that can move without resistance in the present matrix, one line each; "" if none can.
std::string describe_unsupported(Problem& problem, const std::vector<long long>& equations);

}  // namespace seam
