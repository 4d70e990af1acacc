// SPDX-License-Identifier: BSD-3-Clause
#include "fpi_vortices.hpp"

#include "seam/scene/function.hpp"
#include "vortices.hpp"

namespace seam::manufactured {
namespace {

/// The porous body of thesis 4.4.1: constant porosity, isotropic material permeability.
struct Porous {
  double porosity, permeability;
  bool kozeny_carman;  ///< thesis (4.26): K changes with J phi
  double viscosity;

  /// mu phi k^-1 w, Pa/m of current volume, with k = J^-1 F K F^T.
  [[nodiscard]] Vec<2, double> drag(const Mat<2, 2, double>& displacement_gradient,
                                    const Vec<2, double>& w) const {
    const Mat<2, 2, double> f = displacement_gradient + identity<2>(), back = inverse(f);
    const double volume = determinant(f);
    double k = permeability;
    if (kozeny_carman) k *= opened(volume * porosity) / opened(porosity);
    return (viscosity * porosity * volume / k) * (transpose(back) * (back * w));
  }

 private:
  static double opened(double m) { return m * m * m / (1 - m * m); }
};

class FpiVortices final : public Function {
 public:
  explicit FpiVortices(const Parameters& p)
      : fluid_amplitude_(p.number("fluid_amplitude")),
        pore_amplitude_(p.number("pore_amplitude")),
        body_amplitude_(p.number("body_amplitude")),
        fields_{p.number("wave_number"), p.number("decay")},
        fluid_{p.number("density"), p.number("viscosity")},
        porous_{p.number("porosity"), p.number("permeability"), p.boolean("kozeny_carman"),
                p.number("viscosity")},
        skeleton_(p.number("body_density"), p.number("young"), p.number("poisson")) {
    if (p.dimension() != 2) throw Error(p.where(), "`fpi_vortices` are plane: give `dimension: 2`");
  }

  static Schema schema() {
    Schema s(
        "Vortices in a fluid and in a porous neo-Hookean body of constant porosity, thesis (4.12)-(4.23). "
        "Where a place is meant: velocity, velocity_gradient, pressure, fluid_force (per mass), "
        "fluid_stress, "
        "left_traction (on a boundary that faces -x), flow (velocity less porosity times that in the pores), "
        "excess_stress (fluid_stress plus the pressure in the pores). At a material point: displacement, "
        "displacement_rate, displacement_gradient, "
        "pore_velocity, pore_velocity_gradient, pore_pressure, pore_force (per mass of fluid), mixture_force "
        "(per mass of skeleton), mixture_stress (Cauchy, with the pressure), body_flow (the part of the "
        "skeleton's velocity that `flow` is compared with).");
    s.number("viscosity", "Of the fluid").unit("Pa s").above(0);
    s.number("density", "Of the fluid").unit("kg/m^3").otherwise("1").above(0);
    s.number("body_density", "Of the skeleton, averaged").unit("kg/m^3").otherwise("1").above(0);
    s.number("young", "Young's modulus of the skeleton").unit("Pa").above(0);
    s.number("poisson", "Poisson's ratio of the skeleton").at_least(0).below(0.5);
    s.number("porosity", "phi").above(0).below(1);
    s.number("permeability", "Of the material, K").unit("m^2").above(0);
    s.boolean("kozeny_carman", "K changes with J phi").otherwise("false");
    s.number("fluid_amplitude", "A_F: largest velocity of the fluid").unit("m/s").otherwise("0.1");
    s.number("pore_amplitude", "A_P: largest velocity in the pores").unit("m/s").otherwise("0.21");
    s.number("body_amplitude", "A_PS: largest velocity of the skeleton at the start")
        .unit("m/s")
        .otherwise("-0.01");
    s.number("wave_number", "B").unit("1/m").otherwise("pi").above(0);
    s.number("decay", "The vortices lose exp(-1) in its inverse")
        .unit("1/s")
        .otherwise("2*(0.01*pi)^2")
        .above(0);
    return s;
  }

  [[nodiscard]] const std::vector<Member>& members() const override {
    static const std::vector<Member> parts{{"velocity", 2},          {"velocity_gradient", 4},
                                           {"pressure", 1},          {"fluid_force", 2},
                                           {"fluid_stress", 4},      {"flow", 2},
                                           {"excess_stress", 4},     {"displacement", 2},
                                           {"displacement_rate", 2}, {"displacement_gradient", 4},
                                           {"pore_velocity", 2},     {"pore_velocity_gradient", 4},
                                           {"pore_pressure", 1},     {"pore_force", 2},
                                           {"mixture_force", 2},     {"mixture_stress", 4},
                                           {"body_flow", 2},         {"left_traction", 2}};
    return parts;
  }

  void evaluate(int part, const double* x, double t, double* value) const override {
    const auto put = [&](const auto& result) { std::copy(result.c.begin(), result.c.end(), value); };
    const Event<double> here{x[0], x[1], t};
    switch (part) {
      case 0:
        return put(velocity(here));
      case 1:
        return put(space_gradient(velocity(once(x, t))));
      case 2:
        *value = pressure(here);
        return;
      case 3:
        return put(fluid_.force(velocity(twice(x, t)), pressure(once(x, t))));
      case 4:
        return put(fluid_.stress(space_gradient(velocity(once(x, t))), pressure(here)));
      case 5:
        return put(velocity(here) - porous_.porosity * in_pores(here));
      case 6:
        return put(fluid_.stress(space_gradient(velocity(once(x, t))), 0.0));
      case 7:
        return put(displacement(here));
      case 8:
        return put(rate(x, t));
      case 9:
        return put(space_gradient(displacement(once(x, t))));
      case 10:
        return put(in_pores(moved(here)));
      case 11:
        return put(space_gradient(in_pores(moved(once(x, t)))));
      case 12:
        *value = pressure(moved(here));
        return;
      case 13:
        return put(pore_force(x, t));
      case 14:
        return put(mixture_force(x, t));
      case 15: {
        Mat<2, 2, double> stress = skeleton_.cauchy(space_gradient(displacement(once(x, t))));
        for (int i = 0; i < 2; ++i) stress(i, i) -= pressure(moved(here));
        return put(stress);
      }
      case 16:
        return put((1 - porous_.porosity) * rate(x, t));
      default: {
        const auto stress = fluid_.stress(space_gradient(velocity(once(x, t))), pressure(here));
        return put(Vec<2, double>{-stress(0, 0), -stress(1, 0)});
      }
    }
  }

  void rates(int part, const double* x, double t, double* rate, double* second_rate) const override {
    switch (part) {
      case 0:
        return put_rates<2>(velocity(twice(x, t)), rate, second_rate);
      case 2:
        return put_rates<2>(pressure(twice(x, t)), rate, second_rate);
      case 7:
        return put_rates<2>(displacement(twice(x, t)), rate, second_rate);
      case 10:
        return put_rates<2>(in_pores(moved(twice(x, t))), rate, second_rate);
      case 12:
        return put_rates<2>(pressure(moved(twice(x, t))), rate, second_rate);
      default:
        return Function::rates(part, x, t, rate, second_rate);
    }
  }

 private:
  template <class T>
  [[nodiscard]] Vec<2, T> velocity(const Event<T>& e) const {
    return fields_.velocity(fluid_amplitude_, e);
  }
  template <class T>
  [[nodiscard]] Vec<2, T> in_pores(const Event<T>& e) const {
    return fields_.velocity(pore_amplitude_, e);
  }
  template <class T>
  [[nodiscard]] T pressure(const Event<T>& e) const {
    return fields_.pressure(fluid_.density, e);
  }
  template <class T>
  [[nodiscard]] Vec<2, T> displacement(const Event<T>& e) const {
    return fields_.displacement(body_amplitude_, e);
  }
  /// Where a material point is.
  template <class T>
  [[nodiscard]] Event<T> moved(const Event<T>& e) const {
    const Vec<2, T> u = displacement(e);
    return {T(e[0] + u[0]), T(e[1] + u[1]), e[2]};
  }
  [[nodiscard]] Vec<2, double> rate(const double* x, double t) const {
    const auto u = displacement(once(x, t));
    return {u[0].d[2], u[1].d[2]};
  }
  [[nodiscard]] Vec<2, double> drag(const double* x, double t) const {
    return porous_.drag(space_gradient(displacement(once(x, t))),
                        in_pores(moved(Event<double>{x[0], x[1], t})) - rate(x, t));
  }
  [[nodiscard]] Vec<2, double> pressure_slope(const double* x, double t) const {
    const Event<double> there = moved(Event<double>{x[0], x[1], t});
    const Once p = pressure(once(there.data(), t));
    return {p.d[0], p.d[1]};
  }
  /// Thesis (4.18): dv/dt at a fixed place, as the observer's own motion drops out.
  [[nodiscard]] Vec<2, double> pore_force(const double* x, double t) const {
    const Event<double> there = moved(Event<double>{x[0], x[1], t});
    const auto v = in_pores(once(there.data(), t));
    Vec<2, double> force = (1 / fluid_.density) * (pressure_slope(x, t) + drag(x, t));
    for (int i = 0; i < 2; ++i) force[i] += v[i].d[2];
    return force;
  }
  /// Thesis (4.19).
  [[nodiscard]] Vec<2, double> mixture_force(const double* x, double t) const {
    const double volume = determinant(space_gradient(displacement(once(x, t))) + identity<2>());
    return skeleton_.force(displacement(twice(x, t))) +
           (volume / skeleton_.density) *
               ((1 - porous_.porosity) * pressure_slope(x, t) - porous_.porosity * drag(x, t));
  }

  double fluid_amplitude_, pore_amplitude_, body_amplitude_;
  Vortices fields_;
  Newtonian fluid_;
  Porous porous_;
  NeoHookean skeleton_;
};

}  // namespace

void declare_fpi_vortices(Registry& registry) {
  registry.add<Function>(
      "function", "fpi_vortices", FpiVortices::schema(),
      [](const Parameters& p, const Registry&) { return std::make_unique<FpiVortices>(p); });
}

}  // namespace seam::manufactured
