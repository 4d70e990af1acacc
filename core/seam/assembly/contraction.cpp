// SPDX-License-Identifier: BSD-3-Clause
#include "seam/assembly/contraction.hpp"

#include <algorithm>
#include <cstddef>

#include "seam/assembly/limits.hpp"

// The sanitizers' run-time resolvers do not work with function versions.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define SEAM_VERSIONS __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define SEAM_VERSIONS
#endif
#define SEAM_INLINE inline __attribute__((always_inline))

namespace seam {
namespace {

// Four or eight doubles; the compiler maps them to what the machine has.
using Pack4 [[gnu::vector_size(32)]] = double;
using Pack8 [[gnu::vector_size(64)]] = double;

// Through memcpy, because nothing here is aligned; it becomes one unaligned instruction.
template <class Pack>
SEAM_INLINE Pack load(const double* p) {
  Pack v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
template <class Pack>
SEAM_INLINE void add(double* p, const Pack& v) {
  const Pack sum = load<Pack>(p) + v;
  __builtin_memcpy(p, &sum, sizeof sum);
}

/// Four rows of c += a^T b, one pack of columns wide; the sums stay in registers over the whole depth.
template <class Pack>
SEAM_INLINE void add_tile(int depth, const double* a, int a_stride, const double* b, int b_stride, double* c,
                          int c_stride) {
  Pack sum0{}, sum1{}, sum2{}, sum3{};
  for (int k = 0; k < depth; ++k, a += a_stride, b += b_stride) {
    const Pack row = load<Pack>(b);
    sum0 += a[0] * row;
    sum1 += a[1] * row;
    sum2 += a[2] * row;
    sum3 += a[3] * row;
  }
  add<Pack>(c, sum0);
  add<Pack>(c + c_stride, sum1);
  add<Pack>(c + 2 * static_cast<std::ptrdiff_t>(c_stride), sum2);
  add<Pack>(c + 3 * static_cast<std::ptrdiff_t>(c_stride), sum3);
}

/// c (rows x columns) += a^T (depth x rows) b (depth x columns); rows and columns are multiples of 4.
SEAM_INLINE void add_product(int rows, int columns, int depth, const double* a, const double* b, double* c,
                             int c_stride) {
  for (int i = 0; i < rows; i += 4) {
    double* target = c + static_cast<std::ptrdiff_t>(i) * c_stride;
    int j = 0;
    for (; j + 8 <= columns; j += 8)
      add_tile<Pack8>(depth, a + i, rows, b + j, columns, target + j, c_stride);
    if (j < columns) add_tile<Pack4>(depth, a + i, rows, b + j, columns, target + j, c_stride);
  }
}

/// One column of D: the row of shape functions it multiplies, and where in the element matrix they go.
struct Column {
  const double* shape;  ///< at point 0
  int per_point;        ///< distance to the next point
  int target;
  int stride;
};

/// One row of weight D B_trial: the trial functions seen by one component and direction of a test function.
SEAM_INLINE void apply_columns(const Column* columns, int count, int q, double weight, const double* d,
                               double* row) {
  for (int k = 0; k < count; ++k) {
    const double factor = weight * d[k];
    // Most integrands couple few of their inputs.
    if (factor == 0) continue;
    const Column column = columns[k];
    const double* from = column.shape + static_cast<std::ptrdiff_t>(q) * column.per_point;
    double* to = row + column.target;
    int a = 0;
    for (; a + 8 <= column.stride; a += 8) add<Pack8>(to + a, factor * load<Pack8>(from + a));
    if (a < column.stride) add<Pack4>(to + a, factor * load<Pack4>(from + a));
  }
}

int size(const std::vector<SlotOperator>& slots) {
  int n = 0;
  for (const SlotOperator& s : slots) n += s.components * s.rows;
  return n;
}

}  // namespace

SEAM_VERSIONS void contract(const Contraction& work, std::vector<double>& scratch) {
  Column column[most_columns];
  int columns = 0;
  for (const SlotOperator& slot : work.columns)
    for (int c = 0; c < slot.components; ++c)
      for (int l = 0; l < slot.rows; ++l)
        column[columns++] = {slot.shape + static_cast<std::ptrdiff_t>(l) * slot.stride,
                             slot.rows * slot.stride, slot.offset + c * slot.stride - work.first_column,
                             slot.stride};
  const int outputs = size(work.outputs), width = work.width, points = work.points;
  int out = 0;
  for (const SlotOperator& test : work.outputs)
    for (int c = 0; c < test.components; ++c, out += test.rows) {
      scratch.assign(static_cast<std::size_t>(points) * test.rows * width, 0.0);
      double* row = scratch.data();
      for (int q = 0; q < points; ++q)
        for (int i = 0; i < test.rows; ++i, row += width)
          apply_columns(
              column, columns, q, work.weight[q],
              work.tangent + (static_cast<std::ptrdiff_t>(q) * outputs + out + i) * work.tangent_columns,
              row);
      double* target = work.matrix +
                       static_cast<std::ptrdiff_t>(test.offset + c * test.stride) * work.matrix_stride +
                       work.first_column;
      add_product(test.stride, width, points * test.rows, test.shape, scratch.data(), target,
                  work.matrix_stride);
    }
}

SEAM_VERSIONS void add_absolute_product(int size, const double* matrix, const double* x, double* y) {
  for (int i = 0; i < size; ++i, matrix += size) {
    Pack4 sum{};
    for (int j = 0; j < size; j += 4) {
      const Pack4 entry = load<Pack4>(matrix + j);
      sum += (entry < 0 ? -entry : entry) * load<Pack4>(x + j);
    }
    y[i] += sum[0] + sum[1] + sum[2] + sum[3];
  }
}

}  // namespace seam
