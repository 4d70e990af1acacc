// SPDX-License-Identifier: BSD-3-Clause
#include "seam/linear/equation_block.hpp"

namespace seam {
namespace {

/// Translations and rotations, [mode][component of a node], at x.
std::vector<std::vector<double>> rigid_motions(const double* x, int dim) {
  std::vector<std::vector<double>> modes(dim == 2 ? 3 : 6, std::vector<double>(dim, 0.0));
  for (int d = 0; d < dim; ++d) modes[d][d] = 1;
  if (dim == 2) {
    modes[2] = {-x[1], x[0]};
    return modes;
  }
  for (int axis = 0; axis < 3; ++axis) {
    modes[3 + axis][(axis + 1) % 3] = -x[(axis + 2) % 3];
    modes[3 + axis][(axis + 2) % 3] = x[(axis + 1) % 3];
  }
  return modes;
}

/// Constants of each component.
std::vector<std::vector<double>> constants(int components) {
  std::vector<std::vector<double>> modes(components, std::vector<double>(components, 0.0));
  for (int c = 0; c < components; ++c) modes[c][c] = 1;
  return modes;
}

}  // namespace

std::vector<std::vector<double>> near_nullspace(const EquationUnknown& unknown, int dimension) {
  const int size = unknown.components;
  const bool rotates = unknown.near_nullspace == NearNullspace::rigid_motions && dimension > 1;
  const std::size_t nodes = unknown.rows.size() / static_cast<std::size_t>(size);
  const int count = !rotates ? size : dimension == 2 ? 3 : 6;
  std::vector<std::vector<double>> modes(count, std::vector<double>(unknown.rows.size()));
  for (std::size_t n = 0; n < nodes; ++n) {
    const auto at = rotates ? rigid_motions(&unknown.coordinates[n * dimension], dimension) : constants(size);
    for (int m = 0; m < count; ++m)
      for (int c = 0; c < size; ++c) modes[m][n * size + c] = at[m][c];
  }
  return modes;
}

}  // namespace seam
