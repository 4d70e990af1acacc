// SPDX-License-Identifier: BSD-3-Clause
#include "seam/linear/tpetra.hpp"

#include "seam/linear/linear_solver.hpp"

namespace seam {

Teuchos::RCP<TpetraMatrix> tpetra_view(const Matrix& a) {
  // Trilinos wants Kokkos running; its finalisation is left to the end of the process.
  if (!Kokkos::is_initialized()) Kokkos::initialize();
  const auto communicator = Teuchos::rcp(new Teuchos::MpiComm<int>(a.communicator.handle()));
  const auto rows = Teuchos::rcp(new TpetraMap(a.global_rows, a.rows, 0, communicator));
  const Teuchos::ArrayView<const long long> ids(a.column_global.data(), static_cast<int>(a.column_global.size()));
  const auto columns = Teuchos::rcp(
      new TpetraMap(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), ids, 0, communicator));

  // Views on raw pointers are unmanaged: Tpetra neither copies nor frees the arrays.
  using Local = TpetraMatrix::local_matrix_device_type;
  const typename Local::row_map_type::non_const_type row_start(const_cast<std::size_t*>(a.row_start.data()), a.rows + 1);
  const typename Local::index_type::non_const_type column(const_cast<int*>(a.column.data()), a.entries());
  const typename Local::values_type value(const_cast<double*>(a.value.data()), a.entries());
  auto parameters = Teuchos::rcp(new Teuchos::ParameterList);
  auto matrix = Teuchos::rcp(new TpetraMatrix(rows, columns, row_start, column, value, parameters));
  matrix->expertStaticFillComplete(rows, rows);
  return matrix;
}

Teuchos::RCP<TpetraVector> tpetra_view(const Teuchos::RCP<const TpetraMap>& map, double* x) {
  using View = TpetraVector::dual_view_type::t_dev;
  const View view(x, map->getNodeNumElements(), 1);
  return Teuchos::rcp(new TpetraVector(map, view));
}

void multiply(const Matrix& a, const std::vector<double>& x, std::vector<double>& y) {
  y.assign(a.rows, 0.0);
  if (a.communicator.size() == 1) {
    for (int r = 0; r < a.rows; ++r)
      for (std::size_t k = a.row_start[r]; k < a.row_start[r + 1]; ++k) y[r] += a.value[k] * x[a.column[k]];
    return;
  }
  const auto matrix = tpetra_view(a);
  const auto in = tpetra_view(matrix->getDomainMap(), const_cast<double*>(x.data()));
  const auto out = tpetra_view(matrix->getRangeMap(), y.data());
  matrix->apply(*in, *out);
}

}  // namespace seam
