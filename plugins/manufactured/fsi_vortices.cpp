// SPDX-License-Identifier: BSD-3-Clause
#include "fsi_vortices.hpp"

#include "balance.hpp"
#include "seam/scene/function.hpp"

namespace seam::manufactured {
namespace {

/// The fields of thesis (3.42)-(3.44), with the sign of (3.44) that makes du/dt the solid's velocity.
struct Vortices {
  double fluid_amplitude, body_amplitude;
  double wave_number;  ///< B, 1/m
  double decay;        ///< C^2, 1/s

  template <class T>
  [[nodiscard]] Vec<2, T> swirl(const Event<T>& e) const {
    using std::cos, std::sin;
    const T x = wave_number * e[0], y = wave_number * e[1];
    return {-(cos(x) * sin(y)), sin(x) * cos(y)};
  }
  template <class T>
  [[nodiscard]] Vec<2, T> velocity(const Event<T>& e) const {
    using std::exp;
    return T(fluid_amplitude * exp(-decay * e[2])) * swirl(e);
  }
  template <class T>
  [[nodiscard]] T pressure(const Event<T>& e) const {
    using std::cos, std::exp;
    return -0.25 * exp(-2 * decay * e[2]) * (cos(2 * wave_number * e[0]) + cos(2 * wave_number * e[1]));
  }
  template <class T>
  [[nodiscard]] Vec<2, T> displacement(const Event<T>& e) const {
    using std::expm1;
    // expm1: 1 - exp would lose five digits.
    return T((-body_amplitude / decay) * expm1(-decay * e[2])) * swirl(e);
  }
};

class FsiVortices final : public Function {
 public:
  explicit FsiVortices(const Parameters& p)
      : fields_{p.number("fluid_amplitude"), p.number("body_amplitude"), p.number("wave_number"),
                p.number("decay")},
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

  [[nodiscard]] const std::vector<Part>& parts() const override {
    static const std::vector<Part> parts{
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
        return put(fields_.velocity(here));
      case 1:
        return put(space_gradient(fields_.velocity(once(x, t))));
      case 2:
        *value = fields_.pressure(here);
        return;
      case 3:
        return put(fluid_.force(fields_.velocity(twice(x, t)), fields_.pressure(once(x, t))));
      case 4:
        return put(fluid_.stress(space_gradient(fields_.velocity(once(x, t))), fields_.pressure(here)));
      case 5:
        return put(fields_.displacement(here));
      case 6: {
        const auto u = fields_.displacement(once(x, t));
        return put(Vec<2, double>{u[0].d[2], u[1].d[2]});
      }
      case 7:
        return put(space_gradient(fields_.displacement(once(x, t))));
      case 8:
        return put(body_.force(fields_.displacement(twice(x, t))));
      default:
        return put(body_.cauchy(space_gradient(fields_.displacement(once(x, t)))));
    }
  }

 private:
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
