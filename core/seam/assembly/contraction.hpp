// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace seam {

/// Shape functions of one slot of a term at all points of an element.
struct SlotOperator {
  const double* shape = nullptr;  ///< [point][row][stride]
  int rows = 1;                   ///< 1, or the dimension for a gradient
  int stride = 0;                 ///< nodes, padded with zeros to a multiple of 4
  int components = 1;
  int offset = 0;  ///< first row or column in the element matrix; components are `stride` apart
};

/// The work K += sum over points of  B_test^T (weight D) B_trial.
struct Contraction {
  int points = 0;
  const double* weight = nullptr;     ///< [point]
  const double* tangent = nullptr;    ///< D: [point][outputs][tangent columns]
  int tangent_columns = 0;            ///< at least those of `columns`; what is behind them is left alone
  std::vector<SlotOperator> outputs;  ///< of the test functions
  std::vector<SlotOperator> columns;  ///< of the trial functions
  int first_column = 0;               ///< of the element matrix that this term touches
  int width = 0;                      ///< columns touched, a multiple of 4
  double* matrix = nullptr;           ///< [row][column]
  int matrix_stride = 0;
};

/// Carries the work out; the innermost loop of all assembly. Compiled for several instruction sets, the best
/// one is chosen at run time.
void contract(const Contraction& work, std::vector<double>& scratch);

/// y[i] += sum over j of |matrix[i][j]| x[j], for a square matrix of `size` rows.
void add_absolute_product(int size, const double* matrix, const double* x, double* y);

}  // namespace seam
