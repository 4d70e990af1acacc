// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "seam/term/kernel_term.hpp"

/// What passes between the pores of a body and a film of fluid that closes, thesis 7.2.
namespace seam::fsci {

/// How pores are sealed as a gap closes.
struct Seal {
  enum class Kind {
    resistance,  ///< p + F = R q, R = c alpha/(1 - alpha): one flux q^ on both sides
    printed,     ///< thesis (7.25)-(7.28): alpha of the seepage is lost to the fluid
    sudden       ///< open until a point is dry
  };
  static constexpr double left_open = 1e-4;  ///< of dry films
  Kind kind;
  double width;  ///< m, of the gap in which alpha rises from 0 to 1; 0: a hundredth of the fluid's cell
  double dry;    ///< m: points whose gap at the start of a step was less are sealed

  /// Whether the film is none. @param start the gap at the start of the step
  template <int dim, class G>
  [[nodiscard]] bool is_dry(const Point<dim, G>& x, double start) const {
    return start < dry || plain(x.gap) <= 0;
  }
  /// Whether pores that are not wet are open to pores opposite: not where they look at each other across what
  /// the fluid's mesh ends before.
  template <int dim, class G>
  [[nodiscard]] bool meets(const Point<dim, G>& x) const {
    return plain(x.gap) < std::max(dry, 0.01 * x.cell_size);
  }
  /// alpha: 0 open, 1 sealed. A dry film that is shut off from all pores has no level of pressure: a
  /// resistance leaves `left_open`.
  template <int dim, class T, class G>
  [[nodiscard]] T closed(const Point<dim, G>& x, double start) const {
    if (is_dry(x, start)) return T(kind == Kind::resistance ? 1 - left_open : 1.0);
    const double within = kind == Kind::sudden ? 0 : width > 0 ? width : 0.01 * x.cell_size;
    if (plain(x.gap) >= within) return T(0.0);
    return 1 - (1 / within) * T(x.gap);
  }
};

/// What passes between fluid and pores, out of the body, m/s, and what presses on both, Pa.
template <class T>
struct Exchange {
  T pull;           ///< F
  T into_fluid;     ///< q^ as the fluid's balance has it
  T out_of_pores;   ///< q^ as the pores' has it, against a porous body this look's half
  T pore_pressure;  ///< p^
  T into_facing{};  ///< what pores opposite get of it
};

/// @param stress n . sigma_F n @param penalty gamma_F, Pa s/m @param speed (v - du/dt) . n
/// @param c resistance mu l/k of a layer of the pores as thick as the fluid's cell, Pa s/m
///
/// With the resistance, every beta in [0, 1] imposes it: p^ = beta (R q - F) + (1 - beta) p, q^ = beta q + (1
/// - beta)(p + F)/R. beta = c/(c + R) = 1 - alpha has no number that grows without bound. The power that the
/// seal takes, beta R q^2 + (1 - beta)(p + F)^2/R, is never negative.
template <class T>
Exchange<T> exchange(const Seal& seal, const T& alpha, const T& stress, const T& penalty, const T& speed,
                     const T& pressure, const T& seepage, const T& c) {
  const T open = 1 - alpha;
  if (seal.kind == Seal::Kind::resistance) {
    const T leak = open / c;
    const T pull = (stress + penalty * (speed - open * seepage - leak * pressure)) / (1 + penalty * leak);
    const T through = open * seepage + leak * (pressure + pull);
    return {pull, through, through, alpha * (pressure + c * seepage) - open * pull, T(0.0)};
  }
  const T flow = seal.kind == Seal::Kind::sudden ? open * seepage : seepage;
  const T pull = stress + penalty * (speed - flow);
  return {pull, flow, open * seepage, alpha * pressure - open * pull, T(0.0)};
}

/// The same at a dry point between pores, of which the fluid's film sees next to nothing. @param mean of both
/// pressures @param opening g', of which each side fills a half, and each look a half of that @param film
/// what its pores give to the film that is left, see `Seal::closed`
template <class T>
Exchange<T> between_pores(const T& pull, const T& mean, const T& seepage, const T& opening,
                          const T& film = T(0.0)) {
  return {pull, film, 0.5 * seepage + 0.25 * opening + film, mean, 0.5 * seepage - 0.25 * opening};
}

}  // namespace seam::fsci
