// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "porous_contact_kernels.hpp"

/// Numbers at the points of a porous body's surface.
namespace seam::fsci {

enum class FilmNumber {
  across,   ///< what the condition across leaves, m/s
  along,    ///< along, m/s
  seepage,  ///< into the body, m/s
  dropped,  ///< what leaves the film less what enters the pores, m/s
  through,  ///< out of the pores into those opposite, this look's half, m/s
  body,     ///< normal speed of the body out of the fluid, m/s
  traction  ///< on the body, a component, Pa
};

template <Facing facing>
struct FilmMeasure {
  using Reads = typename PorousFilm<facing>::Reads;
  static constexpr int values(int) { return 1; }
  PorousFilm<facing> film;
  FilmNumber number;
  int component = 0;

  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    if (number == FilmNumber::traction)
      return TractionOf<PorousFilm<facing>>{film, component}.template operator()<dim>(x, s, value);
    const Vec<dim, double> skeleton = s.rate(Displacement{});
    const auto passing = film.template passes<dim, double, double>(x, s);
    *value = dot(skeleton, x.normal);
    if (number == FilmNumber::body) return;
    *value = passing.into_facing;
    if (number == FilmNumber::through) return;
    *value = passing.into_facing - passing.out_of_pores;
    if (number == FilmNumber::seepage) return;
    *value = passing.out_of_pores - passing.into_facing - passing.into_fluid;
    if (number == FilmNumber::dropped) return;
    const double porosity = film.body.mismatch.template of_pores<dim, double>(s)[0];
    const Vec<dim, double> both = film.body.mismatch.template operator()<dim, double, double>(x, s, porosity);
    const double normal = dot(both, x.normal);
    *value = std::sqrt(std::max(0.0, dot(both, both) - normal * normal));
    if (number == FilmNumber::across)
      *value = dot(s.value(Velocity{}) - skeleton, x.normal) + passing.into_fluid;
  }
};

enum class TouchNumber {
  gap,        ///< m
  touches,    ///< 1 or 0
  pressure,   ///< -S where they touch, Pa
  effective,  ///< of this what is more than the pressure in the pores, infinite elsewhere, Pa
  traction    ///< -S n, on the body, a component, Pa
};

/// What is known at a point that faces another body, Pa and m.
struct Touch {
  double gap, contact, of_fluid, of_pores;
  [[nodiscard]] double operator()(TouchNumber number, double normal) const {
    if (number == TouchNumber::gap) return gap;
    const bool touches = contact < of_fluid;
    if (number == TouchNumber::effective)
      return touches ? -contact - of_pores : std::numeric_limits<double>::infinity();
    if (!touches) return 0;
    if (number == TouchNumber::touches) return 1;
    return number == TouchNumber::pressure ? -contact : -contact * normal;
  }
};

template <Facing facing>
struct NearTouch {
  using Reads = typename PorousFilm<facing>::Reads;
  static constexpr int values(int) { return 1; }
  PorousFilm<facing> film;
  TouchNumber number;
  int component = 0;
  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    const Touch touch{x.gap, film.body.template pull<facing, dim, double, double>(x, s),
                      film.template passes<dim, double, double>(x, s).pull,
                      PorousSide::mean_pressure<facing, double>(s)};
    *value = touch(number, x.normal[component]);
  }
};

/// At closed or shut points.
template <Facing facing, class Kernel>
struct DryTouch {
  using Reads = typename Kernel::Reads;
  static constexpr int values(int) { return 1; }
  Kernel kernel;
  TouchNumber number;
  int component = 0;
  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    const Touch touch{x.gap, kernel.template of_bodies<dim, double, double>(x, s),
                      kernel.template of_fluid<dim, double, double>(x, s),
                      PorousSide::mean_pressure<facing, double>(s)};
    *value = touch(number, x.normal[component]);
  }
};

/// Out of closed or shut pores into those opposite, this look's half, m/s.
template <class Kernel>
struct SeepageThrough {
  using Reads = typename Kernel::Reads;
  static constexpr int values(int) { return 1; }
  Kernel kernel;
  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    *value = 0;
    if (!kernel.body.seal.meets(x)) return;
    const double seepage = kernel.body.template state<dim, double, double>(x, s).seepage;
    *value = between_pores<double>(0, 0, seepage, kernel.fades ? opening_of<dim, double, double>(x, s) : 0.0)
                 .into_facing;
  }
};

/// Out of closed or shut pores into a gap that opens without fluid, m/s; of both pores, this look's half.
template <Facing facing, class Kernel>
struct IntoGaps {
  using Reads = typename Kernel::Reads;
  static constexpr int values(int) { return 1; }
  Kernel kernel;
  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    constexpr double share = facing == Facing::porous ? 0.5 : 1;
    *value = kernel.fades ? share * opening_of<dim, double, double>(x, s) : 0.0;
  }
};

}  // namespace seam::fsci
