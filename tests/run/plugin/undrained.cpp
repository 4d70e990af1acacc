// SPDX-License-Identifier: BSD-3-Clause
// A porous body whose fluid has no time to leave it is an elastic one: with incompressible pores, the solid
// between them bears all change of volume.
#include <cmath>

#include "seam/physics/potential.hpp"
#include "seam/plugin/plugin.hpp"

namespace {

using namespace seam;

/// psi = c (I1 - 3) - 2 c ln J + kappa (s - 1 - ln s), s = (J - phi_0)/(1 - phi_0), c = E/4: the skeleton's
/// neo-Hookean energy at nu = 0, and that of its own material at the porosity that keeps the fluid, J phi =
/// phi_0 (thesis (2.17), (2.48)).
struct Undrained {
  double young, bulk;  ///< Pa
  double porosity;
  template <class T>
  T energy(const std::array<T, 3>& invariant) const {
    using std::log;
    const T s = (1 / (1 - porosity)) * (invariant[2] - porosity);
    return young / 4 * (invariant[0] - 3.0 - 2.0 * log(invariant[2])) + bulk * (s - 1.0 - log(s));
  }
};

}  // namespace

SEAM_PLUGIN(registry) {
  Schema s("A porous body that keeps its fluid.");
  s.number("young", "of the skeleton, whose Poisson's ratio is 0").unit("Pa").above(0);
  s.number("bulk", "of the skeleton's own material").unit("Pa").above(0);
  s.number("porosity", "at the start").above(0).below(1);
  registry.add<Potential>("hyperelastic", "undrained", s, [](const Parameters& p, const Registry&) {
    return std::make_unique<LawPotential<3, Undrained>>(
        Undrained{p.number("young"), p.number("bulk"), p.number("porosity")});
  });
}
