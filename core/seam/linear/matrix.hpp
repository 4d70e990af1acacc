// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "seam/base/communicator.hpp"

namespace seam {

/// A square sparse matrix distributed by rows. Equations are numbered contiguously over the ranks. The arrays
/// are also those of a Tpetra matrix (see tpetra.hpp), which shares their memory.
struct Matrix {
  Communicator communicator;
  long long first_row = 0;               ///< equation number of this rank's first row
  long long global_rows = 0;
  int rows = 0;                          ///< of this rank
  std::vector<std::size_t> row_start;    ///< [rows + 1]
  std::vector<int> column;               ///< local column numbers: 0 .. rows-1 are this rank's own equations
  std::vector<double> value;
  std::vector<long long> column_global;  ///< equation number of every local column
  /// Grows with every change of the pattern: solvers keep what depends on it alone.
  long long pattern_version = 0;

  [[nodiscard]] std::size_t entries() const { return row_start.empty() ? 0 : row_start[rows]; }
};

/// Rows that belong together, for solvers that treat them apart: one field block of the system.
struct EquationBlock {
  std::string field;
  int first = 0;  ///< local row
  int count = 0;  ///< local rows
  int unknowns_per_node = 1;
  std::vector<double> coordinates;               ///< [local node][dimension], owned and active
  std::vector<std::vector<double>> near_nullspace;  ///< vectors over the block's local rows
  int dimension = 2;
};

}  // namespace seam
