// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>

#include "seam/physics/potential.hpp"
#include "seam/term/tensor.hpp"

namespace seam {

/// A material of the kind "hyperelastic": strain energy per reference volume, Pa, of three arguments, the
/// invariants I1 = tr C, I2 = (I1^2 - tr C^2)/2 and J = det F in three dimensions.
using PotentialPointer = std::shared_ptr<const Potential>;

/// What a material sees of a deformation gradient, and what is needed to turn its answer into a stress.
template <int dim, class T>
struct Deformation {
  Mat<dim, dim, T> f;          ///< deformation gradient; F33 = 1 in the plane
  Mat<dim, dim, T> cofactor;   ///< J F^-T
  std::array<T, 3> invariant;  ///< I1, I2, J of C = F^T F in three dimensions

  explicit Deformation(const Mat<dim, dim, T>& displacement_gradient) : f(displacement_gradient) {
    for (int i = 0; i < dim; ++i) f(i, i) += 1.0;
    cofactor = seam::cofactor(f);
    invariant[2] = determinant(f, cofactor);
    invariant[0] = inner(f, f);
    if constexpr (dim == 2) {
      invariant[0] += 1.0;
      invariant[1] = invariant[0] - 1.0 + invariant[2] * invariant[2];
    } else {
      // I2 of C is the squared norm of cof F.
      invariant[1] = inner(cofactor, cofactor);
    }
  }

  /// First Piola-Kirchhoff stress, Pa.
  [[nodiscard]] Mat<dim, dim, T> stress(const Potential& material) const {
    return stress(gradient<3>(material, invariant));
  }
  /// The same from dpsi/dI_k: their sum times dI_k/dF.
  [[nodiscard]] Mat<dim, dim, T> stress(const std::array<T, 3>& slope) const {
    Mat<dim, dim, T> p = (2.0 * slope[0]) * f + slope[2] * cofactor;
    add_second_invariant(slope[1], p);
    return p;
  }
  /// p += slope dI2/dF; many materials do not depend on I2.
  void add_second_invariant(const T& slope, Mat<dim, dim, T>& p) const {
    if (vanishes(slope)) return;
    if constexpr (dim == 2)
      p += (2.0 * slope) * f + (2.0 * slope * invariant[2]) * cofactor;
    else
      p += (2.0 * slope) * (invariant[0] * f - f * (transpose(f) * f));
  }
};

}  // namespace seam
