// SPDX-License-Identifier: BSD-3-Clause
#include "materials.hpp"

#include <fmt/format.h>

#include <cmath>

#include "seam/physics/potential.hpp"

namespace seam::solid {
namespace {

template <class T>
using Invariants = std::array<T, 3>;

/// Thesis (2.17): psi = c (I1 - 3) + c/beta (J^(-2 beta) - 1). Its limit at nu = 0 is c (I1 - 3) - 2 c ln J.
struct NeoHookean {
  double c, beta;
  NeoHookean(double young, double poisson)
      : c(young / (4 * (1 + poisson))), beta(poisson / (1 - 2 * poisson)) {}
  template <class T>
  T energy(const Invariants<T>& i) const {
    using std::expm1, std::log;
    const T log_j = log(i[2]);
    // expm1 keeps its digits where beta is small.
    // Below 1e-20 the limit is exact, and c/beta might be infinite.
    const T volume = beta < 1e-20 ? -2 * c * log_j : (c / beta) * expm1(-2 * beta * log_j);
    return c * (i[0] - 3.0) + volume;
  }
};

/// psi = kappa/2 ((J^2 - 1)/2 - ln J) + mu/2 (J^(-2/3) I1 - 3): volume and shape apart.
struct DecoupledNeoHookean {
  double mu, kappa;
  DecoupledNeoHookean(double young, double poisson)
      : mu(young / (2 * (1 + poisson))), kappa(young / (3 * (1 - 2 * poisson))) {}
  template <class T>
  T energy(const Invariants<T>& i) const {
    using std::log, std::pow;
    return 0.5 * kappa * (0.5 * (i[2] * i[2] - 1.0) - log(i[2])) +
           0.5 * mu * (pow(i[2], -2.0 / 3) * i[0] - 3.0);
  }
};

/// psi = lambda/2 (tr E)^2 + mu tr E^2 with the Green-Lagrange strain E.
struct SaintVenantKirchhoff {
  double lambda, mu;
  SaintVenantKirchhoff(double young, double poisson)
      : lambda(young * poisson / ((1 + poisson) * (1 - 2 * poisson))), mu(young / (2 * (1 + poisson))) {}
  template <class T>
  T energy(const Invariants<T>& i) const {
    const T trace = 0.5 * (i[0] - 3.0);
    const T square = 0.25 * (i[0] * i[0] - 2.0 * i[1] - 2.0 * i[0] + 3.0);
    return 0.5 * lambda * trace * trace + mu * square;
  }
};

/// Thesis (5.22): a neo-Hookean solid with c~ (I1 - 3)^alpha added. I1 - 3 is negative in compression without
/// lateral strain: the exponent is a whole even number.
struct StiffeningNeoHookean {
  NeoHookean plain;
  double stiffening;  ///< c~
  int exponent;       ///< alpha
  template <class T>
  T energy(const Invariants<T>& i) const {
    const T stretched = i[0] - 3.0;
    T power = stretched;
    for (int k = 1; k < exponent; ++k) power = power * stretched;
    return plain.energy(i) + stiffening * power;
  }
};

Schema elastic_schema(const std::string& summary) {
  Schema s(summary);
  s.number("young", "Young's modulus of small strains").unit("Pa").above(0);
  s.number("poisson", "Poisson's ratio of small strains").at_least(0).below(0.5);
  return s;
}

template <class Law>
void declare(Registry& registry, const std::string& name, const std::string& summary) {
  registry.add<Potential>(
      "hyperelastic", name, elastic_schema(summary), [](const Parameters& p, const Registry&) {
        return std::make_unique<LawPotential<3, Law>>(Law(p.number("young"), p.number("poisson")));
      });
}

}  // namespace

void declare_materials(Registry& registry) {
  declare<NeoHookean>(registry, "neo_hookean", "Compressible neo-Hookean solid, thesis (2.17).");
  declare<DecoupledNeoHookean>(registry, "decoupled_neo_hookean",
                               "Neo-Hookean solid with volumetric and isochoric energy apart.");
  declare<SaintVenantKirchhoff>(
      registry, "saint_venant_kirchhoff",
      "Linear law between Green-Lagrange strain and second Piola-Kirchhoff stress; not for "
      "strong compression.");
  Schema stiffening =
      elastic_schema("Neo-Hookean solid that stiffens under strain, thesis (5.22), as rough surfaces do.");
  stiffening.number("stiffening", "c~, of the energy c~ (I1 - 3)^alpha that is added").unit("Pa").at_least(0);
  stiffening.integer("exponent", "alpha, even: the energy has a least value").at_least(2).at_most(20);
  registry.add<Potential>(
      "hyperelastic", "stiffening_neo_hookean", stiffening, [](const Parameters& p, const Registry&) {
        const int exponent = static_cast<int>(p.integer("exponent"));
        if (exponent % 2 != 0)
          throw Error(
              p.where("exponent"),
              fmt::format("found {}, expected an even number: with an odd one a body gains energy without "
                          "bounds as it is compressed",
                          exponent));
        return std::make_unique<LawPotential<3, StiffeningNeoHookean>>(StiffeningNeoHookean{
            NeoHookean(p.number("young"), p.number("poisson")), p.number("stiffening"), exponent});
      });
}

}  // namespace seam::solid
