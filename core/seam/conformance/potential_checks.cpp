// SPDX-License-Identifier: BSD-3-Clause
#include "seam/conformance/potential_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "seam/conformance/finite_difference.hpp"
#include "seam/term/tensor.hpp"

namespace seam {
namespace {

using Invariants = std::array<double, 3>;

struct Evaluation {
  double value = 0;
  std::array<double, 3> gradient{};
  std::array<double, 9> hessian{};
  Evaluation(const Potential& material, const Invariants& at) {
    material.evaluate(at.data(), value, gradient.data(), hessian.data());
  }
};

/// Invariants of F = 1 + a random tensor.
Invariants random_deformation(std::mt19937& generator) {
  std::uniform_real_distribution<double> entry(-0.15, 0.15);
  Mat<3, 3, double> f = identity<3>();
  for (double& c : f.c) c += entry(generator);
  const Mat<3, 3, double> cof = cofactor(f);
  return {inner(f, f), inner(cof, cof), determinant(f, cof)};
}

template <class Container>
double largest(const Container& values) {
  double result = 0;
  for (const double v : values) result = worse(result, std::abs(v));
  return result;
}

struct Errors {
  double gradient = 0, hessian = 0, third = 0, asymmetry = 0;
};

/// Energy, gradient and Hessian at a changed invariant j.
std::vector<double> changed(const Potential& material, Invariants at, int j, double step) {
  at[j] += step;
  const Evaluation there(material, at);
  std::vector<double> all{there.value, there.gradient[0], there.gradient[1], there.gradient[2]};
  all.insert(all.end(), there.hessian.begin(), there.hessian.end());
  return all;
}

Errors derivative_errors(const Potential& material, const Invariants& at) {
  const Evaluation here(material, at);
  const double gradient_scale = largest(here.gradient);
  // A linear energy has no second derivatives: measure the error against what they would do to the gradient.
  const double hessian_scale = std::max(largest(here.hessian), 1e-6 * gradient_scale);
  std::array<double, 27> third{};
  material.third_derivative(at.data(), third.data());
  const double third_scale = std::max(largest(third), 1e-6 * hessian_scale);
  Errors errors;
  for (int j = 0; j < 3; ++j) {
    double gradient_error = INFINITY, hessian_error = INFINITY, third_error = INFINITY;
    for (const double step : difference_steps) {
      const auto derivative = central_difference([&](double s) { return changed(material, at, j, s); }, step);
      gradient_error =
          std::min(gradient_error, worse(0, std::abs(derivative[0] - here.gradient[j]) / gradient_scale));
      double column = 0;
      for (int i = 0; i < 3; ++i)
        column = worse(column, std::abs(derivative[1 + i] - here.hessian[i * 3 + j]) / hessian_scale);
      hessian_error = std::min(hessian_error, column);
      double slice = 0;
      for (int i = 0; i < 9; ++i)
        slice = worse(slice, std::abs(derivative[4 + i] - third[i * 3 + j]) / third_scale);
      third_error = std::min(third_error, slice);
    }
    errors.gradient = worse(errors.gradient, gradient_error);
    errors.hessian = worse(errors.hessian, hessian_error);
    errors.third = worse(errors.third, third_error);
    for (int i = 0; i < 3; ++i)
      errors.asymmetry = worse(errors.asymmetry,
                               std::abs(here.hessian[i * 3 + j] - here.hessian[j * 3 + i]) / hessian_scale);
  }
  return errors;
}

}  // namespace

std::vector<ConformanceCheck> check_hyperelastic(const Potential& material) {
  if (material.arguments() != 3)
    return {
        conformance_check("arguments", false,
                          fmt::format("{}, expected the three invariants I1, I2, J", material.arguments()))};
  std::mt19937 generator(20231);
  Errors worst;
  for (int sample = 0; sample < 20; ++sample) {
    const Errors errors = derivative_errors(material, random_deformation(generator));
    worst.gradient = worse(worst.gradient, errors.gradient);
    worst.hessian = worse(worst.hessian, errors.hessian);
    worst.third = worse(worst.third, errors.third);
    worst.asymmetry = worse(worst.asymmetry, errors.asymmetry);
  }
  const auto derivative = [](const char* name, double error) {
    return conformance_check(name, error <= tangent_tolerance,
                             fmt::format("{:.1e} relative, at most {:.0e}", error, tangent_tolerance));
  };
  std::vector<ConformanceCheck> checks{
      derivative("gradient against finite differences", worst.gradient),
      derivative("Hessian against finite differences", worst.hessian),
      derivative("third derivatives against finite differences", worst.third),
      derivative("symmetry of the Hessian", worst.asymmetry)};
  const Evaluation rest(material, {3, 3, 1});
  const auto& [i1, i2, j] = rest.gradient;
  const double scale = 2 * std::abs(i1) + 4 * std::abs(i2) + std::abs(j);
  checks.push_back(conformance_check("no energy undeformed", std::abs(rest.value) <= 1e-12 * scale,
                                     fmt::format("{:.1e} Pa, slopes of {:.1e} Pa", rest.value, scale)));
  // P = (2 psi,1 + 4 psi,2 + psi,3) 1 at F = 1.
  const double stress = 2 * i1 + 4 * i2 + j;
  checks.push_back(conformance_check("no stress undeformed", std::abs(stress) <= 1e-12 * scale,
                                     fmt::format("{:.1e} Pa, slopes of {:.1e} Pa", stress, scale)));
  const double shear = 2 * (i1 + i2);
  checks.push_back(
      conformance_check("shear modulus undeformed", shear > 0, fmt::format("{:.4g} Pa, above 0", shear)));
  return checks;
}

}  // namespace seam
