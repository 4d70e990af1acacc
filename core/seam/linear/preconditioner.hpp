// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seam/linear/equation_block.hpp"
#include "seam/linear/selection.hpp"

namespace seam {

/// A multigrid preconditioner of the equations of one unknown (MueLu, smoothed aggregation with the unknown's
/// near-null space).
Teuchos::RCP<TpetraOperator> make_multigrid(const Teuchos::RCP<TpetraMatrix>& matrix,
                                            const EquationUnknown& unknown, int dimension);

/// An incomplete LU factorisation of each rank's own part (Ifpack2). The matrix is not kept.
/// @param own this rank's part, as a matrix of this rank alone
/// @param rows of the result, over all ranks
/// @param fill levels of fill-in
Teuchos::RCP<TpetraOperator> make_incomplete_lu(const Teuchos::RCP<TpetraMatrix>& own,
                                                const Teuchos::RCP<const TpetraMap>& rows, int fill);

/// The approximate block factorisation SIMPLE of equations of which some constrain the others (see
/// UnknownRole), as those of the pressure of an incompressible flow. Multigrid for the Schur complement and
/// for what displaces points, an incomplete factorisation for other unknowns, one after the other.
/// @param fill levels of fill-in
Teuchos::RCP<TpetraOperator> make_simple(const Matrix& a, const EquationBlock& equations, int fill);

}  // namespace seam
