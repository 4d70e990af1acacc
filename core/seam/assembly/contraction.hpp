// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace seam {

/// c[i][j] += sum_k a[k][i] b[k][j]; the inner kernel of every element matrix. Compiled for several instruction
/// sets, the best one is chosen at run time.
/// @param a depth x rows, contiguous
/// @param b depth x columns, rows `b_stride` apart
/// @param c rows x columns, rows `c_stride` apart
void add_product(int rows, int columns, int depth, const double* a, const double* b, int b_stride, double* c,
                 int c_stride);

/// y[j] += factor * x[j]
void add_scaled(int n, double factor, const double* x, double* y);

}  // namespace seam
