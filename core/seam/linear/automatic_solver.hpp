// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "seam/linear/linear_solver.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/scene/schema.hpp"

namespace seam {

class Registry;

/// Takes a factorisation while that is cheap, and an iterative solver where it is not: by what the symbolic
/// analysis says, which knows what a scene's dimension, size and couplings come to.
class AutomaticSolver final : public LinearSolver {
 public:
  /// @param registry of the solvers
  AutomaticSolver(const Parameters& parameters, const Registry& registry);
  ~AutomaticSolver() override;
  AutomaticSolver(const AutomaticSolver&) = delete;
  AutomaticSolver& operator=(const AutomaticSolver&) = delete;
  static Schema schema();
  void forget() override;
  [[nodiscard]] std::optional<Effort> effort(const Matrix& a) override;
  [[nodiscard]] std::string choice() const override { return choice_; }

 protected:
  void solve_into(const Matrix& a, const std::vector<EquationBlock>& blocks, const std::vector<double>& b,
                  std::vector<double>& x, SolveReport& report) override;

 private:
  void choose(const Matrix& a);
  void take(bool factorises, const std::string& reason);
  const Registry* registry_;
  Parameters direct_, iterative_;
  std::unique_ptr<LinearSolver> solver_;  ///< that is used now
  bool factorises_ = true;                ///< whether solver_ is the direct one
  bool fits_ = true;                      ///< whether a factorisation would fit into memory
  long long rows_ = 0;                    ///< of the system that was chosen for
  std::string choice_;
};

}  // namespace seam
