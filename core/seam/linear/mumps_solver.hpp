// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "seam/linear/linear_solver.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/scene/schema.hpp"

namespace seam {

/// Distributed sparse LU factorisation by MUMPS. The symbolic analysis is kept while the pattern stays.
class MumpsSolver final : public LinearSolver {
 public:
  explicit MumpsSolver(const Parameters& parameters);
  MumpsSolver();
  ~MumpsSolver() override;
  MumpsSolver(const MumpsSolver&) = delete;
  MumpsSolver& operator=(const MumpsSolver&) = delete;
  static Schema schema();
  /// The analysis stays: it follows from the pattern alone.
  void forget() override;
  /// By the symbolic analysis alone.
  [[nodiscard]] std::optional<Effort> effort(const Matrix& a) override;

 protected:
  void solve_into(const Matrix& a, const std::vector<EquationBlock>& blocks, const std::vector<double>& b,
                  std::vector<double>& x, SolveReport& report) override;

 private:
  struct Instance;
  class KeptFactors;
  void analyse(const Matrix& a);
  void factorise(const Matrix& a);
  void remember_unknowns(const Matrix& a);
  [[nodiscard]] bool worth_keeping() const;
  void refine(const Matrix& a, const std::vector<double>& b, std::vector<double>& x);
  bool solve_with_kept(const Matrix& a, const std::vector<double>& b, std::vector<double>& x,
                       SolveReport& report);
  std::shared_ptr<Instance> instance_;
  int keep_ = 0;  ///< most iterations that are worth a factorisation
};

}  // namespace seam
