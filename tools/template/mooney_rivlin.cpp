// SPDX-License-Identifier: BSD-3-Clause
#include "seam/physics/potential.hpp"
#include "seam/plugin/registry.hpp"

using namespace seam;

/// psi = c1 (J^(-2/3) I1 - 3) + c2 (J^(-4/3) I2 - 3) + bulk/2 (J - 1)^2
struct MooneyRivlin {
  double c1, c2, bulk;  ///< Pa
  template <class T>
  T energy(const std::array<T, 3>& invariant) const {
    using std::pow;
    const auto& [i1, i2, j] = invariant;
    const T shape = c1 * (pow(j, -2.0 / 3) * i1 - 3.0) + c2 * (pow(j, -4.0 / 3) * i2 - 3.0);
    return shape + 0.5 * bulk * (j - 1.0) * (j - 1.0);
  }
};

void declare_mooney_rivlin(Registry& registry) {
  Schema s("Mooney-Rivlin solid: rubber up to moderate stretch.");
  s.number("c1", "Weight of the first invariant; c1 + c2 is half the shear modulus").unit("Pa").above(0);
  s.number("c2", "Weight of the second invariant").unit("Pa").otherwise("0").at_least(0);
  s.number("bulk", "Bulk modulus").unit("Pa").above(0);
  registry.add<Potential>("hyperelastic", "mooney_rivlin", s, [](const Parameters& p, const Registry&) {
    return std::make_unique<LawPotential<3, MooneyRivlin>>(
        MooneyRivlin{p.number("c1"), p.number("c2"), p.number("bulk")});
  });
}
