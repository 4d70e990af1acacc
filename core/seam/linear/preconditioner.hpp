// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/linear/tpetra.hpp"

namespace seam {

/// A multigrid preconditioner of one block (MueLu, smoothed aggregation).
Teuchos::RCP<TpetraOperator> make_multigrid(const Teuchos::RCP<TpetraMatrix>& matrix,
                                            const EquationBlock& block);

/// An incomplete LU factorisation with one layer of overlap between ranks (Ifpack2).
/// @param fill levels of fill-in
Teuchos::RCP<TpetraOperator> make_incomplete_lu(const Teuchos::RCP<TpetraMatrix>& matrix, int fill);

/// Forward block Gauss-Seidel over the blocks of a system.
Teuchos::RCP<TpetraOperator> make_block_gauss_seidel(const Teuchos::RCP<TpetraMatrix>& system,
                                                     const Matrix& a,
                                                     const std::vector<EquationBlock>& blocks, bool multigrid,
                                                     int fill);

}  // namespace seam
