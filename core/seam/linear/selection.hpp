// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "seam/linear/tpetra.hpp"

namespace seam {

/// Some equations of a system, numbered anew from 0 over the ranks, and the unknowns of the same numbers.
class Selection {
 public:
  /// Collective. @param rows of this rank, increasing
  Selection(const TpetraMatrix& system, std::vector<int> rows);
  [[nodiscard]] const Teuchos::RCP<const TpetraMap>& map() const { return map_; }
  [[nodiscard]] const std::vector<int>& rows() const { return rows_; }
  /// The rows of this selection and the columns of another. Collective.
  /// @param a the matrix that `system` of the constructor was a view of
  [[nodiscard]] Teuchos::RCP<TpetraMatrix> submatrix(const Matrix& a, const Selection& columns) const;
  /// Rows and columns of this selection. Collective.
  [[nodiscard]] Matrix matrix(const Matrix& a) const;
  /// What the rows couple within this rank, as a matrix of this rank alone.
  [[nodiscard]] Teuchos::RCP<TpetraMatrix> own_submatrix(const Matrix& a) const;
  /// What a vector has in this selection's rows.
  [[nodiscard]] TpetraVector gather(const TpetraVector& all) const;
  /// Puts a vector over this selection into a larger one.
  void scatter(const TpetraVector& part, TpetraVector& all) const;

 private:
  /// The entries of some rows in those columns whose number, moved by `shift`, is in [0, end).
  [[nodiscard]] Teuchos::RCP<TpetraMatrix> extract(const Matrix& a, const Selection& columns,
                                                   const Teuchos::RCP<const TpetraMap>& row_map,
                                                   const Teuchos::RCP<const TpetraMap>& column_map,
                                                   long long shift, long long end) const;
  std::vector<int> rows_;
  Teuchos::RCP<const TpetraMap> map_;
  std::vector<long long> number_;  ///< [local column of the system]: that of the selection, -1 outside of it
};

}  // namespace seam
