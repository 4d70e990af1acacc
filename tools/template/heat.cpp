// SPDX-License-Identifier: BSD-3-Clause
#include "plugin.hpp"
#include "seam/physics/physics.hpp"
#include "seam/term/kernel_term.hpp"

namespace example {
namespace {

/// capacity dT/dt - div(conductivity grad T) = source, tested with dT: (dT, capacity dT/dt - source) + (grad dT, k grad T).
struct HeatConduction {
  using T_ = seam::Scalar<0>;
  using Reads = seam::Slots<seam::Rate<T_>, seam::Gradient<T_>>;
  using Tests = seam::Slots<seam::Value<T_>, seam::Gradient<T_>>;
  double conductivity, capacity;
  seam::Expression source;
  template <int dim, class T>
  void operator()(const seam::Point<dim>& x, const seam::Trial<dim, T, Reads>& s, seam::Test<dim, T, Tests>& r) const {
    r.value(T_{}) += capacity * s.rate(T_{}) - source(x.position.c.data(), dim, x.time);
    r.gradient(T_{}) += conductivity * s.gradient(T_{});
  }
};

class Heat final : public seam::Physics {
 public:
  explicit Heat(const seam::Parameters& p) : p_(p) {}
  std::vector<seam::Unknown> unknowns(int) const override {
    return {{"temperature", 1, static_cast<int>(p_.integer("order")), p_.number("capacity") > 0 ? 1 : 0, "K"}};
  }
  void build(seam::FieldSetup& setup) const override {
    const HeatConduction kernel{p_.number("conductivity"), p_.number("capacity"), p_.expression("source")};
    setup.add_cell_term(seam::make_term(kernel), {"temperature"});
    for (const seam::Parameters& condition : p_.list("boundary"))
      for (const std::string& name : condition.names("on"))
        setup.prescribe(name, "temperature", 0, condition.expression("temperature"), condition.where("temperature"));
  }

 private:
  seam::Parameters p_;
};

}  // namespace

void declare_heat(seam::Registry& registry) {
  seam::Schema boundary("A given temperature; elsewhere no heat passes the boundary.");
  boundary.names("on", "Boundaries of the mesh").naming("boundary");
  boundary.expression("temperature", "Its value").unit("K");
  seam::Schema s("Heat conduction in a body at rest.");
  s.reference("mesh", "Its shape", "mesh");
  s.number("conductivity", "Heat flux per temperature gradient").unit("W/(m K)").above(0);
  s.number("capacity", "Heat stored per volume and kelvin; 0 for a steady state").unit("J/(m^3 K)").otherwise("0").at_least(0);
  s.expression("source", "Heat produced per volume").unit("W/m^3").otherwise("0");
  s.integer("order", "Polynomial order of the temperature").otherwise("1").at_least(1).at_most(2);
  s.list("boundary", "Conditions on the boundary", boundary).otherwise("[]");
  registry.add<seam::Physics>("field", "heat", s, [](const seam::Parameters& p, const seam::Registry&) {
    return std::make_unique<Heat>(p);
  });
}

}  // namespace example
