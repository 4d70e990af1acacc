// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "seam/base/communicator.hpp"

namespace seam {

/// A piece of memory that belongs to somebody else.
template <class T>
struct Array {
  T* data = nullptr;
  std::size_t size = 0;
  T& operator[](std::size_t i) { return data[i]; }
  const T& operator[](std::size_t i) const { return data[i]; }
  [[nodiscard]] T* begin() { return data; }
  [[nodiscard]] T* end() { return data + size; }
  [[nodiscard]] const T* begin() const { return data; }
};

/// A square sparse matrix distributed by rows. Equations are numbered contiguously over the ranks. The arrays
/// are also those of a Tpetra matrix (see tpetra.hpp), which shares their memory: Tpetra accepts only memory
/// that Kokkos has allocated. Copies share it too.
struct Matrix {
  struct Storage;
  Communicator communicator;
  long long first_row = 0;  ///< equation number of this rank's first row
  long long global_rows = 0;
  int rows = 0;                  ///< of this rank
  Array<std::size_t> row_start;  ///< [rows + 1]
  Array<int> column;             ///< local column numbers: 0 .. rows-1 are this rank's own equations
  Array<double> value;           ///< of the rows; then those of rows that are assembled for other ranks
  std::vector<long long> column_global;  ///< equation number of every local column
  /// [row]: what a row's unknown is called for as long as it lives, however often equations are renumbered.
  std::vector<long long> unknown;
  /// Grows with every change of the pattern: solvers keep what depends on it alone.
  long long pattern_version = 0;

  std::shared_ptr<Storage> storage;

  /// Replaces the arrays by zeroed ones. @param values at least `entries`
  void allocate(int row_count, std::size_t entry_count, std::size_t values);
  [[nodiscard]] std::size_t entries() const { return column.size; }
};

}  // namespace seam
