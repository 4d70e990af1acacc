// SPDX-License-Identifier: BSD-3-Clause
#include "seam/linear/automatic_solver.hpp"

#include <fmt/format.h>

#include "seam/base/memory.hpp"
#include "seam/plugin/registry.hpp"

namespace seam {
namespace {

// Where both take the same seconds on flows in space (docs/decisions/0060-direct-or-iterative.md): an
// iterative solve is some hundred products with the matrix and its incomplete factors.
constexpr double operations_per_entry = 2e4;

/// Of the machine's memory; the rest is for what else a run holds.
constexpr double share_of_memory = 0.6;

/// Even the analysis of more is dear.
constexpr long long most_to_analyse = 1'500'000;

/// Chosen anew for a system that has grown by so much.
constexpr double grown = 1.5;

}  // namespace

AutomaticSolver::AutomaticSolver(const Parameters& p, const Registry& registry)
    : registry_(&registry), direct_(p.object("direct")), iterative_(p.object("iterative")) {
  take(true, "");
}

AutomaticSolver::~AutomaticSolver() = default;

Schema AutomaticSolver::schema() {
  Schema s(
      "A factorisation while it takes less time than iterations do, and fits into memory; else iterations. "
      "The run says which.");
  s.typed("direct", "The direct solver", "linear_solver").otherwise("direct");
  s.typed("iterative", "The iterative solver", "linear_solver").otherwise("krylov");
  return s;
}

void AutomaticSolver::forget() {
  solver_->forget();
  rows_ = 0;
}

std::optional<LinearSolver::Effort> AutomaticSolver::effort(const Matrix& a) {
  choose(a);
  return solver_->effort(a);
}

void AutomaticSolver::take(bool factorises, const std::string& reason) {
  if (!solver_ || factorises != factorises_) {
    solver_.reset();  // what both keep need never be in memory together
    solver_ = registry_->create<LinearSolver>("linear_solver", factorises ? direct_ : iterative_);
  }
  factorises_ = factorises;
  choice_ = reason.empty() ? "" : fmt::format("{}: {}", (factorises ? direct_ : iterative_).type(), reason);
}

/// By the symbolic analysis, which a factorisation keeps. Collective.
void AutomaticSolver::choose(const Matrix& a) {
  if (static_cast<double>(a.global_rows) <= grown * static_cast<double>(rows_)) return;
  rows_ = a.global_rows;
  if (rows_ > most_to_analyse) {
    fits_ = false;
    return take(false, fmt::format("{} unknowns", rows_));
  }
  take(true, "");
  const std::optional<Effort> effort = solver_->effort(a);
  if (!effort) return take(true, "it does not say what it takes");
  const double entries = a.communicator.sum(static_cast<double>(a.entries())),
               memory = a.communicator.min(machine_memory());
  fits_ = memory <= 0 || effort->bytes <= share_of_memory * memory;
  const std::string takes = fmt::format(
      "a factorisation takes {:.2g} operations an entry of the matrix (iterations about {:.0g}) and "
      "{:.0f} of {:.0f} MB",
      effort->operations / entries, operations_per_entry, effort->bytes / 1e6, memory / 1e6);
  take(fits_ && effort->operations <= operations_per_entry * entries, takes);
}

void AutomaticSolver::solve_into(const Matrix& a, const std::vector<EquationBlock>& blocks,
                                 const std::vector<double>& b, std::vector<double>& x, SolveReport& report) {
  choose(a);
  try {
    report = solver_->solve(a, blocks, b, x);
  } catch (const SingularMatrix& error) {
    if (factorises_ || !fits_) throw;
    // Slow is better than not at all.
    take(true, fmt::format("{} did not do: {}", iterative_.type(), error.what()));
    report = solver_->solve(a, blocks, b, x);
  }
}

}  // namespace seam
