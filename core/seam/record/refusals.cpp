// SPDX-License-Identifier: BSD-3-Clause
#include "seam/record/refusals.hpp"

#include <algorithm>

namespace seam {

void Refusals::refuse(double failed) {
  constexpr int first = 2, most = 64;
  // Where even a shorter step fails, it is one refusal.
  constexpr double as_long = 0.75;
  if (length > 0 && failed > as_long * length) patience = std::clamp(2 * patience, first, most);
  length = failed;
  waiting = patience;
}

double Refusals::accept(double planned, double taken, double next) {
  constexpr double rounding = 1e-6;
  if (length > 0 && taken > (1 - rounding) * length) {
    patience /= 2;
    if (patience == 0) length = 0;
  }
  if (waiting == 0) return next;
  --waiting;
  return std::min(next, planned);
}

}  // namespace seam
