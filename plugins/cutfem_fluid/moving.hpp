// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "kernels.hpp"
#include "seam/physics/hyperelastic.hpp"
#include "seam/term/moving_mesh.hpp"

/// A fluid whose mesh moves: its displacement is an unknown of the fluid's own.
namespace seam::fluid {

/// Displacement of the mesh, in all terms of a fluid that has one.
using Grid = Vector<2>;

/// Makes the terms and quantities of a fluid, on a mesh that stands or moves.
struct OnMesh {
  bool moves;
  /// @param kernel with two operands at most
  template <class Kernel>
  [[nodiscard]] std::shared_ptr<const Term> term(Kernel kernel, int extra_degree = 0) const {
    if (moves) return make_moving_term<Grid, 2>(std::move(kernel), extra_degree);
    return make_term(std::move(kernel), extra_degree);
  }
  template <class Kernel>
  [[nodiscard]] std::shared_ptr<const Term> integrand(Kernel kernel) const {
    if (moves) return make_moving_quantity<Grid, 2>(std::move(kernel), 1);
    return make_quantity(std::move(kernel));
  }
  template <class Kernel>
  [[nodiscard]] std::shared_ptr<const Term> value(Kernel kernel) const {
    if (moves) return make_moving_quantity<Grid, 2>(std::move(kernel), 0);
    return make_quantity(std::move(kernel));
  }
  /// The unknowns that stand for a kernel's operands.
  [[nodiscard]] std::vector<std::string> operands(const std::string& first, const std::string& second) const {
    if (moves) return {first, second, "displacement"};
    return {first, second};
  }
};

/// The mesh as an elastic body without mass, of Young's modulus 1, that nothing but its boundary moves
/// (thesis Remark 2.11): (Grad dd, P) with the first Piola-Kirchhoff stress of psi = mu/2 (I1 - 3 - 2 ln J) +
/// lambda/2 ln^2 J. A cell that turns inside out has no logarithm: the step is refused.
struct PseudoElastic {
  using Mesh = Vector<0>;
  using Reads = Slots<Gradient<Mesh>>;
  using Tests = Slots<Gradient<Mesh>>;
  double poisson;
  template <int dim, class T>
  void operator()(const Point<dim>&, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    using std::log;
    const double mu = 0.5 / (1 + poisson), lambda = poisson / ((1 + poisson) * (1 - 2 * poisson));
    const Deformation<dim, T> d(s.gradient(Mesh{}));
    const T& j = d.invariant[2];
    r.gradient(Mesh{}) += mu * d.f + ((lambda * log(j) - mu) / j) * d.cofactor;
  }
};

/// J of the mesh: what has become of a volume 1. Near 0 the mesh is about to fold.
struct MeshVolume {
  using Mesh = Vector<0>;
  using Reads = Slots<Gradient<Mesh>>;
  static constexpr int values(int) { return 1; }
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    *value = Deformation<dim, double>(s.gradient(Mesh{})).invariant[2];
  }
};

}  // namespace seam::fluid
