// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace seam {

/// The instant at which terms are evaluated, and what the time scheme makes of a rate there:
/// rate = factor (value - old value) + known part (thesis (2.93), (2.94)), where the known part is
/// -(1 - theta)/theta times the old rate or, where states keep it, the mean rate over the step before.
struct TimePoint {
  double time = 0;
  double step = 0;  ///< 0 in a static problem
  double theta = 1;
  /// What is differentiated changes values by this,
  double value_factor = 1;
  /// d(rate)/d(value) and d(second rate)/d(value): rates by these.
  double rate_factor = 0;
  double second_rate_factor = 0;
  /// Only for the consistent initial rates: differentiate with respect to the highest rate instead.
  bool initial_rates = false;
  /// Inertia of what is tied by coefficients that change is handed on as the rate of momentum; else as
  /// forces.
  bool inertia_as_momentum = true;
  /// Points of moving interfaces stay where they are: the tangent leaves their motion out.
  bool frozen = false;
};

}  // namespace seam
