// SPDX-License-Identifier: BSD-3-Clause
#include "seam/linear/krylov_solver.hpp"

#include <fmt/format.h>

#include "seam/base/stopwatch.hpp"
#include "seam/linear/gmres.hpp"
#include "seam/linear/preconditioner.hpp"

namespace seam {

struct KrylovSolver::Preconditioner {
  Teuchos::RCP<BlockGaussSeidel> apply;
  long long pattern_version;
  int first_iterations = 0;  ///< of the solve right after it was built
  int last_iterations = 0;
};

KrylovSolver::KrylovSolver(const Parameters& p)
    : tolerance_(p.number("tolerance")),
      maximum_iterations_(static_cast<int>(p.integer("maximum_iterations"))),
      restart_(static_cast<int>(p.integer("restart"))),
      keep_(p.number("keep")),
      use_{p.text("preconditioner") != "ilu", p.text("preconditioner") == "schur",
           static_cast<int>(p.integer("fill"))} {
  acceptable_residual_ = 100 * tolerance_;
}

KrylovSolver::~KrylovSolver() = default;

void KrylovSolver::forget() { preconditioner_.reset(); }

Schema KrylovSolver::schema() {
  Schema s(
      "GMRES with algebraic multigrid or incomplete factorisation per field block, for large "
      "systems.");
  s.number("tolerance", "Relative residual to reach").otherwise("1e-9").above(0).below(1);
  s.integer("maximum_iterations", "Iterations after which the solve has failed")
      .otherwise("1000")
      .at_least(1);
  s.integer("restart", "Size of the Krylov space").otherwise("150").at_least(2);
  s.choice("preconditioner",
           "Per field block: multigrid where the block suits it; the same, with a Schur complement for the "
           "pressure of a flow; or ilu everywhere",
           {"multigrid", "schur", "ilu"})
      .otherwise("schur");
  s.integer("fill", "Levels of fill-in of incomplete factorisations").otherwise("0").at_least(0).at_most(5);
  s.number(
       "keep",
       "The preconditioner is kept while iterations stay below this multiple of its first solve's; 0: never")
      .otherwise("1.5")
      .at_least(0);
  return s;
}

bool KrylovSolver::worth_keeping(const Matrix& a) const {
  return preconditioner_ && preconditioner_->pattern_version == a.pattern_version &&
         preconditioner_->last_iterations <= keep_ * preconditioner_->first_iterations;
}

namespace {

/// What a block means is told by its components, as long as a field has all of its unknowns in one: those of
/// another order stand in a block of their own, a pressure without the velocity that it belongs to.
void refuse_mixed_orders(const std::vector<EquationBlock>& blocks) {
  for (std::size_t k = 1; k < blocks.size(); ++k)
    if (blocks[k].field == blocks[k - 1].field)
      throw Error(fmt::format(
          "field '{}' has unknowns of several orders, which `linear: krylov` has no preconditioner for; take "
          "`linear: direct`, or unknowns of one order",
          blocks[k].field));
}

}  // namespace

void KrylovSolver::solve_into(const Matrix& a, const std::vector<EquationBlock>& blocks,
                              const std::vector<double>& b, std::vector<double>& x, SolveReport& report) {
  refuse_mixed_orders(blocks);
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
  const Stopwatch watch;
  report.new_factorisation = !worth_keeping(a);
  // A view of its own for every solve: the same pattern may have been built anew, in other memory.
  const auto matrix = tpetra_view(a);
  if (report.new_factorisation) {
    preconditioner_.reset();  // two of them need never be in memory together
    auto inverse = Teuchos::rcp(new BlockGaussSeidel(matrix, a, blocks, use_));
    preconditioner_ = std::make_unique<Preconditioner>(Preconditioner{inverse, a.pattern_version});
  } else {
    preconditioner_->apply->follow(matrix);
  }
  report.setup_seconds = watch.seconds();

  report.iterations =
      gmres(matrix, preconditioner_->apply, b, x, {tolerance_, maximum_iterations_, restart_});
  // The view would keep the matrix in memory while the next one is built.
  preconditioner_->apply->follow(Teuchos::null);
  preconditioner_->last_iterations = report.iterations;
  if (report.new_factorisation) preconditioner_->first_iterations = std::max(1, report.iterations);
}

std::vector<std::vector<double>> rigid_body_modes(const EquationBlock& block) {
  const int dim = block.dimension, size = block.unknowns_per_node, nodes = block.count / size;
  std::vector<std::vector<double>> modes(dim == 2 ? 3 : 6, std::vector<double>(block.count, 0.0));
  for (int n = 0; n < nodes; ++n) {
    const double* x = &block.coordinates[static_cast<std::size_t>(n) * dim];
    const auto at = [&](int mode, int component) -> double& { return modes[mode][n * size + component]; };
    for (int d = 0; d < dim; ++d) at(d, d) = 1;
    if (dim == 2) {
      at(2, 0) = -x[1];
      at(2, 1) = x[0];
      continue;
    }
    for (int axis = 0; axis < 3; ++axis) {
      at(3 + axis, (axis + 1) % 3) = -x[(axis + 2) % 3];
      at(3 + axis, (axis + 2) % 3) = x[(axis + 1) % 3];
    }
  }
  return modes;
}

}  // namespace seam
