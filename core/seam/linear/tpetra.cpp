// SPDX-License-Identifier: BSD-3-Clause
#include "seam/linear/tpetra.hpp"

#include "seam/linear/kokkos.hpp"
#include "seam/linear/linear_solver.hpp"

namespace seam {

using Local = TpetraMatrix::local_matrix_device_type;

struct Matrix::Storage {
  typename Local::row_map_type::non_const_type row_start;
  typename Local::index_type::non_const_type column;
  typename Local::values_type value;
};

void Matrix::allocate(int row_count, std::size_t entry_count, std::size_t values) {
  start_kokkos();
  // The old arrays go first: two patterns need never be in memory together.
  storage.reset();
  storage = std::make_shared<Storage>();
  storage->row_start = decltype(storage->row_start)("row_start", static_cast<std::size_t>(row_count) + 1);
  storage->column = decltype(storage->column)("column", entry_count);
  storage->value = decltype(storage->value)("value", values);
  rows = row_count;
  row_start = {storage->row_start.data(), storage->row_start.extent(0)};
  column = {storage->column.data(), entry_count};
  value = {storage->value.data(), values};
}

Teuchos::RCP<TpetraMatrix> tpetra_view(const Matrix& a) {
  start_kokkos();
  const auto communicator = Teuchos::rcp(new Teuchos::MpiComm<int>(a.communicator.handle()));
  const auto rows = Teuchos::rcp(new TpetraMap(a.global_rows, a.rows, 0, communicator));
  const Teuchos::ArrayView<const long long> ids(a.column_global.data(),
                                                static_cast<int>(a.column_global.size()));
  const auto columns = Teuchos::rcp(
      new TpetraMap(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), ids, 0, communicator));
  const auto value = Kokkos::subview(a.storage->value, std::pair<std::size_t, std::size_t>(0, a.entries()));
  const auto parameters = Teuchos::rcp(new Teuchos::ParameterList);
  const auto matrix = Teuchos::rcp(
      new TpetraMatrix(rows, columns, a.storage->row_start, a.storage->column, value, parameters));
  matrix->expertStaticFillComplete(rows, rows);
  return matrix;
}

Teuchos::RCP<TpetraVector> to_tpetra(const Teuchos::RCP<const TpetraMap>& map, const std::vector<double>& x) {
  const auto vector = Teuchos::rcp(new TpetraVector(map, 1));
  auto data = vector->getDataNonConst(0);
  std::copy(x.begin(), x.end(), data.begin());
  return vector;
}

void from_tpetra(const TpetraVector& vector, std::vector<double>& x) {
  const auto data = vector.getData(0);
  x.assign(data.begin(), data.end());
}

void multiply(const Matrix& a, const std::vector<double>& x, std::vector<double>& y) {
  y = std::move(multiply(a, std::vector<std::vector<double>>{x}).front());
}

std::vector<std::vector<double>> multiply(const Matrix& a, const std::vector<std::vector<double>>& x) {
  std::vector y(x.size(), std::vector<double>(a.rows, 0.0));
  if (a.communicator.size() == 1) {
    for (std::size_t v = 0; v < x.size(); ++v)
      for (int r = 0; r < a.rows; ++r)
        for (std::size_t k = a.row_start[r]; k < a.row_start[r + 1]; ++k)
          y[v][r] += a.value[k] * x[v][a.column[k]];
    return y;
  }
  const auto matrix = tpetra_view(a);
  TpetraVector in(matrix->getDomainMap(), x.size()), out(matrix->getRangeMap(), x.size());
  for (std::size_t v = 0; v < x.size(); ++v)
    std::copy(x[v].begin(), x[v].end(), in.getDataNonConst(v).begin());
  matrix->apply(in, out);
  for (std::size_t v = 0; v < x.size(); ++v) {
    const auto data = out.getData(v);
    y[v].assign(data.begin(), data.end());
  }
  return y;
}

}  // namespace seam
