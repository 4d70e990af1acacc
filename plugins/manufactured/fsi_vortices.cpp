// SPDX-License-Identifier: BSD-3-Clause
#include "fsi_vortices.hpp"

#include "seam/scene/function.hpp"
#include "vortices.hpp"

namespace seam::manufactured {
namespace {

class FsiVortices final : public Function {
 public:
  explicit FsiVortices(const Parameters& p)
      : fluid_amplitude_(p.number("fluid_amplitude")),
        body_amplitude_(p.number("body_amplitude")),
        fields_{p.number("wave_number"), p.number("decay")},
        fluid_{p.number("density"), p.number("viscosity")},
        body_(p.number("body_density"), p.number("young"), p.number("poisson")) {
    if (p.dimension() != 2) throw Error(p.where(), "`fsi_vortices` are plane: give `dimension: 2`");
  }

  static Schema schema() {
    Schema s(
        "Vortices in a fluid and in a neo-Hookean body, thesis (3.42)-(3.48). Parts: velocity, "
        "velocity_gradient, pressure, fluid_force (per mass), fluid_stress; displacement, "
        "displacement_rate, displacement_gradient, body_force (per mass), body_stress (Cauchy).");
    s.number("viscosity", "Of the fluid").unit("Pa s").above(0);
    s.number("density", "Of the fluid").unit("kg/m^3").otherwise("1").above(0);
    s.number("body_density", "Of the body, reference").unit("kg/m^3").otherwise("1").above(0);
    s.number("young", "Young's modulus of the body").unit("Pa").above(0);
    s.number("poisson", "Poisson's ratio of the body").at_least(0).below(0.5);
    s.number("fluid_amplitude", "A_F: largest velocity of the fluid").unit("m/s").otherwise("1");
    s.number("body_amplitude", "A_S: largest velocity of the body at the start").unit("m/s").otherwise("1");
    s.number("wave_number", "B").unit("1/m").otherwise("pi").above(0);
    s.number("decay", "C^2: the vortices lose exp(-1) in its inverse")
        .unit("1/s")
        .otherwise("2*(0.01*pi)^2")
        .above(0);
    return s;
  }

  [[nodiscard]] const std::vector<Member>& members() const override {
    static const std::vector<Member> parts{
        {"velocity", 2},     {"velocity_gradient", 4}, {"pressure", 1},          {"fluid_force", 2},
        {"fluid_stress", 4}, {"displacement", 2},      {"displacement_rate", 2}, {"displacement_gradient", 4},
        {"body_force", 2},   {"body_stress", 4}};
    return parts;
  }

  void evaluate(int part, const double* x, double t, double* value) const override {
    const auto put = [&](const auto& result) { std::copy(result.c.begin(), result.c.end(), value); };
    const Event<double> here{x[0], x[1], t};
    switch (part) {
      case 0:
        return put(fields_.velocity(fluid_amplitude_, here));
      case 1:
        return put(space_gradient(fields_.velocity(fluid_amplitude_, once(x, t))));
      case 2:
        *value = fields_.pressure(1, here);
        return;
      case 3:
        return put(
            fluid_.force(fields_.velocity(fluid_amplitude_, twice(x, t)), fields_.pressure(1, once(x, t))));
      case 4:
        return put(fluid_.stress(space_gradient(fields_.velocity(fluid_amplitude_, once(x, t))),
                                 fields_.pressure(1, here)));
      case 5:
        return put(fields_.displacement(body_amplitude_, here));
      case 6: {
        const auto u = fields_.displacement(body_amplitude_, once(x, t));
        return put(Vec<2, double>{u[0].d[2], u[1].d[2]});
      }
      case 7:
        return put(space_gradient(fields_.displacement(body_amplitude_, once(x, t))));
      case 8:
        return put(body_.force(fields_.displacement(body_amplitude_, twice(x, t))));
      default:
        return put(body_.cauchy(space_gradient(fields_.displacement(body_amplitude_, once(x, t)))));
    }
  }

  void rates(int part, const double* x, double t, double* rate, double* second_rate) const override {
    switch (part) {
      case 0:
        return put_rates<2>(fields_.velocity(fluid_amplitude_, twice(x, t)), rate, second_rate);
      case 2:
        return put_rates<2>(fields_.pressure(1, twice(x, t)), rate, second_rate);
      case 5:
        return put_rates<2>(fields_.displacement(body_amplitude_, twice(x, t)), rate, second_rate);
      default:
        return Function::rates(part, x, t, rate, second_rate);
    }
  }

 private:
  double fluid_amplitude_, body_amplitude_;
  Vortices fields_;
  Newtonian fluid_;
  NeoHookean body_;
};

}  // namespace

void declare_fsi_vortices(Registry& registry) {
  registry.add<Function>(
      "function", "fsi_vortices", FsiVortices::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<FsiVortices>(p); });
}

}  // namespace seam::manufactured
