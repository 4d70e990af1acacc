// SPDX-License-Identifier: BSD-3-Clause
#include "seam/field/field.hpp"
#include "seam/interface/interface.hpp"
#include "seam/plugin/plugin.hpp"
#include "seam/term/kernel_term.hpp"

using namespace seam;

namespace {

using v = Vector<0>;  // velocity of the fluid
using p = Scalar<1>;  // its pressure
using u = Vector<2>;  // displacement of the body

/// A thin layer that rubs: the fluid does not pass, and drags the body along with friction P J, where
/// J = v - du/dt, P = I - n n^T and n points out of the fluid. Across the layer Nitsche's terms with the
/// fluid's stress sigma and Phi = viscosity + h^2 density/(12 theta dt):
///
///   <dv - du, friction P J - (n.sigma n) n + penalty Phi/h (J.n) n>
///   - <dp, J.n> + <n.2 viscosity eps(dv) n, J.n>
struct FrictionLayer {
  using Reads = Slots<Value<v>, Gradient<v>, Value<p>, Rate<u>>;
  using Tests = Slots<Value<v>, Gradient<v>, Value<p>, Value<u>>;
  double friction;            ///< Pa s/m
  double density, viscosity;  ///< of the fluid: kg/m^3, Pa s
  double penalty;

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Vec<dim, G>& n = x.normal;
    const double h = x.trace_size;
    const Vec<dim, T> jump = s.value(v{}) - s.rate(u{});
    const T gap = dot(jump, n);
    const T normal_stress = 2 * viscosity * dot(n, sym(s.gradient(v{})) * n) - s.value(p{});
    const double inertia = x.step > 0 ? h * h * density / (12 * x.theta * x.step) : 0.0;
    const T push = penalty / h * (viscosity + inertia) * gap - normal_stress;
    const Vec<dim, T> traction = friction * (jump - gap * n) + push * n;
    r.value(v{}) += traction;
    r.value(u{}) -= traction;
    r.value(p{}) -= gap;
    r.gradient(v{}) += (2 * viscosity * gap) * outer(n, n);
  }
};

class FrictionLayerCoupling final : public Coupling {
 public:
  explicit FrictionLayerCoupling(const Parameters& parameters)
      : friction_(parameters.number("friction")), penalty_(parameters.number("penalty")) {}
  static Schema schema() {
    Schema s("A thin layer between a fluid and a deforming body that the fluid cannot pass and rubs along.");
    s.reference("on", "Interface with the fluid on side 0 and the body on side 1", "interface");
    s.number("friction", "Tangential traction per difference of velocities").unit("Pa s/m").at_least(0);
    s.number("penalty", "Factor of Nitsche's penalty across the layer").otherwise("35").above(0);
    return s;
  }
  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    const std::vector<Operand> operands{{0, "velocity"}, {0, "pressure"}, {1, "displacement"}};
    // place() throws an error that names field and unknown where there is none.
    for (const Operand& operand : operands)
      static_cast<void>(sides.fields.at(operand.side)->place(operand.unknown));
    const Field& fluid = *sides.fields[0];
    return {{make_term(
                 FrictionLayer{friction_, fluid.constant("density"), fluid.constant("viscosity"), penalty_}),
             operands}};
  }

 private:
  double friction_, penalty_;
};

}  // namespace

SEAM_PLUGIN(registry) {
  registry.add<Coupling>("coupling", "friction_layer", FrictionLayerCoupling::schema(),
                         [](const Parameters& parameters, const Registry&) {
                           return std::make_unique<FrictionLayerCoupling>(parameters);
                         });
}
