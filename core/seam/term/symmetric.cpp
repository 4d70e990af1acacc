// SPDX-License-Identifier: BSD-3-Clause
#include "seam/term/symmetric.hpp"

#include <Eigen/Eigenvalues>

namespace seam {
namespace {

template <int n>
void eigen(const double* a, double* values, double* vectors) {
  using Square = Eigen::Matrix<double, n, n, Eigen::RowMajor>;
  const Eigen::SelfAdjointEigenSolver<Square> of(Eigen::Map<const Square>{a});
  Eigen::Map<Eigen::Matrix<double, n, 1>>{values} = of.eigenvalues();
  Eigen::Map<Square>{vectors} = of.eigenvectors();
}

}  // namespace

void symmetric_eigen(int n, const double* a, double* values, double* vectors) {
  if (n == 2)
    eigen<2>(a, values, vectors);
  else
    eigen<3>(a, values, vectors);
}

}  // namespace seam
