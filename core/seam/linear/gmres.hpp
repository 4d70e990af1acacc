// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/linear/tpetra.hpp"

namespace seam {

struct GmresOptions {
  double tolerance = 1e-9;  ///< on |b - A x| / |b|, weighed
  int maximum_iterations = 1000;
  int restart = 150;  ///< size of the Krylov space
};

/// GMRES with a preconditioner on the right (Belos). Collective.
/// @param weights [owned row] of the residual's entries; none: 1
/// @param x [owned row], start value and result
/// @return iterations; the caller checks the residual
int gmres(const Teuchos::RCP<TpetraMatrix>& matrix, const Teuchos::RCP<TpetraOperator>& preconditioner,
          const std::vector<double>& weights, const std::vector<double>& b, std::vector<double>& x,
          const GmresOptions& options);

}  // namespace seam
