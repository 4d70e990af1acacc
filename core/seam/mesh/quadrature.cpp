// SPDX-License-Identifier: BSD-3-Clause
#include "seam/mesh/quadrature.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace seam {
namespace {

/// Legendre polynomial of degree n and its derivative at x in [-1,1].
std::pair<double, double> legendre(int n, double x) {
  double previous = 1.0, value = x;
  for (int k = 2; k <= n; ++k)
    previous = std::exchange(value, ((2 * k - 1) * x * value - (k - 1) * previous) / k);
  return {value, n * (x * value - previous) / (x * x - 1)};
}

Quadrature tensor_rule(int dimension, int n) {
  const Quadrature line = gauss(n);
  Quadrature rule{dimension, {}, {}};
  const int total = static_cast<int>(std::lround(std::pow(n, dimension)));
  for (int q = 0; q < total; ++q) {
    double weight = 1.0;
    for (int d = 0, index = q; d < dimension; ++d, index /= n) {
      rule.points.push_back(line.points[index % n]);
      weight *= line.weights[index % n];
    }
    rule.weights.push_back(weight);
  }
  return rule;
}

/// Duffy's map of the tensor rule; one more point per direction pays for the Jacobian's degree.
Quadrature collapsed_rule(int dimension, int degree) {
  Quadrature rule = tensor_rule(dimension, (degree + dimension - 1) / 2 + 1);
  for (int q = 0; q < rule.count(); ++q) {
    double* x = &rule.points[static_cast<std::size_t>(q) * dimension];
    double rest = 1.0;
    for (int d = 0; d < dimension; ++d) {
      for (int k = d + 1; k < dimension; ++k) rule.weights[q] *= 1 - x[d];
      const double share = x[d] * rest;
      rest *= 1 - x[d];
      x[d] = share;
    }
  }
  return rule;
}

/// Adds all permutations of barycentric coordinates (a, ..., a, b) of a simplex.
void add_vertex_orbit(Quadrature& rule, double a, double weight) {
  const double b = 1 - rule.dimension * a;
  for (int special = 0; special <= rule.dimension; ++special) {
    for (int d = 0; d < rule.dimension; ++d) rule.points.push_back(d + 1 == special ? b : a);
    rule.weights.push_back(weight);
  }
}

Quadrature triangle_rule(int degree) {
  Quadrature rule{2, {}, {}};
  if (degree <= 1) {
    rule.points = {1.0 / 3, 1.0 / 3};
    rule.weights = {0.5};
  } else if (degree == 2) {
    add_vertex_orbit(rule, 1.0 / 6, 1.0 / 6);
  } else if (degree <= 4) {
    // Dunavant (1985), in closed form.
    const double root = std::sqrt(38.0 - 44.0 * std::sqrt(0.4));
    const double weight_root = std::sqrt(213125.0 - 53320.0 * std::sqrt(10.0));
    add_vertex_orbit(rule, (8 - std::sqrt(10.0) + root) / 18, (620 + weight_root) / 7440);
    add_vertex_orbit(rule, (8 - std::sqrt(10.0) - root) / 18, (620 - weight_root) / 7440);
  } else if (degree == 5) {
    // Radon (1948).
    const double root = std::sqrt(15.0);
    rule.points = {1.0 / 3, 1.0 / 3};
    rule.weights = {9.0 / 80};
    add_vertex_orbit(rule, (6 - root) / 21, (155 - root) / 2400);
    add_vertex_orbit(rule, (6 + root) / 21, (155 + root) / 2400);
  } else {
    return collapsed_rule(2, degree);
  }
  return rule;
}

Quadrature tetrahedron_rule(int degree) {
  Quadrature rule{3, {}, {}};
  if (degree <= 1) {
    rule.points = {0.25, 0.25, 0.25};
    rule.weights = {1.0 / 6};
  } else if (degree == 2) {
    add_vertex_orbit(rule, (5 - std::sqrt(5.0)) / 20, 1.0 / 24);
  } else if (degree <= 5) {
    // Keast (1986), 15 points, in closed form.
    const double r = std::sqrt(15.0);
    rule.points = {0.25, 0.25, 0.25};
    rule.weights = {16.0 / 135 / 6};
    add_vertex_orbit(rule, (7 - r) / 34, (2665 + 14 * r) / 37800 / 6);
    add_vertex_orbit(rule, (7 + r) / 34, (2665 - 14 * r) / 37800 / 6);
    const double c = (5 - r) / 20, d = (5 + r) / 20;
    for (const auto& p : {std::array{c, c, d}, std::array{c, d, c}, std::array{d, c, c}, std::array{d, d, c},
                          std::array{d, c, d}, std::array{c, d, d}}) {
      rule.points.insert(rule.points.end(), p.begin(), p.end());
      rule.weights.push_back(10.0 / 189 / 6);
    }
  } else {
    return collapsed_rule(3, degree);
  }
  return rule;
}

Quadrature make(CellType type, int degree) {
  switch (type) {
    case CellType::point:
      return {0, {}, {1.0}};
    case CellType::segment:
      return tensor_rule(1, degree / 2 + 1);
    case CellType::quadrilateral:
      return tensor_rule(2, degree / 2 + 1);
    case CellType::hexahedron:
      return tensor_rule(3, degree / 2 + 1);
    case CellType::triangle:
      return triangle_rule(degree);
    case CellType::tetrahedron:
      return tetrahedron_rule(degree);
  }
  throw std::logic_error("quadrature: unknown cell type");
}

}  // namespace

Quadrature gauss(int n) {
  Quadrature rule{1, std::vector<double>(n), std::vector<double>(n)};
  for (int i = 0; i < n; ++i) {
    double x = n == 1 ? 0.0 : std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    for (int iteration = 0; n > 1 && iteration < 50; ++iteration) {
      const auto [value, slope] = legendre(n, x);
      x -= value / slope;
      if (std::abs(value / slope) < 1e-16) break;
    }
    const double slope = n == 1 ? 1.0 : legendre(n, x).second;
    rule.points[n - 1 - i] = (1 + x) / 2;
    rule.weights[n - 1 - i] = 1 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

const Quadrature& quadrature(CellType type, int degree) {
  if (degree < 0 || degree > 30) throw std::logic_error("quadrature: degree must be in [0, 30]");
  static std::map<std::pair<CellType, int>, Quadrature> rules;
  auto [entry, is_new] = rules.try_emplace({type, degree});
  if (is_new) entry->second = make(type, degree);
  return entry->second;
}

}  // namespace seam
