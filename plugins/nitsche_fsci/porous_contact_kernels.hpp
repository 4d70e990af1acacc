// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "contact_in_fluid_kernels.hpp"
#include "fluid_porous.hpp"
#include "pore_seal.hpp"

/// Fluid, porous body and its contact with another one by one formula, thesis chapter 7. With the body's
/// outward normal n = -n_F, w = v_P - du/dt and the seepage q = phi w.n out of the body:
///
///   the mixture gets   min(F, S) n,   S = n . sigma_P n + gamma_S g, sigma_P with the pore pressure,
///   the fluid          F n and its friction,   F = n . sigma_F n + gamma_F ((v - du/dt) . n - q^)
///   the pores          -p^ n,         and lose q^ to the fluid.
///
/// Against a body that lets nothing through, q^ and p^ are what the seal leaves of seepage and of the fluid's
/// pressure: `Seal`. Against a porous one nothing is sealed: dry points have p^ = (p + p')/2 and q^ = (q -
/// q')/2 in both bodies, each look integrates its own half (7.21), (7.23). Free points are those of `fpi`,
/// the gap infinite; closed ones are dry, F is that of the nearest wet point; covered ones, where nothing is
/// known of what lies outside, are sealed and free of load.
///
/// Closed points have no fluid outside that would fill a gap as it opens: the pores do, they lose its rate g'
/// and resist it, q^ = g', p^ = p + c (q - g'). In touch g' is next to nothing, and they are sealed.
namespace seam::fsci {

using FacingDisplacement = Vector<5>;
using TipDisplacement = Vector<6>;
using FacingPressure = Scalar<7>;

/// What a point of the surface faces.
enum class Facing { nothing, tight, porous };

/// A porous body's own part of what its kernels read.
template <class... More>
using PorousReads =
    Slots<Value<Velocity>, Gradient<Velocity>, Value<Pressure>, Value<Displacement>, OldValue<Displacement>,
          Rate<Displacement>, Gradient<Displacement>, Value<PoreVelocity>, Value<PorePressure>, More...>;

/// The porous body at a point: its pores, and the stress between it and what it faces.
struct PorousSide {
  PorousMismatch mismatch;
  BodyPull bodies;
  double viscosity;  ///< Pa s
  Seal seal;

  template <class T>
  struct State {
    T porosity, permeability, seepage, pressure;
  };
  template <int dim, class T, class G, class S>
  [[nodiscard]] State<T> state(const Point<dim, G>& x, const S& s) const {
    const auto [porosity, permeability] = mismatch.template of_pores<dim, T>(s);
    const Vec<dim, T> w = s.value(PoreVelocity{}) - s.rate(Displacement{});
    return {porosity, permeability, T(-1.0 * porosity * dot(w, x.normal)), s.value(PorePressure{})};
  }
  /// c
  template <int dim, class T, class G>
  [[nodiscard]] T resistance(const Point<dim, G>& x, const State<T>& state) const {
    return (viscosity * x.cell_size) / state.permeability;
  }
  /// S
  template <Facing facing, int dim, class T, class G, class S>
  [[nodiscard]] T pull(const Point<dim, G>& x, const S& s) const {
    const T pressure = s.value(PorePressure{});
    const Mat<dim, dim, T> own = s.gradient(Displacement{});
    if constexpr (facing == Facing::porous) {
      const T opposite = s.value(FacingPressure{});
      return bodies.operator()<dim, T, G>(x, x.normal, own, s.gradient(FacingDisplacement{}), &pressure,
                                          &opposite);
    } else {
      return bodies.operator()<dim, T, G>(x, x.normal, own, own, &pressure);
    }
  }
  /// p, or its mean with that of pores opposite.
  template <Facing facing, class T, class S>
  [[nodiscard]] static T mean_pressure(const S& s) {
    if constexpr (facing == Facing::porous)
      return 0.5 * (s.value(PorePressure{}) + s.value(FacingPressure{}));
    else
      return s.value(PorePressure{});
  }
};

template <Facing facing>
struct FilmSlots {
  using Reads = PorousReads<Value<FacingDisplacement>, OldValue<FacingDisplacement>>;
  using Tests = Slots<Value<Velocity>, Gradient<Velocity>, Value<Pressure>, Value<Displacement>,
                      Value<PoreVelocity>, Value<PorePressure>>;
};
template <>
struct FilmSlots<Facing::nothing> {
  using Reads = PorousReads<>;
  using Tests = FilmSlots<Facing::tight>::Tests;
};
template <>
struct FilmSlots<Facing::porous> {
  using Reads = PorousReads<Value<FacingDisplacement>, OldValue<FacingDisplacement>,
                            Gradient<FacingDisplacement>, Value<FacingPressure>>;
  using Tests = Slots<Value<Velocity>, Gradient<Velocity>, Value<Pressure>, Value<Displacement>,
                      Value<PoreVelocity>, Value<PorePressure>, Value<FacingPressure>>;
};

/// The wet surface of a porous body.
template <Facing facing>
struct PorousFilm {
  static constexpr bool is_near = facing != Facing::nothing;
  using Reads = typename FilmSlots<facing>::Reads;
  using Tests = typename FilmSlots<facing>::Tests;
  static constexpr int movers = is_near ? 2 : 1;
  Flow flow;
  PorousSide body;
  Slip slip;     ///< near the other surface
  double alpha;  ///< of Beavers and Joseph; infinite: no slip
  Ties ties;
  /// Between pores: what is left of a film where points count as dry has the pressure of the pores, since it
  /// stays open to them, thesis (7.30); else that of the fluid beside it, (7.29).
  bool fades = false;

  /// @param x side 0's point, normal out of the fluid
  template <int dim, class T, class G>
  [[nodiscard]] Exchange<T> passes(const Point<dim, G>& x, const Trial<dim, T, Reads>& s) const {
    const auto state = body.template state<dim, T, G>(x, s);
    const Vec<dim, G>& n = x.normal;
    const Vec<dim, T> velocity = s.value(Velocity{});
    const T stress = dot(n, ((2 * flow.viscosity) * sym(s.gradient(Velocity{}))) * n) - s.value(Pressure{});
    const T penalty = (ties.normal_penalty / x.trace_size) * fsci::resistance<dim, T, G>(flow, x, velocity);
    const T speed = -1.0 * dot(velocity - s.rate(Displacement{}), n);
    T sealed(0.0);
    if constexpr (facing == Facing::porous) {
      if (plain(x.gap) <= 0 || (!fades && body.seal.is_dry(x, start<dim, T, G>(x, s)))) {
        const T pull = stress + penalty * speed,
                leak = (Seal::left_open / body.template resistance<dim, T, G>(x, state)) *
                       (state.pressure + pull);
        return between_pores<T>(pull, PorousSide::mean_pressure<facing, T>(s), state.seepage, T(0.0), leak);
      }
    } else {
      sealed = body.seal.template closed<dim, T, G>(x, start<dim, T, G>(x, s));
    }
    return exchange<T>(body.seal, sealed, stress, penalty, speed, state.pressure, state.seepage,
                       body.template resistance<dim, T, G>(x, state));
  }

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    using std::sqrt;
    const auto state = body.template state<dim, T, G>(x, s);
    const Exchange<T> passing = passes<dim, T, G>(x, s);
    const Vec<dim, G>& n = x.normal;
    Vec<dim, T> jump = body.mismatch.template operator()<dim, T, G>(x, s, state.porosity);
    const T across = dot(s.value(Velocity{}) - s.rate(Displacement{}), n) + passing.into_fluid;
    jump += (across - dot(jump, n)) * n;
    Slip::Ratio<T> ratio{T((1 / alpha) * sqrt(state.permeability)), T(1.0)};
    if constexpr (is_near) ratio = near_ratio<dim, T, G>(x, ratio.gliding);
    const Vec<dim, T> traction = tie<dim, T, G>(flow, ties, x, s, jump, ratio, nullptr, r);
    r.value(Displacement{}) -= traction;
    r.value(PoreVelocity{}) -= passing.pore_pressure * n;
    r.value(PorePressure{}) += passing.out_of_pores;
    if constexpr (facing == Facing::porous) r.value(FacingPressure{}) -= passing.into_facing;
    if constexpr (is_near) {
      const T contact = body.template pull<facing, dim, T, G>(x, s);
      if (plain(contact) < plain(passing.pull)) r.value(Displacement{}) += (contact - passing.pull) * n;
    }
  }

  /// The gap at the start of the step, by how far the surfaces have come since.
  template <int dim, class T, class G>
  [[nodiscard]] static double start(const Point<dim, G>& x, const Trial<dim, T, Reads>& s) {
    if constexpr (is_near) {
      double gap = plain(x.gap);
      const auto u = s.value(Displacement{}), u_old = s.old_value(Displacement{}),
                 opposite = s.value(FacingDisplacement{}), opposite_old = s.old_value(FacingDisplacement{});
      for (int i = 0; i < dim; ++i)
        gap -= (plain(u[i]) - plain(u_old[i]) - plain(opposite[i]) + plain(opposite_old[i])) *
               plain(x.normal[i]);
      return gap;
    } else {
      return std::numeric_limits<double>::infinity();
    }
  }

 private:
  /// Slip over the pores, and over what a narrow gap adds.
  template <int dim, class T, class G>
  [[nodiscard]] Slip::Ratio<T> near_ratio(const Point<dim, G>& x, const T& length) const {
    const double reach = slip.reach > 0 ? slip.reach : x.cell_size / std::sqrt(static_cast<double>(dim));
    if (slip.near == 0 || plain(x.gap) >= reach) return {length, T(1.0)};
    if (plain(x.gap) <= 0) return {T(1.0), T(0.0)};
    return {slip.near * reach * (reach - x.gap) + length * x.gap, T(x.gap)};
  }
};

/// p^ of a sealed surface, where nothing passes but what fills a gap: c (q - g') holds the normal velocity of
/// the fluid in the pores.
template <int dim, class T, class G, class S>
T sealed_pressure(const PorousSide& body, const Point<dim, G>& x, const S& s, const T& opening) {
  const auto state = body.template state<dim, T, G>(x, s);
  if (body.seal.kind != Seal::Kind::resistance) return state.pressure;
  return state.pressure + body.template resistance<dim, T, G>(x, state) * (state.seepage - opening);
}

/// g' where the bodies are next to each other: what overlaps has nothing to fill, and what is farther away
/// than films that come back lies outside of the fluid's mesh. In between it fades.
template <int dim, class T, class G, class S>
T opening_of(const Point<dim, G>& x, const S& s) {
  const double ahead = 5e-3 * x.cell_size, behind = 1e-3 * x.cell_size, gap = plain(x.gap);
  if (gap <= -behind || gap >= ahead) return T(0.0);
  T part(1.0);
  if (gap < 0) part += (1 / behind) * T(x.gap);
  if (gap > 0.5 * ahead) part -= (2 / ahead) * (T(x.gap) - 0.5 * ahead);
  const Vec<dim, T> apart = s.rate(FacingDisplacement{}) - s.rate(Displacement{});
  return T(-1.0 * part * dot(apart, x.normal));
}

/// What the pores of a closed surface have for the fluid's traction, thesis (7.30), while the gap rests.
template <Facing facing, int dim, class T, class G, class S>
T pull_of_pores(const PorousSide& body, const Point<dim, G>& x, const S& s) {
  if constexpr (facing == Facing::porous)
    return T(-PorousSide::mean_pressure<facing, T>(s));
  else
    return T(-sealed_pressure<dim, T, G>(body, x, s, T(0.0)));
}

/// min(F, S) on the mixture, and pores that are sealed, or open to those opposite. What fills a gap resists
/// in contact as it does beside it, part c g': within F alone it would turn whatever opens quickly into
/// contact.
/// @param part of F that is the pores' own
template <Facing facing, int dim, class T, class G, class S, class R>
void add_dry(const PorousSide& body, const Point<dim, G>& x, const S& s, const T& pull, const T& part,
             const T& opening, R& r) {
  const T contact = body.template pull<facing, dim, T, G>(x, s);
  r.value(Displacement{}) += (plain(contact) < plain(pull) ? contact : pull) * x.normal;
  if constexpr (facing == Facing::porous) {
    if (body.seal.meets(x)) {
      const Exchange<T> passing = between_pores<T>(pull, PorousSide::mean_pressure<facing, T>(s),
                                                   body.template state<dim, T, G>(x, s).seepage, opening);
      r.value(PoreVelocity{}) -= passing.pore_pressure * x.normal;
      r.value(PorePressure{}) += passing.out_of_pores;
      r.value(FacingPressure{}) -= passing.into_facing;
      return;
    }
  } else if (body.seal.kind == Seal::Kind::resistance && plain(part) > 0) {
    const T c = body.template resistance<dim, T, G>(x, body.template state<dim, T, G>(x, s));
    r.value(Displacement{}) += (part * opening * c) * x.normal;
  }
  r.value(PoreVelocity{}) -= sealed_pressure<dim, T, G>(body, x, s, opening) * x.normal;
  r.value(PorePressure{}) += opening;
}

template <Facing facing>
struct DrySlots {
  template <class... More>
  using Reads = Slots<More..., Rate<FacingDisplacement>>;
  using Tests = Slots<Value<Displacement>, Value<PoreVelocity>, Value<PorePressure>>;
};
template <>
struct DrySlots<Facing::porous> {
  template <class... More>
  using Reads = Slots<More..., Rate<FacingDisplacement>, Gradient<FacingDisplacement>, Value<FacingPressure>>;
  using Tests = Slots<Value<Displacement>, Value<PoreVelocity>, Value<PorePressure>, Value<FacingPressure>>;
};

/// The closed surface of a porous body.
template <Facing facing>
struct PorousClosed {
  using Reads = typename DrySlots<facing>::template Reads<
      Value<Velocity>, Gradient<Velocity>, Value<Pressure>, Value<Displacement>, Rate<Displacement>,
      Gradient<Displacement>, Value<PoreVelocity>, Value<PorePressure>, Rate<TipDisplacement>>;
  using Tests = typename DrySlots<facing>::Tests;
  static constexpr int movers = 4;
  FluidPull fluid;
  PorousSide body;
  bool fades;  ///< F turns into -p within a fluid's cell of the nearest wet point, thesis (7.30); else (7.29)

  /// F of the nearest wet point, as the closed part has it.
  template <int dim, class T, class G>
  [[nodiscard]] T of_fluid(const Point<dim, G>& x, const Trial<dim, T, Reads>& s) const {
    const T tip = fluid.operator()<dim, T, G>(x, s.value(Velocity{}), s.gradient(Velocity{}),
                                              s.value(Pressure{}), s.rate(TipDisplacement{}));
    if (!fades) return tip;
    const T part = part_of_pores<dim, T, G>(x, s);
    return (1 - part) * tip + part * pull_of_pores<facing, dim, T, G>(body, x, s);
  }
  /// Of F, the rest is that of the nearest wet point.
  template <int dim, class T, class G>
  [[nodiscard]] T part_of_pores(const Point<dim, G>& x, const Trial<dim, T, Reads>& s) const {
    using std::sqrt;
    if (!fades) return T(0.0);
    Vec<dim, T> way = s.value(Displacement{});
    way += x.partner_position - x.position;
    const T square = dot(way, way);
    if (plain(square) <= 0) return T(0.0);
    if (plain(square) >= x.cell_size * x.cell_size) return T(1.0);
    return (1 / x.cell_size) * sqrt(square);
  }
  template <int dim, class T, class G>
  [[nodiscard]] T of_bodies(const Point<dim, G>& x, const Trial<dim, T, Reads>& s) const {
    return body.pull<facing, dim, T, G>(x, s);
  }

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const T opening = fades ? opening_of<dim, T, G>(x, s) : T(0.0);
    add_dry<facing, dim, T, G>(body, x, s, of_fluid<dim, T, G>(x, s), part_of_pores<dim, T, G>(x, s), opening,
                               r);
  }
};

/// The surface of a porous body of which nothing is in the fluid, where it faces the other body.
template <Facing facing>
struct PorousShut {
  using Reads = typename DrySlots<facing>::template Reads<Gradient<Displacement>, Rate<Displacement>,
                                                          Value<PoreVelocity>, Value<PorePressure>>;
  using Tests = typename DrySlots<facing>::Tests;
  static constexpr int movers = 2;
  PorousSide body;
  bool fades;  ///< F is -p, thesis (7.30); else nothing

  template <int dim, class T, class G>
  [[nodiscard]] T of_fluid(const Point<dim, G>& x, const Trial<dim, T, Reads>& s) const {
    return fades ? pull_of_pores<facing, dim, T, G>(body, x, s) : T(0.0);
  }
  template <int dim, class T, class G>
  [[nodiscard]] T of_bodies(const Point<dim, G>& x, const Trial<dim, T, Reads>& s) const {
    return body.pull<facing, dim, T, G>(x, s);
  }
  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    const T opening = fades ? opening_of<dim, T, G>(x, s) : T(0.0);
    add_dry<facing, dim, T, G>(body, x, s, of_fluid<dim, T, G>(x, s), T(1.0), opening, r);
  }
};

/// The surface of a porous body that nothing is known of.
struct PorousCovered {
  using Reads = Slots<Gradient<Displacement>, Rate<Displacement>, Value<PoreVelocity>, Value<PorePressure>>;
  using Tests = Slots<Value<PoreVelocity>>;
  PorousSide body;

  template <int dim, class T, class G>
  void operator()(const Point<dim, G>& x, const Trial<dim, T, Reads>& s, Test<dim, T, Tests>& r) const {
    r.value(PoreVelocity{}) -= sealed_pressure<dim, T, G>(body, x, s, T(0.0)) * x.normal;
  }
};

}  // namespace seam::fsci
