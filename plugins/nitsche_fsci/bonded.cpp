// SPDX-License-Identifier: BSD-3-Clause
#include "bonded.hpp"

#include <fmt/format.h>

#include "coupling_sides.hpp"
#include "seam/field/field.hpp"
#include "seam/interface/interface.hpp"

namespace seam::fsci {
namespace {

using Own = Vector<0>;
using Other = Vector<1>;

/// Ties two bodies whose faces coincide in the reference configuration: Gamma^PS of thesis 5.2.2, or two
/// solids. With N out of side 0, J the difference of displacements and P the first Piola-Kirchhoff stress of
/// side 0,
///
///   -<du0 - du1, P N - gamma M/h J> + xi <D_du0[P] N, J>
///
/// where M is the body's stiffness at rest in compression without lateral strain.
struct Bonded {
  using Reads = Slots<Value<Own>, Gradient<Own>, Value<Other>>;
  using Tests = Slots<Value<Own>, Gradient<Own>, Value<Other>>;
  std::shared_ptr<const Law> law;
  double adjoint;  ///< xi: +1 skew-symmetric, -1 symmetric, 0 none
  double penalty;  ///< gamma M, Pa

  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const Vec<dim, T> jump = s.value(Own{}) - s.value(Other{});
    const Mat<dim, dim, T> gradient = s.gradient(Own{});
    const Vec<dim, T> traction = stress<dim, T>(*law, gradient) * x.normal - (penalty / x.trace_size) * jump;
    r.value(Own{}) -= traction;
    r.value(Other{}) += traction;
    if (adjoint == 0) return;
    // The derivative that tests: one more level of differentiation, with respect to the gradient alone.
    constexpr int n = dim * dim;
    using S = Fad<n, T>;
    Mat<dim, dim, S> varied;
    for (int k = 0; k < n; ++k) varied.c[k] = S(gradient.c[k], k);
    const Vec<dim, S> force = stress<dim, S>(*law, varied) * x.normal;
    Mat<dim, dim, T> tested;
    for (int i = 0; i < dim; ++i)
      for (int k = 0; k < n; ++k) tested.c[k] += adjoint * jump[i] * force[i].d[k];
    r.gradient(Own{}) += tested;
  }
};

/// J, m.
struct Apart {
  using Reads = Slots<Value<Own>, Value<Other>>;
  static constexpr int values(int dim) { return dim; }
  template <int dim>
  void operator()(const Point<dim>&, const Trial<dim, double, Reads>& s, double* value) const {
    const Vec<dim, double> jump = s.value(Own{}) - s.value(Other{});
    std::copy(jump.c.begin(), jump.c.end(), value);
  }
};

/// A component of the traction on side 0's body at rest, Pa: minus what its test displacement gets.
struct JointTraction {
  using Reads = Bonded::Reads;
  static constexpr int values(int) { return 1; }
  Bonded bond;
  int component;
  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    double coefficients[Bonded::Tests::size(dim)] = {};
    Test<dim, double, Bonded::Tests> r{coefficients};
    bond.operator()<dim, double>(x, s, r);
    *value = -r.value(Own{}).data[component];
  }
};

/// Bodies that are grown together.
class Bond final : public Coupling {
 public:
  explicit Bond(const Parameters& parameters) : parameters_(parameters) {}

  static Schema schema() {
    Schema s(
        "Bodies that are grown together: a solid, and another solid or a porous body that shares its faces.");
    s.reference("on",
                "Interface of type matching, the solid on side 0: its stress is that between the bodies",
                "interface");
    declare_adjoint(s);
    s.number("penalty", "Factor of Nitsche's penalty, over the solid's stiffness in compression")
        .otherwise("10")
        .above(0);
    return s;
  }

  [[nodiscard]] std::vector<SideTerm> terms(const CouplingSides& sides) const override {
    if (sides.law(0, "pores"))
      throw Error(
          parameters_.where("on"),
          fmt::format("the body on side 0 gives the stress, for which '{}' is no solid but porous: put "
                      "the solid first",
                      sides.fields[0]->name()));
    return {{make_term(bond(sides), 1), operands(sides)}};
  }

  [[nodiscard]] std::vector<Measure> measures(const CouplingSides& sides) const override {
    std::vector<Measure> result{{"apart", {{make_quantity(Apart{}), operands(sides)}}}};
    constexpr const char* axis[] = {".x", ".y", ".z"};
    for (int c = 0; c < parameters_.dimension(); ++c)
      result.push_back({std::string("force") + axis[c],
                        {{make_quantity(JointTraction{bond(sides), c}), operands(sides)}},
                        MeasureOf::integral});
    return result;
  }

 private:
  [[nodiscard]] Bonded bond(const CouplingSides& sides) const {
    const std::shared_ptr<const Law> law = law_of(sides, 0);
    const double modulus = stiffness_at_rest(*law, parameters_.dimension());
    return {law, adjoint_of(parameters_), parameters_.number("penalty") * modulus};
  }
  static std::vector<Operand> operands(const CouplingSides& sides) {
    std::vector<Operand> both{{0, "displacement"}, {1, "displacement"}};
    for (const Operand& operand : both)
      static_cast<void>(sides.fields.at(operand.side)->place(operand.unknown));
    return both;
  }
  Parameters parameters_;
};

}  // namespace

void declare_bonded(Registry& registry) {
  registry.add<Coupling>("coupling", "bonded", Bond::schema(),
                         [](const Parameters& p, const Registry&) { return std::make_unique<Bond>(p); });
  registry.publishes(
      "coupling", "bonded",
      {{Published::As::series, "apart", "m m^((d-1)/2)", "L2 norm of the difference of the displacements"},
       {Published::As::series, "force.x", "N", "force through the joint on the body of side 0"},
       {Published::As::series, "force.y", "N", "force through the joint on the body of side 0"},
       {Published::As::series, "force.z", "N", "force through the joint on the body of side 0"}});
}

}  // namespace seam::fsci
