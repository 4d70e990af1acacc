// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/linear/tpetra.hpp"

namespace seam {

/// What a multigrid method knows of the equations of one unknown.
struct GridOfUnknown {
  int components = 1;
  std::vector<std::vector<double>> near_nullspace;  ///< [mode][row]
  std::vector<std::vector<double>> coordinates;     ///< [direction][node]
};

/// What libseam_preconditioners.so offers to the core, see preconditioner.hpp there. The library is loaded at
/// the first use: MueLu and Ifpack2 draw in seventy others, whose symbols take longer to look up than small
/// scenes to solve. It uses nothing of the core, only the Tpetra of the same process.
struct PreconditionerLibrary {
  Teuchos::RCP<TpetraOperator> (*multigrid)(const Teuchos::RCP<TpetraMatrix>& matrix,
                                            const GridOfUnknown& unknown);
  Teuchos::RCP<TpetraOperator> (*incomplete_lu)(const Teuchos::RCP<TpetraMatrix>& own,
                                                const Teuchos::RCP<const TpetraMap>& rows, int fill);
};

Teuchos::RCP<TpetraOperator> build_multigrid(const Teuchos::RCP<TpetraMatrix>& matrix,
                                             const GridOfUnknown& unknown);
Teuchos::RCP<TpetraOperator> build_incomplete_lu(const Teuchos::RCP<TpetraMatrix>& own,
                                                 const Teuchos::RCP<const TpetraMap>& rows, int fill);

}  // namespace seam

extern "C" const seam::PreconditionerLibrary* seam_preconditioner_library();
