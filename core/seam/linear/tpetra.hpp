// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_MultiVector.hpp>

#include "seam/linear/matrix.hpp"

// Heavy: include only in the few files that hand the system to Trilinos.
namespace seam {

using TpetraMatrix = Tpetra::CrsMatrix<double, int, long long>;
using TpetraVector = Tpetra::MultiVector<double, int, long long>;
using TpetraMap = Tpetra::Map<int, long long>;
using TpetraOperator = Tpetra::Operator<double, int, long long>;

/// A Tpetra matrix on the arrays of `a`.
Teuchos::RCP<TpetraMatrix> tpetra_view(const Matrix& a);

/// A vector with the entries of `x`, and back.
Teuchos::RCP<TpetraVector> to_tpetra(const Teuchos::RCP<const TpetraMap>& map, const std::vector<double>& x);
void from_tpetra(const TpetraVector& vector, std::vector<double>& x);

}  // namespace seam
