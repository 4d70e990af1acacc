// SPDX-License-Identifier: BSD-3-Clause
#include "seam/cut/moments.hpp"

#include <algorithm>

#include "seam/cut/legendre.hpp"
#include "seam/mesh/quadrature.hpp"

namespace seam::cutting {
namespace {

using Values = std::array<double, max_degree + 2>;

/// moment += weight * f_i(x) g_j(y) h_k(z).
void add_product(int dimension, int n, double weight, const std::array<Values, 3>& f,
                 std::vector<double>& moment) {
  double* m = moment.data();
  for (int k = 0; k < (dimension == 3 ? n : 1); ++k) {
    const double wk = dimension == 3 ? weight * f[2][k] : weight;
    for (int j = 0; j < (dimension >= 2 ? n : 1); ++j) {
      const double wj = dimension >= 2 ? wk * f[1][j] : wk;
      for (int i = 0; i < n; ++i) *m++ += wj * f[0][i];
    }
  }
}

std::size_t product_count(int dimension, int degree) {
  std::size_t count = 1;
  for (int d = 0; d < dimension; ++d) count *= degree + 1;
  return count;
}

const Quadrature& simplex_rule(int dimension, int degree) {
  return quadrature(dimension == 1   ? CellType::segment
                    : dimension == 2 ? CellType::triangle
                                     : CellType::tetrahedron,
                    degree);
}

Vector at(const Quadrature& rule, int q, const std::array<Vector, 3>& corner, const Vector& origin) {
  Vector x = origin;
  for (int d = 0; d < rule.dimension; ++d) x = x + rule.points[q * rule.dimension + d] * (corner[d] - origin);
  return x;
}

}  // namespace

void volume_moments(int dimension, const CellMap& map, const CutCell& cell, int degree,
                    std::vector<double>& moment) {
  moment.assign(product_count(dimension, degree), 0.0);
  // The divergence theorem with the integral of the last coordinate's polynomial: parts of the boundary that
  // are parallel to that coordinate, or lie where it is 0, add nothing.
  const int last = dimension - 1;
  const Quadrature& rule = simplex_rule(last, dimension * degree + 1);
  std::array<Values, 3> value{};
  Values work{};
  visit_boundary(dimension, cell, [&](const std::array<Vector, 3>& corner, double sign) {
    std::array<Vector, 3> x{};
    for (int k = 0; k < dimension; ++k) x[k] = map.to_reference(corner[k]);
    const double normal = vector_area(dimension, x[0], x[1], x[2])[last] * (dimension == 3 ? 2 : 1);
    if (normal == 0) return;
    for (int q = 0; q < rule.count(); ++q) {
      const Vector p = at(rule, q, {x[1], x[2], x[2]}, x[0]);
      for (int d = 0; d < last; ++d) legendre(degree, p[d], value[d].data());
      legendre_integral(degree, p[last], work.data(), value[last].data());
      add_product(dimension, degree + 1, sign * normal * rule.weights[q] * map.determinant(), value, moment);
    }
  });
}

void face_moments(int dimension, const CellMap& map, const CutCell& cell, int face, const Vector& face_origin,
                  const std::array<Vector, 2>& face_axes, int degree, std::vector<double>& moment) {
  moment.assign(product_count(dimension - 1, degree), 0.0);
  const Quadrature& rule = simplex_rule(dimension - 1, std::min(30, (dimension - 1) * degree));
  std::array<Values, 3> value{};
  for (const SideSimplex& w : cell.wet) {
    if (w.face != face) continue;
    const double weight = w.area * (dimension == 3 ? 2 : 1);
    for (int q = 0; q < rule.count(); ++q) {
      const Vector p = at(rule, q, {w.corner[1], w.corner[2], w.corner[2]}, w.corner[0]);
      const Vector on_face = map.to_reference(p) - face_origin;
      // The axes of a reference face are orthogonal or, on a tetrahedron's slanted face, to be resolved.
      const double aa = dot(face_axes[0], face_axes[0]), ab = dot(face_axes[0], face_axes[1]),
                   bb = dot(face_axes[1], face_axes[1]);
      const double ra = dot(on_face, face_axes[0]), rb = dot(on_face, face_axes[1]);
      if (dimension == 2) {
        legendre(degree, ra / aa, value[0].data());
      } else {
        legendre(degree, (ra * bb - rb * ab) / (aa * bb - ab * ab), value[0].data());
        legendre(degree, (rb * aa - ra * ab) / (aa * bb - ab * ab), value[1].data());
      }
      add_product(dimension - 1, degree + 1, weight * rule.weights[q], value, moment);
    }
  }
}

}  // namespace seam::cutting
