// SPDX-License-Identifier: BSD-3-Clause
#include "seam/physics/physics.hpp"
#include "seam/plugin/registry.hpp"
#include "seam/term/kernel_term.hpp"

using namespace seam;
using Temperature = Scalar<0>;

/// (dT, capacity dT/dt - source) + (grad dT, conductivity grad T)
struct HeatConduction {
  using Reads = Slots<Rate<Temperature>, Gradient<Temperature>>;
  using Tests = Slots<Value<Temperature>, Gradient<Temperature>>;
  double conductivity, capacity;
  Expression source;
  template <int dim, class T>
  void operator()(const Point<dim>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(Temperature{}) += capacity * s.rate(Temperature{}) - source(x.position.c.data(), dim, x.time);
    r.gradient(Temperature{}) += conductivity * s.gradient(Temperature{});
  }
};

struct Heat final : Physics {
  explicit Heat(const Parameters& p) : parameters(p) {}
  std::vector<Unknown> unknowns(int) const override {
    const int time_order = parameters.number("capacity") > 0 ? 1 : 0;
    return {{"temperature", 1, static_cast<int>(parameters.integer("order")), time_order, "K"}};
  }
  void build(FieldSetup& setup) const override {
    const HeatConduction conduction{parameters.number("conductivity"), parameters.number("capacity"),
                                    parameters.expression("source")};
    setup.add_cell_term(make_term(conduction, 1), {"temperature"});
    for (const Parameters& c : parameters.list("boundary"))
      for (const std::string& name : c.names("on"))
        setup.prescribe(name, "temperature", 0, c.expression("temperature"), c.where("temperature"));
  }
  Parameters parameters;
};

void declare_heat(Registry& registry) {
  Schema boundary("A given temperature; elsewhere no heat passes the boundary.");
  boundary.names("on", "Boundaries of the mesh").naming("boundary");
  boundary.expression("temperature", "Its value").unit("K");
  Schema s("Heat conduction in a body at rest: capacity dT/dt - div(conductivity grad T) = source.");
  s.reference("mesh", "Its shape", "mesh");
  s.number("conductivity", "Heat flux per temperature gradient").unit("W/(m K)").above(0);
  s.number("capacity", "Per volume; 0 for a steady state").unit("J/(m^3 K)").otherwise("0").at_least(0);
  s.expression("source", "Heat produced per volume").unit("W/m^3").otherwise("0");
  s.integer("order", "Polynomial order of the temperature").otherwise("1").at_least(1).at_most(2);
  s.list("boundary", "Conditions on the boundary", boundary).otherwise("[]");
  registry.add<Physics>("field", "heat", s,
                        [](const Parameters& p, const Registry&) { return std::make_unique<Heat>(p); });
  registry.publishes("field", "heat", {{Published::As::quantity, "temperature", "K", "of the body"}});
}
