// SPDX-License-Identifier: BSD-3-Clause
#include "seam/linear/krylov_solver.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "seam/base/stopwatch.hpp"
#include "seam/linear/block_gauss_seidel.hpp"
#include "seam/linear/gmres.hpp"
#include "seam/plugin/registry.hpp"

namespace seam {

struct KrylovSolver::Preconditioner {
  Teuchos::RCP<BlockGaussSeidel> apply;
  long long pattern_version;
  int first_iterations = 0;  ///< of the solve right after it was built
  int last_iterations = 0;
};

KrylovSolver::KrylovSolver(const Parameters& p, const Registry& registry)
    : registry_(&registry),
      inverse_(p.object("preconditioner")),
      inverse_of_(p.map("fields")),
      tolerance_(p.number("tolerance")),
      maximum_iterations_(static_cast<int>(p.integer("maximum_iterations"))),
      restart_(static_cast<int>(p.integer("restart"))),
      keep_(p.number("keep")) {
  acceptable_residual_ = 100 * tolerance_;
}

KrylovSolver::~KrylovSolver() = default;

void KrylovSolver::forget() {
  preconditioner_.reset();
  more_fill_ = 0;
}

Schema KrylovSolver::schema() {
  Schema s(
      "GMRES, preconditioned field by field (multigrid, Schur complements, incomplete factorisations), for "
      "large systems.");
  s.number("tolerance", "Relative residual to reach").otherwise("1e-9").above(0).below(1);
  s.integer("maximum_iterations", "Iterations after which the solve has failed")
      .otherwise("1000")
      .at_least(1);
  s.integer("restart", "Size of the Krylov space").otherwise("150").at_least(2);
  s.typed("preconditioner", "What approximates the inverse of each field's equations", "block_inverse")
      .otherwise("schur");
  s.typed_map("fields", "The same for single fields, by their names", "block_inverse").otherwise("{}");
  s.number(
       "keep",
       "The preconditioner is kept while iterations stay below this multiple of its first solve's; 0: never")
      .otherwise("1.5")
      .at_least(0);
  return s;
}

std::unique_ptr<BlockInverse> KrylovSolver::make_inverse(const EquationBlock& block) const {
  const auto own = std::ranges::find(inverse_of_, block.field, &std::pair<std::string, Parameters>::first);
  Parameters parameters = own == inverse_of_.end() ? inverse_ : own->second;
  if (more_fill_ > 0 && parameters.has("fill")) {
    Parameters::Value fill;
    fill.data = parameters.integer("fill") + more_fill_;
    parameters.set("fill", fill);
  }
  return registry_->create<BlockInverse>("block_inverse", parameters);
}

void KrylovSolver::require_fields(const std::vector<EquationBlock>& blocks) const {
  for (const auto& [name, parameters] : inverse_of_)
    if (std::ranges::find(blocks, name, &EquationBlock::field) == blocks.end())
      throw Error(parameters.where(),
                  fmt::format("there is no field '{}' whose equations it could invert", name));
}

bool KrylovSolver::worth_keeping(const Matrix& a) const {
  return preconditioner_ && preconditioner_->pattern_version == a.pattern_version &&
         preconditioner_->last_iterations <= keep_ * preconditioner_->first_iterations;
}

void KrylovSolver::solve_into(const Matrix& a, const std::vector<EquationBlock>& blocks,
                              const std::vector<double>& b, std::vector<double>& x, SolveReport& report) {
  try {
    solve_preconditioned(a, blocks, b, x, report);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    // The libraries throw what they like where a pivot is zero or a norm is not finite.
    preconditioner_.reset();
    throw SingularMatrix(fmt::format("the iterative solver broke down, in its own words:\n{}\nTry another "
                                     "`preconditioner`, or `linear: direct`",
                                     error.what()),
                         {});
  }
}

void KrylovSolver::solve_preconditioned(const Matrix& a, const std::vector<EquationBlock>& blocks,
                                        const std::vector<double>& b, std::vector<double>& x,
                                        SolveReport& report) {
  report.new_factorisation = false;
  if (!worth_keeping(a)) preconditioner_.reset();
  if (preconditioner_ && kept_one_does(a, blocks, b, x, report)) return;
  // Where a whole Krylov space has found next to nothing, the next one would not either.
  constexpr double next_to_nothing = 1e-2;
  double before = leaves(a, b, x);
  int since_built = 0;
  for (int most = maximum_iterations_; most > 0;) {
    const int taken = iterate(a, blocks, b, x, std::min(restart_, most), report);
    since_built += taken;
    most -= taken;
    const double left = leaves(a, b, x);
    if (taken < restart_ || left <= tolerance_) break;
    if (more_fill_ == 0 && !(left <= next_to_nothing * before)) {
      ++more_fill_;
      preconditioner_.reset();
      if (!(left < before)) x.assign(x.size(), 0.0);
      since_built = 0;
    }
    before = left;
  }
  if (preconditioner_)
    preconditioner_->first_iterations = preconditioner_->last_iterations = std::max(1, since_built);
}

/// It was made for another matrix, as that of rates at the start or of a fluid at rest, which may be too far
/// from this one: then what it has found is where a new one begins.
bool KrylovSolver::kept_one_does(const Matrix& a, const std::vector<EquationBlock>& blocks,
                                 const std::vector<double>& b, std::vector<double>& x, SolveReport& report) {
  constexpr int cheaper_than_a_new_one = 10;
  const int enough =
      std::min(static_cast<int>(keep_ * preconditioner_->first_iterations) + cheaper_than_a_new_one,
               maximum_iterations_);
  const int taken = iterate(a, blocks, b, x, enough, report);
  preconditioner_->last_iterations = taken;
  const double left = leaves(a, b, x);
  if (left <= tolerance_ || (taken < enough && left <= acceptable_residual_)) return true;
  preconditioner_.reset();
  if (!(left < 1)) x.assign(x.size(), 0.0);
  return false;
}

/// The relative residual.
double KrylovSolver::leaves(const Matrix& a, const std::vector<double>& b,
                            const std::vector<double>& x) const {
  std::vector<double> residual, size = b;
  multiply(a, x, residual);
  for (int i = 0; i < a.rows; ++i) {
    residual[i] = weights()[i] * (b[i] - residual[i]);
    size[i] *= weights()[i];
  }
  return norm(a.communicator, residual) / norm(a.communicator, size);
}

int KrylovSolver::iterate(const Matrix& a, const std::vector<EquationBlock>& blocks,
                          const std::vector<double>& b, std::vector<double>& x, int most,
                          SolveReport& report) {
  const Stopwatch watch;
  // A view of its own for every solve: the same pattern may have been built anew, in other memory.
  const auto matrix = tpetra_view(a);
  if (preconditioner_) {
    preconditioner_->apply->follow(matrix);
  } else {
    report.new_factorisation = true;
    require_fields(blocks);
    auto inverse = Teuchos::rcp(new BlockGaussSeidel(
        matrix, a, blocks, [&](const EquationBlock& block) { return make_inverse(block); }));
    preconditioner_ = std::make_unique<Preconditioner>(Preconditioner{inverse, a.pattern_version});
  }
  report.setup_seconds += watch.seconds();
  const int taken = gmres(matrix, preconditioner_->apply, weights(), b, x, {tolerance_, most, restart_});
  report.iterations += taken;
  // The view would keep the matrix in memory while the next one is built.
  preconditioner_->apply->follow(Teuchos::null);
  return taken;
}

}  // namespace seam
