// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "seam/linear/block_inverse.hpp"
#include "seam/linear/linear_solver.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/scene/schema.hpp"

namespace seam {

class Registry;

/// GMRES (Belos), preconditioned by block Gauss-Seidel over the fields, each by a block inverse (see
/// BlockInverse). The preconditioner is kept while iteration counts stay low.
class KrylovSolver final : public LinearSolver {
 public:
  /// @param registry of the block inverses
  KrylovSolver(const Parameters& parameters, const Registry& registry);
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
  [[nodiscard]] bool kept_one_does(const Matrix& a, const std::vector<EquationBlock>& blocks,
                                   const std::vector<double>& b, std::vector<double>& x, SolveReport& report);
  /// @return iterations
  int iterate(const Matrix& a, const std::vector<EquationBlock>& blocks, const std::vector<double>& b,
              std::vector<double>& x, int most, SolveReport& report);
  [[nodiscard]] double leaves(const Matrix& a, const std::vector<double>& b,
                              const std::vector<double>& x) const;
  [[nodiscard]] std::unique_ptr<BlockInverse> make_inverse(const EquationBlock& block) const;
  void require_fields(const std::vector<EquationBlock>& blocks) const;
  const Registry* registry_;
  Parameters inverse_;                                          ///< of all fields but these:
  std::vector<std::pair<std::string, Parameters>> inverse_of_;  ///< by field
  double tolerance_;
  int maximum_iterations_;
  int restart_;
  double keep_;
  int more_fill_ = 0;  ///< of incomplete factorisations, since those that the scene asks for did not do
  std::unique_ptr<Preconditioner> preconditioner_;
};

}  // namespace seam
