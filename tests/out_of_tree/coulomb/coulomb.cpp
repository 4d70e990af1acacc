// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "seam/field/field.hpp"
#include "seam/interface/interface.hpp"
#include "seam/physics/stress_law.hpp"
#include "seam/plugin/plugin.hpp"
#include "seam/term/kernel_term.hpp"

using namespace seam;

namespace {

using u = Vector<0>;  // displacement of the body
using w = Vector<1>;  // displacement of the other one

/// n . sigma n of a body, Pa.
template <int dim, class T, class G>
T normal_stress(const Law& law, const Mat<dim, dim, T>& gradient, const Vec<dim, G>& normal) {
  Mat<dim, dim, T> f = gradient;
  for (int i = 0; i < dim; ++i) f(i, i) += 1.0;
  const Vec<dim, T> traction = stress<dim, T>(law, gradient) * (transpose(f) * normal);
  return dot(normal, traction) / determinant(f);
}

/// Coulomb's law beside the coupling `contact`, which takes care of the normal direction. The tangential
/// traction on the body is -friction p s/sqrt(s.s + creep^2), with the slip s = P (du/dt - dw/dt), P = I - n
/// n^T, and the pressure p from the normal stress of both bodies.
struct Coulomb {
  using Reads = Slots<Gradient<u>, Rate<u>, Gradient<w>, Rate<w>>;
  using Tests = Slots<Value<u>>;
  static constexpr int movers = 2;
  std::shared_ptr<const Law> own, other;
  double friction;  ///< coefficient
  double creep;     ///< m/s, below which bodies stick

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    if (plain(x.gap) > 0.1 * x.cell_size) return;
    const T pressure = -0.5 * (normal_stress<dim, T>(*own, s.gradient(u{}), x.normal) +
                               normal_stress<dim, T>(*other, s.gradient(w{}), x.normal));
    if (plain(pressure) <= 0) return;
    const Vec<dim, T> velocity = s.rate(u{}) - s.rate(w{});
    const Vec<dim, T> slip = velocity - dot(velocity, x.normal) * x.normal;
    using std::sqrt;
    const T rub = friction * pressure / sqrt(dot(slip, slip) + creep * creep);
    r.value(u{}) += rub * slip;
  }
};

class CoulombCoupling final : public Coupling {
 public:
  explicit CoulombCoupling(const Parameters& parameters) : parameters_(parameters) {}
  static Schema schema() {
    Schema s("Friction after Coulomb between bodies that the coupling `contact` keeps apart.");
    s.reference("on", "Interface of type contact; the other body needs its own", "interface");
    s.number("friction", "Coefficient of friction").at_least(0);
    s.number("creep", "Slip velocity below which bodies count as sticking").unit("m/s").above(0);
    return s;
  }
  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    for (const int side : {0, 1}) {
      const Field& field = *sides.fields.at(side);
      static_cast<void>(field.place("displacement"));
      if (!sides.law(side, "stress"))
        throw Error("friction needs bodies that make their stress known; '" + field.name() + "' does not");
    }
    const Coulomb kernel{sides.law(0, "stress"), sides.law(1, "stress"), parameters_.number("friction"),
                         parameters_.number("creep")};
    return {{make_term(kernel), {{0, "displacement"}, {1, "displacement"}}}};
  }

 private:
  Parameters parameters_;
};

}  // namespace

SEAM_PLUGIN(registry) {
  registry.add<Coupling>("coupling", "coulomb", CoulombCoupling::schema(),
                         [](const Parameters& parameters, const Registry&) {
                           return std::make_unique<CoulombCoupling>(parameters);
                         });
}
