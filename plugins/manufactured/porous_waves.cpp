// SPDX-License-Identifier: BSD-3-Clause
#include "porous_waves.hpp"

#include "balance.hpp"
#include "seam/scene/function.hpp"

namespace seam::manufactured {
namespace {

/// Relation (2.51) of porosity, pressure and change of volume, solved by Newton's method.
struct Pores {
  double initial, bulk, opening;

  /// m = J phi. Each iteration beyond convergence makes derivatives of one order more exact.
  template <class T>
  [[nodiscard]] T fluid_volume(const T& jacobian, const T& pressure) const {
    const T a = pressure + (bulk / (1 - initial) - opening / initial);
    T solid = (1 - initial) * jacobian;
    for (int k = 0; k < 12; ++k) {
      const T fluid = jacobian - solid;
      const T miss = bulk / solid - opening / fluid - a;
      solid += miss / (bulk / (solid * solid) + opening / (fluid * fluid));
    }
    return jacobian - solid;
  }
};

/// A wave, or the straight line that it is near its zero: linear finite elements hold it exactly.
struct Wave {
  bool straight;
  template <class T>
  [[nodiscard]] T operator()(const T& at) const {
    using std::sin;
    if (straight) return at;
    return sin(at);
  }
};

template <int dim>
class PorousWaves final : public Function {
  using First = Fad<dim + 1>;
  using Second = Fad<dim + 1, First>;
  template <class T>
  using Event = std::array<T, dim + 1>;

 public:
  explicit PorousWaves(const Parameters& p)
      : in_space_{p.text("in_space") == "straight"},
        in_time_{p.text("in_time") == "straight"},
        wave_number_(p.number("wave_number")),
        frequency_(p.number("frequency")),
        strain_(p.number("strain")),
        speed_(p.number("speed")),
        pressure_(p.number("pressure")),
        density_(p.number("density")),
        viscosity_(p.number("viscosity")),
        pores_{p.number("porosity"), p.number("bulk"), p.number("opening")},
        permeability_(p.vector("permeability")),
        kozeny_carman_(p.boolean("kozeny_carman")),
        skeleton_(p.number("body_density"), p.number("young"), p.number("poisson")) {
    if (permeability_.size() != dim)
      throw Error(p.where("permeability"), "found " + std::to_string(permeability_.size()) +
                                               " numbers; expected " + std::to_string(dim) +
                                               ", the diagonal");
  }

  [[nodiscard]] const std::vector<Member>& members() const override {
    static const std::vector<Member> parts{{"displacement", dim},
                                           {"displacement_gradient", dim * dim},
                                           {"displacement_rate", dim},
                                           {"velocity", dim},
                                           {"velocity_gradient", dim * dim},
                                           {"pressure", 1},
                                           {"pressure_gradient", dim},
                                           {"porosity", 1},
                                           {"mass_source", 1},
                                           {"fluid_force", dim},
                                           {"mixture_force", dim},
                                           {"right_traction", dim},
                                           {"top_seepage", 1}};
    return parts;
  }

  void evaluate(int part, const double* x, double t, double* value) const override {
    const auto put = [&](const auto& result) { std::copy(result.c.begin(), result.c.end(), value); };
    const Event<double> here = event(x, t);
    const Event<First> once = differentiated<First>(here);
    const Event<Second> twice = differentiated<Second>(once);
    switch (part) {
      case 0:
        return put(displacement(here));
      case 1:
        return put(space_gradient<dim>(displacement(once)));
      case 2:
        return put(rate(displacement(once)));
      case 3:
        return put(velocity(here));
      case 4:
        return put(space_gradient<dim>(velocity(once)));
      case 5:
        *value = pressure(here);
        return;
      case 6:
        return put(slope(pressure(once)));
      case 7:
        *value = at(once, here).porosity;
        return;
      case 8:
        *value = mass_source(at(twice, once));
        return;
      case 9:
        return put(fluid_force(at(once, here)));
      case 10:
        return put(mixture_force(twice, at(twice, once)));
      case 11: {
        const Mat<dim, dim, double> stress = total_stress(at(once, here));
        for (int i = 0; i < dim; ++i) value[i] = stress(i, 0);
        return;
      }
      default: {
        // phi w.n with n da = J F^-T N dA
        const State<double> s = at(once, here);
        double stretch = 0;
        for (int i = 0; i < dim; ++i) stretch += s.back(1, i) * s.back(1, i);
        *value = flux(s)[1] / (s.volume * std::sqrt(stretch));
      }
    }
  }

  void rates(int part, const double* x, double t, double* rate, double* second_rate) const override {
    const Event<Second> twice = differentiated<Second>(differentiated<First>(event(x, t)));
    switch (part) {
      case 0:
        return put_rates<dim>(displacement(twice), rate, second_rate);
      case 3:
        return put_rates<dim>(velocity(twice), rate, second_rate);
      case 5:
        return put_rates<dim>(pressure(twice), rate, second_rate);
      default:
        return Function::rates(part, x, t, rate, second_rate);
    }
  }

 private:
  [[nodiscard]] static Event<double> event(const double* x, double t) {
    Event<double> here;
    std::copy_n(x, dim, here.begin());
    here[dim] = t;
    return here;
  }
  template <class D, class T>
  [[nodiscard]] static Event<D> differentiated(const Event<T>& at) {
    Event<D> result;
    for (int i = 0; i <= dim; ++i) result[i] = D(at[i], i);
    return result;
  }

  /// All that the balances speak of, at a material point.
  template <class T>
  struct State {
    Mat<dim, dim, T> displacement_gradient, back;  ///< back: F^-1
    Mat<dim, dim, T> velocity_gradient;
    Vec<dim, T> skeleton_velocity, seepage, fluid_rate, pressure_slope;
    T pressure, volume, fluid_volume, porosity;
  };

  /// @param event of a type with one more derivative than T
  template <class D, class T>
  [[nodiscard]] State<T> at(const Event<D>& event, const Event<T>& value) const {
    State<T> s;
    const Vec<dim, D> u = displacement(event), v = velocity(event);
    s.displacement_gradient = space_gradient<dim>(u);
    const Mat<dim, dim, T> f = s.displacement_gradient + identity<dim>();
    s.back = inverse(f);
    s.volume = determinant(f);
    s.velocity_gradient = space_gradient<dim>(v);
    s.skeleton_velocity = rate(u);
    s.seepage = velocity(value) - s.skeleton_velocity;
    s.fluid_rate = rate(v);
    s.pressure = pressure(value);
    s.pressure_slope = slope(pressure(event));
    s.fluid_volume = pores_.fluid_volume(s.volume, s.pressure);
    s.porosity = s.fluid_volume / s.volume;
    return s;
  }

  template <class T>
  [[nodiscard]] static Vec<dim, T> rate(const Vec<dim, Fad<dim + 1, T>>& field) {
    Vec<dim, T> result;
    for (int i = 0; i < dim; ++i) result[i] = field[i].d[dim];
    return result;
  }
  template <class T>
  [[nodiscard]] static Vec<dim, T> slope(const Fad<dim + 1, T>& field) {
    Vec<dim, T> result;
    for (int i = 0; i < dim; ++i) result[i] = field.d[i];
    return result;
  }

  template <class T>
  [[nodiscard]] Vec<dim, T> displacement(const Event<T>& e) const {
    const T now = strain_ / wave_number_ * (1.0 + 0.5 * in_time_(T(frequency_ * e[dim])));
    Vec<dim, T> u;
    for (int i = 0; i < dim; ++i)
      u[i] = now * in_space_(T(wave_number_ * (0.6 * e[i] + 0.8 * e[(i + 1) % dim]) + 0.3 * i));
    return u;
  }
  template <class T>
  [[nodiscard]] Vec<dim, T> velocity(const Event<T>& e) const {
    const T now = speed_ * (1.0 - 0.6 * in_time_(T(1.3 * frequency_ * e[dim])));
    Vec<dim, T> v;
    for (int i = 0; i < dim; ++i)
      v[i] = now * in_space_(T(wave_number_ * (0.5 * e[i] - 0.9 * e[(i + 1) % dim]) + 0.4 - 0.5 * i));
    return v;
  }
  template <class T>
  [[nodiscard]] T pressure(const Event<T>& e) const {
    T along = e[0];
    for (int i = 1; i < dim; ++i) along += (i == 1 ? -0.7 : 0.5) * e[i];
    return pressure_ * (1.0 + 0.7 * in_time_(T(0.8 * frequency_ * e[dim]))) *
           in_space_(T(wave_number_ * along + 0.2));
  }

  /// phi w carried back to the reference configuration, per reference area.
  template <class T>
  [[nodiscard]] static Vec<dim, T> flux(const State<T>& s) {
    return s.fluid_volume * (s.back * s.seepage);
  }
  /// (2.43) per reference volume: dm/dt + Div(m F^-1 w).
  [[nodiscard]] double mass_source(const State<First>& s) const {
    const Vec<dim, First> flow = flux(s);
    double source = s.fluid_volume.d[dim];
    for (int i = 0; i < dim; ++i) source += flow[i].d[i];
    return source;
  }
  /// mu phi k^-1 w with k = J^-1 F K F^T, Pa/m of current volume.
  [[nodiscard]] Vec<dim, double> drag(const State<double>& s) const {
    double opened = 1;
    if (kozeny_carman_) {
      const double m = s.fluid_volume, m0 = pores_.initial;
      opened = m * m * m / (1 - m * m) / (m0 * m0 * m0 / (1 - m0 * m0));
    }
    Vec<dim, double> through = s.back * s.seepage;
    for (int i = 0; i < dim; ++i) through[i] /= permeability_[i] * opened;
    return (viscosity_ * s.porosity * s.volume) * (transpose(s.back) * through);
  }
  /// (2.44) per mass: dv/dt at a fixed place, plus (grad p + drag)/rho.
  [[nodiscard]] Vec<dim, double> fluid_force(const State<double>& s) const {
    return s.fluid_rate - s.velocity_gradient * (s.back * s.skeleton_velocity) +
           (1 / density_) * (transpose(s.back) * s.pressure_slope + drag(s));
  }
  /// First Piola-Kirchhoff stress of the mixture.
  template <class T>
  [[nodiscard]] Mat<dim, dim, T> total_stress(const State<T>& s) const {
    const T back_pressure = s.pressure - pores_.opening * (1 / pores_.initial - 1 / s.fluid_volume);
    return skeleton_.piola(s.displacement_gradient) - (back_pressure * s.volume) * transpose(s.back);
  }
  /// (2.46) per mass of the skeleton.
  [[nodiscard]] Vec<dim, double> mixture_force(const Event<Second>& event, const State<First>& s) const {
    State<double> now;
    now.back = plain(s.back);
    now.seepage = plain(s.seepage);
    now.porosity = s.porosity.v;
    now.fluid_volume = s.fluid_volume.v;
    now.volume = s.volume.v;
    const Vec<dim, double> slope_now = transpose(now.back) * plain(s.pressure_slope);
    Vec<dim, double> force = (-1 / skeleton_.density) *
                             (divergence<dim>(total_stress(s)) + now.fluid_volume * (slope_now + drag(now)));
    const Vec<dim, Second> u = displacement(event);
    for (int i = 0; i < dim; ++i) force[i] += u[i].d[dim].d[dim];
    return force;
  }

  template <int n, class T>
  [[nodiscard]] static Vec<n, double> plain(const Vec<n, T>& a) {
    Vec<n, double> result;
    for (int i = 0; i < n; ++i) result[i] = seam::plain(a[i]);
    return result;
  }
  template <int n, class T>
  [[nodiscard]] static Mat<n, n, double> plain(const Mat<n, n, T>& a) {
    Mat<n, n, double> result;
    for (int i = 0; i < n * n; ++i) result.c[i] = seam::plain(a.c[i]);
    return result;
  }

  Wave in_space_, in_time_;
  double wave_number_, frequency_, strain_, speed_, pressure_, density_, viscosity_;
  Pores pores_;
  std::vector<double> permeability_;
  bool kozeny_carman_;
  NeoHookean skeleton_;
};

Schema schema() {
  Schema s(
      "Waves in a porous neo-Hookean body whose porosity changes, at finite strain, in the plane or in "
      "space; "
      "all at a material point. Parts: displacement, displacement_gradient, displacement_rate, velocity (in "
      "the pores), velocity_gradient, pressure, pressure_gradient, porosity, mass_source (per reference "
      "volume), fluid_force (per mass), mixture_force (per mass of the skeleton), right_traction (on the "
      "mixture per reference area, where the boundary faces +x in the reference configuration), and "
      "top_seepage (out of a boundary that faces +y in the reference configuration, per current area).");
  s.choice("in_space", "`straight`: linear finite elements hold all three unknowns exactly",
           {"wavy", "straight"})
      .otherwise("wavy");
  s.choice("in_time", "`straight`: the Euler backward scheme has the rates of all three unknowns exactly",
           {"wavy", "straight"})
      .otherwise("wavy");
  s.number("wave_number", "Of all waves in space").unit("1/m").otherwise("2").above(0);
  s.number("frequency", "Angular, of the waves in time; 0 is at rest").unit("1/s").otherwise("1").at_least(0);
  s.number("strain", "Scale of the displacement gradient").otherwise("0.2").at_least(0);
  s.number("speed", "Scale of the velocity in the pores").unit("m/s").otherwise("1").at_least(0);
  s.number("pressure", "Scale of the pressure in the pores").unit("Pa").otherwise("1").at_least(0);
  s.number("viscosity", "Of the fluid").unit("Pa s").above(0);
  s.number("density", "Of the fluid").unit("kg/m^3").above(0);
  s.number("body_density", "Of the skeleton, averaged").unit("kg/m^3").above(0);
  s.number("young", "Young's modulus of the skeleton").unit("Pa").above(0);
  s.number("poisson", "Poisson's ratio of the skeleton").at_least(0).below(0.5);
  s.number("porosity", "phi_0").above(0).below(1);
  s.number("bulk", "kappa^P").unit("Pa").above(0);
  s.number("opening", "eta^P").unit("Pa").above(0);
  s.vector("permeability", "The diagonal of the material permeability K").unit("m^2").entries(-1);
  s.boolean("kozeny_carman", "K changes with the fluid's volume").otherwise("false");
  return s;
}

}  // namespace

void declare_porous_waves(Registry& registry) {
  registry.add<Function>("function", "porous_waves", schema(),
                         [](const Parameters& p, const Registry&) -> std::unique_ptr<Function> {
                           if (p.dimension() == 2) return std::make_unique<PorousWaves<2>>(p);
                           return std::make_unique<PorousWaves<3>>(p);
                         });
}

}  // namespace seam::manufactured
