// SPDX-License-Identifier: BSD-3-Clause
#include "seam/linear/equilibration.hpp"

#include <Eigen/QR>
#include <cmath>

namespace seam {
namespace {

/// Sizes of the blocks of a matrix: roots of the mean squares of the lengths of their rows. [row kind * kinds
/// + column kind]. Rows that stand for themselves alone, as those of prescribed values, say nothing, and
/// columns of other ranks are left out.
std::vector<double> block_sizes(const Matrix& a, const std::vector<int>& kind_of_row, int kinds) {
  std::vector<double> squares(static_cast<std::size_t>(kinds) * kinds + kinds, 0.0);
  double* rows = squares.data() + static_cast<std::ptrdiff_t>(kinds) * kinds;
  for (int r = 0; r < a.rows; ++r) {
    if (kind_of_row[r] < 0) continue;
    double* to = &squares[static_cast<std::size_t>(kind_of_row[r]) * kinds];
    bool alone = true;
    for (std::size_t k = a.row_start[r]; k < a.row_start[r + 1] && alone; ++k)
      alone = a.column[k] == r || a.value[k] == 0;
    if (alone) continue;
    rows[kind_of_row[r]] += 1;
    for (std::size_t k = a.row_start[r]; k < a.row_start[r + 1]; ++k)
      if (const int c = a.column[k]; c < a.rows && kind_of_row[c] >= 0)
        to[kind_of_row[c]] += a.value[k] * a.value[k];
  }
  a.communicator.sum(squares);
  for (int k = 0; k < kinds; ++k)
    for (int l = 0; l < kinds; ++l) {
      double& square = squares[static_cast<std::size_t>(k) * kinds + l];
      square = rows[k] > 0 ? std::sqrt(square / rows[k]) : 0;
    }
  squares.resize(static_cast<std::size_t>(kinds) * kinds);
  return squares;
}

/// Logarithms of the factors of the equations of each kind.
/// @param scale that kinds declare, 0: none
Eigen::VectorXd logarithms(const std::vector<double>& sizes, const std::vector<double>& scale) {
  const auto kinds = static_cast<Eigen::Index>(scale.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(kinds * kinds, 2 * kinds);
  Eigen::VectorXd right_side = Eigen::VectorXd::Zero(kinds * kinds);
  for (Eigen::Index k = 0; k < kinds; ++k)
    for (Eigen::Index l = 0; l < kinds; ++l) {
      const Eigen::Index row = k * kinds + l;
      const double size = sizes[static_cast<std::size_t>(row)], declared = scale[static_cast<std::size_t>(l)];
      if (size == 0) continue;
      system(row, k) = 1;
      right_side(row) = -std::log(size);
      if (declared > 0)
        right_side(row) -= std::log(declared);
      else
        system(row, kinds + l) = 1;
    }
  // Of what the sizes leave open, such as the weights of fields that are not coupled, the smallest.
  return system.completeOrthogonalDecomposition().solve(right_side).head(kinds);
}

}  // namespace

std::vector<double> equation_weights(const Matrix& a, const std::vector<EquationBlock>& blocks) {
  std::vector<double> weight(a.rows, 1.0), scale;
  std::vector<int> kind_of_row(a.rows, -1);
  for (const EquationBlock& block : blocks)
    for (const EquationUnknown& unknown : block.unknowns) {
      for (const int row : unknown.rows) kind_of_row[row] = static_cast<int>(scale.size());
      scale.push_back(unknown.scale);
    }
  if (scale.size() < 2) return weight;
  const Eigen::VectorXd factor =
      logarithms(block_sizes(a, kind_of_row, static_cast<int>(scale.size())), scale).array().exp();
  for (int r = 0; r < a.rows; ++r)
    if (kind_of_row[r] >= 0) weight[r] = factor(kind_of_row[r]);
  return weight;
}

}  // namespace seam
