// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "seam/linear/linear_solver.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/scene/schema.hpp"

namespace seam {

/// What approximates the inverse of a field's block.
struct FieldInverses {
  bool
      multigrid;  ///< for blocks of one unknown a node or of a displacement, else an incomplete factorisation
  bool schur;     ///< a Schur complement for blocks with constraints
  int fill;       ///< levels of fill-in of incomplete factorisations
};

/// GMRES (Belos), preconditioned by block Gauss-Seidel over the blocks of the fields; each block by
/// smoothed aggregation (MueLu, with the rigid body modes as near-null space where the block is a vector) or
/// by incomplete factorisation (Ifpack2), those of a flow also by SIMPLE. The preconditioner is kept while
/// iteration counts stay low.
class KrylovSolver final : public LinearSolver {
 public:
  explicit KrylovSolver(const Parameters& parameters);
  ~KrylovSolver() override;
  KrylovSolver(const KrylovSolver&) = delete;
  KrylovSolver& operator=(const KrylovSolver&) = delete;
  static Schema schema();
  void forget() override;

 protected:
  void solve_into(const Matrix& a, const std::vector<EquationBlock>& blocks, const std::vector<double>& b,
                  std::vector<double>& x, SolveReport& report) override;

 private:
  struct Preconditioner;
  [[nodiscard]] bool worth_keeping(const Matrix& a) const;
  void solve_preconditioned(const Matrix& a, const std::vector<EquationBlock>& blocks,
                            const std::vector<double>& b, std::vector<double>& x, SolveReport& report);
  double tolerance_;
  int maximum_iterations_;
  int restart_;
  double keep_;
  FieldInverses use_;
  std::unique_ptr<Preconditioner> preconditioner_;
};

/// Rigid body modes of the block's nodes: 3 vectors in 2D, 6 in 3D, over the block's local rows.
std::vector<std::vector<double>> rigid_body_modes(const EquationBlock& block);

}  // namespace seam
