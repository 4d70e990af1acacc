// SPDX-License-Identifier: BSD-3-Clause
#include "condition.hpp"

#include <Eigen/SparseLU>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "seam/assembly/assembler.hpp"
#include "seam/field/field.hpp"

namespace seam::test {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Per row of the matrix: what its unknown is multiplied by; 0 for prescribed ones.
Eigen::VectorXd scales(const Problem& problem, const Assembler& assembler, double viscosity, double size) {
  const FieldEntry& water = problem.fields()[0];
  const int dim = water.mesh->dimension();
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(assembler.matrix().rows);
  for (const auto& [name, factor] :
       {std::pair{"velocity", 1 / std::sqrt(viscosity * std::pow(size, dim - 2))},
        std::pair{"pressure", std::sqrt(viscosity / std::pow(size, dim))}}) {
    const auto place = water.field->place(name);
    const Block& block = water.field->blocks()[place.block];
    for (int node = 0; node < block.space->owned_nodes(); ++node)
      for (int c = place.offset; c < place.offset + place.components; ++c) {
        const int row = assembler.row(*water.field, place.block, node, c);
        if (row >= 0 && !block.prescribed[static_cast<std::size_t>(node) * block.size + c])
          scale[row] = factor;
      }
  }
  return scale;
}

Sparse scaled(const Matrix& a, const Eigen::VectorXd& scale) {
  std::vector<int> number(a.rows, -1);
  int count = 0;
  for (int r = 0; r < a.rows; ++r)
    if (scale[r] > 0) number[r] = count++;
  std::vector<Eigen::Triplet<double>> entries;
  for (int r = 0; r < a.rows; ++r)
    for (std::size_t k = a.row_start[r]; k < a.row_start[r + 1]; ++k) {
      const int c = a.column[k];
      if (number[r] >= 0 && number[c] >= 0)
        entries.emplace_back(number[r], number[c], scale[r] * a.value[k] * scale[c]);
    }
  Sparse result(count, count);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// Largest singular value of what `apply` multiplies a vector by, twice: A, then its transpose.
template <class Apply>
double largest_singular_value(int rows, const Apply& apply) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Eigen::VectorXd x(rows);
  for (double& entry : x) entry = normal(random);
  double square = 0;
  for (int k = 0; k < 30; ++k) {
    x = apply(x.normalized());
    const double before = std::exchange(square, x.norm());
    if (!std::isfinite(square)) return std::numeric_limits<double>::infinity();
    if (std::abs(square - before) < 1e-3 * square) break;
  }
  return std::sqrt(square);
}

}  // namespace

double condition_number(Problem& problem, double viscosity, double size) {
  const Assembler& assembler = problem.assembler();
  const Sparse a = scaled(assembler.matrix(), scales(problem, assembler, viscosity, size));
  Eigen::SparseLU<Sparse> factors(a);
  if (factors.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  const int rows = static_cast<int>(a.rows());
  using Vector = Eigen::VectorXd;
  const double largest =
      largest_singular_value(rows, [&](const Vector& x) -> Vector { return a.transpose() * (a * x); });
  const double inverse = largest_singular_value(rows, [&](const Vector& x) -> Vector {
    const Vector y = factors.solve(x);
    return factors.transpose().solve(y);
  });
  return largest * inverse;
}

}  // namespace seam::test
