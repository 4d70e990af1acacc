// SPDX-License-Identifier: BSD-3-Clause
#include "seam/linear/selection.hpp"

#include <Teuchos_DefaultSerialComm.hpp>
#include <limits>

namespace seam {

Selection::Selection(const TpetraMatrix& system, std::vector<int> rows)
    : rows_(std::move(rows)),
      map_(Teuchos::rcp(new TpetraMap(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), rows_.size(),
                                      0, system.getComm()))) {
  Tpetra::Vector<long long, int, long long> mine(system.getDomainMap()), all(system.getColMap());
  mine.putScalar(-1);
  {
    auto data = mine.getDataNonConst();
    for (std::size_t k = 0; k < rows_.size(); ++k)
      data[rows_[k]] = map_->getGlobalElement(static_cast<int>(k));
  }
  if (const auto importer = system.getGraph()->getImporter(); !importer.is_null())
    all.doImport(mine, *importer, Tpetra::INSERT);
  else
    all = mine;
  const auto data = all.getData();
  number_.assign(data.begin(), data.end());
}

Teuchos::RCP<TpetraMatrix> Selection::extract(const Matrix& a, const Selection& columns,
                                              const Teuchos::RCP<const TpetraMap>& row_map,
                                              const Teuchos::RCP<const TpetraMap>& column_map,
                                              long long shift, long long end) const {
  Teuchos::ArrayRCP<std::size_t> lengths(rows_.size());
  std::vector<long long> column;
  std::vector<double> value;
  const auto read = [&](int row) {
    column.clear();
    value.clear();
    for (std::size_t k = a.row_start[row]; k < a.row_start[row + 1]; ++k) {
      const long long found = columns.number_[a.column[k]], number = found + shift;
      if (found < 0 || number < 0 || number >= end) continue;
      column.push_back(number);
      value.push_back(a.value[k]);
    }
  };
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    read(rows_[k]);
    lengths[k] = column.size();
  }
  auto result = Teuchos::rcp(new TpetraMatrix(row_map, lengths(), Tpetra::StaticProfile));
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    read(rows_[k]);
    result->insertGlobalValues(row_map->getGlobalElement(static_cast<int>(k)),
                               static_cast<int>(column.size()), value.data(), column.data());
  }
  result->fillComplete(column_map, row_map);
  return result;
}

Teuchos::RCP<TpetraMatrix> Selection::submatrix(const Matrix& a, const Selection& columns) const {
  return extract(a, columns, map_, columns.map_, 0, std::numeric_limits<long long>::max());
}

Matrix Selection::matrix(const Matrix& a) const {
  Matrix result;
  result.communicator = a.communicator;
  result.global_rows = static_cast<long long>(map_->getGlobalNumElements());
  result.first_row = rows_.empty() ? 0 : map_->getMinGlobalIndex();
  result.pattern_version = a.pattern_version;
  // Columns keep their order: this rank's own come first, in that of the rows.
  std::vector<int> column(number_.size(), -1);
  for (std::size_t c = 0; c < number_.size(); ++c) {
    if (number_[c] < 0) continue;
    column[c] = static_cast<int>(result.column_global.size());
    result.column_global.push_back(number_[c]);
  }
  std::size_t entries = 0;
  for (const int row : rows_)
    for (std::size_t k = a.row_start[row]; k < a.row_start[row + 1]; ++k)
      entries += column[a.column[k]] >= 0 ? 1 : 0;
  result.allocate(static_cast<int>(rows_.size()), entries, entries);
  std::size_t next = 0;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t k = a.row_start[rows_[r]]; k < a.row_start[rows_[r] + 1]; ++k) {
      if (column[a.column[k]] < 0) continue;
      result.column[next] = column[a.column[k]];
      result.value[next++] = a.value[k];
    }
    result.row_start[r + 1] = next;
    result.unknown.push_back(a.unknown.empty() ? 0 : a.unknown[rows_[r]]);
  }
  return result;
}

Teuchos::RCP<TpetraMatrix> Selection::own_submatrix(const Matrix& a) const {
  const auto count = static_cast<long long>(rows_.size());
  const Teuchos::RCP<const Teuchos::Comm<int>> alone = Teuchos::rcp(new Teuchos::SerialComm<int>);
  const Teuchos::RCP<const TpetraMap> own = Teuchos::rcp(new TpetraMap(count, 0, alone));
  return extract(a, *this, own, own, count == 0 ? 0 : -map_->getMinGlobalIndex(), count);
}

TpetraVector Selection::gather(const TpetraVector& all) const {
  TpetraVector part(map_, all.getNumVectors());
  for (std::size_t v = 0; v < all.getNumVectors(); ++v) {
    const auto from = all.getData(v);
    auto to = part.getDataNonConst(v);
    for (std::size_t k = 0; k < rows_.size(); ++k) to[k] = from[rows_[k]];
  }
  return part;
}

void Selection::scatter(const TpetraVector& part, TpetraVector& all) const {
  for (std::size_t v = 0; v < all.getNumVectors(); ++v) {
    const auto from = part.getData(v);
    auto to = all.getDataNonConst(v);
    for (std::size_t k = 0; k < rows_.size(); ++k) to[rows_[k]] = from[k];
  }
}

}  // namespace seam
