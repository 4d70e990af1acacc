// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace seam {

/// What a run remembers of steps that were refused. A length that fails is tried again after a shorter step
/// was taken, since many a step fails for a moment only, as where bodies meet; where it goes on failing it is
/// tried after 2, 4, 8 ... more steps, so that few are computed in vain.
struct Refusals {
  double length = 0;  ///< that failed last, s; 0 when none is remembered
  int patience = 0;   ///< steps to be taken before a longer one, after the last refusal
  int waiting = 0;    ///< what is left of them

  /// A step of this length has failed.
  void refuse(double failed);
  /// A step has been taken.
  /// @param planned, taken lengths it was to have and had @param next length to plan, s
  /// @return the length to plan in the light of what failed
  [[nodiscard]] double accept(double planned, double taken, double next);
};

}  // namespace seam
