// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "seam/base/diagnostics.hpp"
#include "seam/linear/equation_block.hpp"
#include "seam/linear/matrix.hpp"

namespace seam {

class Registry;

/// What a solve took.
struct SolveReport {
  /// |b - A x| / |b|, computed from the matrix after the solve; entries weighed, see LinearSolver::weights
  double relative_residual = 0;
  int iterations = 0;  ///< 0 for a direct solve
  bool new_factorisation = true;
  double setup_seconds = 0;
  double solve_seconds = 0;
};

/// The matrix has no inverse. `equations` are those the factorisation failed at, as far as it knows.
class SingularMatrix : public Error {
 public:
  SingularMatrix(const std::string& message, std::vector<long long> at)
      : Error(message), equations(std::move(at)) {}
  std::vector<long long> equations;
};

/// Solves A x = b. A type of kind "linear_solver": solve_into() solves, solve() sees whether it is true.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// Collective. @param b, x [owned row]
  /// @throws SingularMatrix, or Error when the true residual stays above the tolerance
  SolveReport solve(const Matrix& a, const std::vector<EquationBlock>& blocks, const std::vector<double>& b,
                    std::vector<double>& x);
  /// Drops what is kept from one solve to the next: the next one is as if it were the first.
  virtual void forget() {}
  /// What a factorisation takes, of all ranks.
  struct Effort {
    double bytes = 0, operations = 0;
  };
  /// What this will take for a matrix, where it can be known beforehand. Collective.
  [[nodiscard]] virtual std::optional<Effort> effort(const Matrix& a);
  /// Which solver one that chooses has chosen, and why; empty for all others.
  [[nodiscard]] virtual std::string choice() const { return ""; }

 protected:
  virtual void solve_into(const Matrix& a, const std::vector<EquationBlock>& blocks,
                          const std::vector<double>& b, std::vector<double>& x, SolveReport& report) = 0;
  /// [owned row]: entries of residuals are measured times these, as they have units of their own.
  [[nodiscard]] const std::vector<double>& weights() const { return weights_; }
  /// A relative residual above this is an error.
  double acceptable_residual_ = 1e-6;

 private:
  std::vector<double> weights_;
};

/// y = A x. Collective. @param x, y [owned row]
void multiply(const Matrix& a, const std::vector<double>& x, std::vector<double>& y);
/// The same for several vectors.
[[nodiscard]] std::vector<std::vector<double>> multiply(const Matrix& a,
                                                        const std::vector<std::vector<double>>& x);

/// Euclidean norm over all ranks. Collective.
double norm(const Communicator& communicator, const std::vector<double>& x);

/// Registers "auto", "direct" and "krylov".
void register_linear_solvers(Registry& registry);

}  // namespace seam
