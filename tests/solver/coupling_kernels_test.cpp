// SPDX-License-Identifier: BSD-3-Clause
// Weights and penalties of couplings and weak conditions, as their formulas have them.
#include <catch2/catch.hpp>

#include "nitsche_fsci/contact_kernels.hpp"
#include "poroelasticity/kernels.hpp"
#include "solver/one_point.hpp"

using namespace seam;

namespace {

/// Its normal stress is always the same.
struct Pressed final : Law {
  double stress;
  explicit Pressed(double value) : stress(value) {}
  void evaluate(int dimension, const double*, double* value, double* first, double* second) const override {
    const int n = dimension * dimension;
    for (int i = 0; i < n; ++i) value[i] = i % (dimension + 1) == 0 ? stress : 0.0;
    if (first) std::fill_n(first, n * n, 0.0);
    if (second) std::fill_n(second, n * n * n, 0.0);
  }
};

}  // namespace

TEST_CASE("between two bodies the stress of the softer one counts") {
  // lambda = 1 and 3: omega = 3/4, gamma = gamma_0 (3/4 1 + 1/4 3).
  const auto soft = std::make_shared<Pressed>(-5), stiff = std::make_shared<Pressed>(-9);
  Point<2> x;
  x.constant = {1, 3};
  x.normal = {{0.6, 0.8}};
  x.gap = 0.1;
  const Mat<2, 2, double> still;
  const auto pull = [&](fsci::Whose whose) {
    return fsci::BodyPull{soft, stiff, 10, whose}.operator()<2, double>(x, x.normal, still, still);
  };
  CHECK(pull(fsci::Whose::both) == Approx(-0.75 * 5 - 0.25 * 9 + 10 * 1.5 * 0.1));
  CHECK(pull(fsci::Whose::own) == Approx(-5 + 10 * 1 * 0.1));
  CHECK(pull(fsci::Whose::other) == Approx(-9 + 10 * 3 * 0.1));
}

TEST_CASE("weak seepage is penalised by the resistance of a cell") {
  // Of an undeformed body: p n + gamma h Phi (phi w.n - j) n, and -(phi w.n - j) on the mass.
  const double porosity = 0.4, resistance = 7, gamma = 3, outflow = 0.2, pressure = 0.6;
  const poro::WeakSeepage seepage{{porosity, true}, {resistance, 1}, Expression(outflow), gamma};
  const std::vector<double> n{0.6, 0.8}, motion{0.1, -0.2}, velocity{0.9, 0.5};
  std::vector<double> in{0, 0, 0, 0};  // gradient of the displacement
  for (const auto* part : {&motion, &velocity}) in.insert(in.end(), part->begin(), part->end());
  in.push_back(pressure);
  const double miss =
      porosity * (n[0] * (velocity[0] - motion[0]) + n[1] * (velocity[1] - motion[1])) - outflow;
  for (const double h : {0.3, 0.03}) {
    const auto r = test::residual(*make_term(seepage), 2, in, n, h);
    REQUIRE(r.size() == 3);
    for (int i = 0; i < 2; ++i)
      CHECK(r[i] == Approx((pressure + gamma * h * resistance * miss) * n[i]).epsilon(1e-13));
    CHECK(r[2] == Approx(-miss));
  }
}
