// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "porous_contact_kernels.hpp"

/// Numbers at the points of a porous body's surface.
namespace seam::fsci {

enum class FilmNumber {
  across,   ///< what the condition across leaves, m/s
  along,    ///< along, m/s
  seepage,  ///< into the body, m/s
  dropped,  ///< what leaves the film less what enters the pores, m/s
  body,     ///< normal speed of the body out of the fluid, m/s
  traction  ///< on the body, a component, Pa
};

template <bool is_near>
struct FilmMeasure {
  using Reads = typename PorousFilm<is_near>::Reads;
  static constexpr int values(int) { return 1; }
  PorousFilm<is_near> film;
  FilmNumber number;
  int component = 0;

  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    if (number == FilmNumber::traction)
      return TractionOf<PorousFilm<is_near>>{film, component}.template operator()<dim>(x, s, value);
    const Vec<dim, double> skeleton = s.rate(Displacement{});
    const auto passing = film.template passes<dim, double, double>(x, s);
    *value = dot(skeleton, x.normal);
    if (number == FilmNumber::body) return;
    *value = -passing.out_of_pores;
    if (number == FilmNumber::seepage) return;
    *value = passing.out_of_pores - passing.into_fluid;
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
  gap,       ///< m
  touches,   ///< 1 or 0
  pressure,  ///< -S where they touch, Pa
  traction   ///< of this, on the body, a component, Pa
};

inline double touch(TouchNumber number, double gap, double contact, double of_fluid, double normal) {
  if (number == TouchNumber::gap) return gap;
  if (contact >= of_fluid) return 0;
  if (number == TouchNumber::touches) return 1;
  return number == TouchNumber::pressure ? -contact : -contact * normal;
}

struct NearTouch {
  using Reads = PorousFilm<true>::Reads;
  static constexpr int values(int) { return 1; }
  PorousFilm<true> film;
  TouchNumber number;
  int component = 0;
  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    *value = touch(number, x.gap, film.body.pull<dim, double, double>(x, s),
                   film.passes<dim, double, double>(x, s).pull, x.normal[component]);
  }
};

/// At closed or shut points.
template <class Kernel>
struct DryTouch {
  using Reads = typename Kernel::Reads;
  static constexpr int values(int) { return 1; }
  Kernel kernel;
  TouchNumber number;
  int component = 0;
  template <int dim>
  void operator()(const Point<dim>& x, const Trial<dim, double, Reads>& s, double* value) const {
    *value = touch(number, x.gap, kernel.template of_bodies<dim, double, double>(x, s),
                   kernel.template of_fluid<dim, double, double>(x, s), x.normal[component]);
  }
};

}  // namespace seam::fsci
