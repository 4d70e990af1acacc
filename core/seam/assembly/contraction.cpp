// SPDX-License-Identifier: BSD-3-Clause
#include "seam/assembly/contraction.hpp"

// The sanitizers' run-time resolvers do not work with function versions.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define SEAM_VERSIONS __attribute__((target_clones("arch=skylake-avx512", "arch=haswell", "default")))
#else
#define SEAM_VERSIONS
#endif

namespace seam {

namespace {

constexpr int tile_rows = 4, tile_columns = 8;

/// A full tile keeps its sums in registers over the whole depth.
inline __attribute__((always_inline)) void full_tile(int depth, const double* a, int a_stride, const double* b,
                                                     int b_stride, double* c, int c_stride) {
  double sum[tile_rows][tile_columns] = {};
  for (int k = 0; k < depth; ++k)
    for (int i = 0; i < tile_rows; ++i)
      for (int j = 0; j < tile_columns; ++j) sum[i][j] += a[k * a_stride + i] * b[k * b_stride + j];
  for (int i = 0; i < tile_rows; ++i)
    for (int j = 0; j < tile_columns; ++j) c[i * c_stride + j] += sum[i][j];
}

inline __attribute__((always_inline)) void part_tile(int rows, int columns, int depth, const double* a, int a_stride,
                                                     const double* b, int b_stride, double* c, int c_stride) {
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < depth; ++k) {
      const double factor = a[k * a_stride + i];
      for (int j = 0; j < columns; ++j) c[i * c_stride + j] += factor * b[k * b_stride + j];
    }
}

}  // namespace

SEAM_VERSIONS void add_product(int rows, int columns, int depth, const double* a, const double* b, int b_stride,
                               double* c, int c_stride) {
  for (int i = 0; i < rows; i += tile_rows)
    for (int j = 0; j < columns; j += tile_columns) {
      double* target = c + static_cast<long>(i) * c_stride + j;
      if (i + tile_rows <= rows && j + tile_columns <= columns)
        full_tile(depth, a + i, rows, b + j, b_stride, target, c_stride);
      else
        part_tile(rows - i < tile_rows ? rows - i : tile_rows, columns - j < tile_columns ? columns - j : tile_columns,
                  depth, a + i, rows, b + j, b_stride, target, c_stride);
    }
}

SEAM_VERSIONS void add_scaled(int n, double factor, const double* x, double* y) {
  for (int j = 0; j < n; ++j) y[j] += factor * x[j];
}

}  // namespace seam
