// SPDX-License-Identifier: BSD-3-Clause
#include "seam/mesh/quadrature.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace seam;

namespace {

double factorial(int n) { return std::tgamma(n + 1.0); }

/// Integral of x^i y^j z^k over the reference cell.
double exact(CellType type, int i, int j, int k) {
  if (type == CellType::triangle || type == CellType::tetrahedron)
    return factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + topology(type).dimension);
  return 1.0 / ((i + 1) * (j + 1) * (k + 1));
}

}  // namespace

TEST_CASE("Rules integrate polynomials of their degree") {
  for (const CellType type : {CellType::segment, CellType::triangle, CellType::quadrilateral,
                              CellType::tetrahedron, CellType::hexahedron})
    for (int degree = 0; degree <= 12; ++degree) {
      const Quadrature& rule = quadrature(type, degree);
      const int dim = rule.dimension;
      INFO("cell type " << static_cast<int>(type) << ", degree " << degree);
      for (int i = 0; i <= degree; ++i)
        for (int j = 0; j <= (dim > 1 ? degree - i : 0); ++j)
          for (int k = 0; k <= (dim > 2 ? degree - i - j : 0); ++k) {
            double sum = 0;
            for (int q = 0; q < rule.count(); ++q) {
              const double* x = &rule.points[static_cast<std::size_t>(q) * dim];
              sum += rule.weights[q] * std::pow(x[0], i) * (dim > 1 ? std::pow(x[1], j) : 1.0) *
                     (dim > 2 ? std::pow(x[2], k) : 1.0);
            }
            CHECK(std::abs(sum - exact(type, i, j, k)) < 1e-14);
          }
    }
}
